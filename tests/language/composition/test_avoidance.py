"""What "avoid" may mean."""

from __future__ import annotations

import pytest

from models.language.composition.avoidance import meanings
from models.queries import parse_query


def test_avoiding_on_the_way_is_meant_in_three_ways() -> None:
    found = [(str(query), share) for query, share in meanings(parse_query("and(go(a), avoid(go(b)))"))]
    assert [query for query, _ in found] == [
        "and(go(a), avoid(go(b)))",
        "until(avoid(go(b)), go(a))",
        "without(go(a), go(b))",
    ]
    assert sum(share for _, share in found) == pytest.approx(1)
    assert found[0][1] > 0.5


@pytest.mark.parametrize(
    "query", ["go(a)", "avoid(go(a))", "and(go(a), go(b))", "and(repeat(go(a)), avoid(go(b)))", "then(go(a), go(b))"]
)
def test_other_queries_mean_one_thing(query: str) -> None:
    assert list(meanings(parse_query(query))) == [(parse_query(query), 1.0)]
