"""What planning compiles: loops over flat arrays, by numba.

The arrays of choices are those of `models.world.Transitions`: `first_choice` [n + 1], `first_outcome` [C + 1], and by
outcome `successor` [E] and `probability` [E]. A kernel that may take long looks at about `budget` outcomes and leaves
in `ends` how far it came; the caller reports progress and calls it again.
"""

from __future__ import annotations

import numba

jit = numba.njit(cache=True, nogil=True, error_model="numpy")
