"""Formulas and queries are no commands.

Read as words, "G !at(lab)" says to go to the lab: whoever sends it to be translated has it in the wrong place.
"""

from __future__ import annotations

import re
from contextlib import suppress

from models.errors import CqltlError
from models.logic import parse
from models.queries import parse_query

_CALL = re.compile(r"\w\(")
"""What no text without it is looked at for: a word alone is a formula too."""


def is_formal(text: str) -> bool:
    """Whether a text is an LTL formula with arguments, or a contextual query."""
    if not _CALL.search(text):
        return False
    for read in (parse, parse_query):
        with suppress(CqltlError):
            read(text)
            return True
    return False
