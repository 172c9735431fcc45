"""How the readings of two sources weigh against each other."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.language.translation import Translation, weighed
from models.queries import ContextualQuery

A, B, C = (ContextualQuery(name, ("x",)) for name in "abc")


def test_one_source_alone_stays_as_it_is() -> None:
    said = (Translation(A, 0.6), Translation(B, 0.2))
    assert weighed(said, ()) == said
    assert weighed((), said) == said
    assert weighed((), ()) == ()


def test_each_is_believed_as_far_as_the_other_is_in_doubt() -> None:
    """By hand: odds 0.9 * (1 - 0.3) to 0.3 * (1 - 0.9), of 0.9 + 0.3 - 0.27 in all."""
    first, second = weighed((Translation(A, 0.9),), (Translation(B, 0.3),))
    assert (first.query, second.query) == (A, B)
    assert first.confidence == pytest.approx(0.93 * 0.63 / 0.66)
    assert second.confidence == pytest.approx(0.93 * 0.03 / 0.66)


def test_both_sources_may_say_the_same() -> None:
    (only,) = weighed((Translation(A, 0.5),), (Translation(A, 0.5),))
    assert only.confidence == pytest.approx(0.75)


SHARES = st.lists(st.floats(0.01, 1.0), min_size=1, max_size=3)


@given(SHARES, SHARES)
def test_the_probabilities_are_probabilities(one: list[float], other: list[float]) -> None:
    sources = [
        tuple(
            Translation(query, share / max(1.0, sum(shares))) for query, share in zip((A, B, C), shares, strict=False)
        )
        for shares in (one, other)
    ]
    found = weighed(*sources)
    assert sum(translation.confidence for translation in found) <= 1 + 1e-9
    assert {t.query for t in found} == {t.query for source in sources for t in source}
