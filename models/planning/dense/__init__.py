"""Planning on the dense array of all states, for worlds whose dynamics are small tables: no transition is stored.

The value function is one array over (memory, state). A state is a mixed-radix number, so the states that differ only
in the last variable are a contiguous *row*, and an action that does not read that variable does the same to the whole
row: it adds a constant to the index. A row's dynamics are a few *entries*, each an effect (an action with its outcomes'
probabilities and index shifts) and the runs of states in which it is possible, which repeat at a stride. That
compresses a world by the length of its rows, and turns a sweep into additions of contiguous arrays.
"""

from models.planning.dense.solve import UNSURE, solve

__all__ = ["UNSURE", "solve"]
