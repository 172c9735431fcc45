"""Every limit of this package. Each is documented in docs/worlds.md; a test compares the two."""

from __future__ import annotations

from typing import Final

MAX_NAME: Final = 100
"""Characters in a name of anything."""
MAX_TEXT: Final = 1_000
"""Characters in one expression, reading, display pattern or sample."""
MAX_TEXTS: Final = 200_000
"""Characters in all expressions of a domain together."""
MAX_NESTING: Final = 40
"""Nesting of one expression."""
MAX_EXPANDED_NESTING: Final = 80
"""Nesting of one expression with the definitions it calls written out."""
MAX_DECLARATIONS: Final = 200
"""Entries in one list or mapping of a domain: classes, attributes, functions, actions, constraints, ..."""
MAX_ARGUMENTS: Final = 6
"""Arguments of one function, definition or action."""
MAX_OBJECTS: Final = 5_000
"""Objects of one environment, the grid's cells included."""
MAX_VALUES: Final = 5_000
"""Attribute values of one environment."""
MAX_SAMPLES: Final = 20
"""Sample commands of an environment, and sample lessons."""
MAX_SYNONYMS: Final = 50
"""Synonyms of one object, words of one class, display patterns of one function."""
MAX_VARIABLES: Final = 2_000
"""State attributes of all objects together."""
MAX_STATES: Final = 2**62
"""States of a world whose labels and outcomes can be computed. A larger one can still be spoken of."""
MAX_GROUNDINGS: Final = 20_000
"""Ways to give all actions their arguments, before impossible ones are dropped."""
MAX_TABLE: Final = 4_096
"""Entries of a table that is computed once; what touches more combinations of values is computed per batch of
states.
"""
MAX_CHECK: Final = 2**20
"""Combinations of variable values over which one action's probabilities and effects are checked."""
MAX_WORK: Final = 2**25
"""Table entries computed while an environment is compiled."""
MAX_RELATED: Final = 10_000
"""Pairs of objects looked at for how one stands to the other, in one phrase; beyond it the phrase names nothing."""
MAX_EXPLICIT_STATES: Final = 1_000_000
"""States of an explicit environment."""
MAX_EXPLICIT_OUTCOMES: Final = 2**24
"""Outcomes of all transitions of an explicit environment together."""
