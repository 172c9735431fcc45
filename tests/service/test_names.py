"""Names that somebody may have meant."""

from __future__ import annotations

import pytest

from service.names import or_rather


@pytest.mark.parametrize(
    ("name", "known", "said"),
    [
        ("toyz", ["toys", "house"], '; did you mean "toys"?'),
        ("TOYS", ["toys"], '; did you mean "toys"?'),
        ("operand", ["operator", "operands"], '; did you mean "operands" or "operator"?'),
        ("mars", ["toys", "house"], ""),
        ("toys", [], ""),
        ("x" * 1_000_000, ["x" * 1_000_000], ""),
    ],
)
def test_or_rather(name: str, known: list[str], said: str) -> None:
    assert or_rather(name, known) == said
