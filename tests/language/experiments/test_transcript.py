"""Transcripts survive the disk."""

from __future__ import annotations

import json

from hypothesis import given
from hypothesis import strategies as st

from models.language.dataset import Domain, generate
from models.language.experiments.transcript import Transcript
from models.logic import parse
from models.queries import ContextualQuery

QUERIES = st.none() | st.builds(
    ContextualQuery,
    st.sampled_from(["pickup", "ship"]),
    st.lists(st.sampled_from(["teddy bear", "a, b", 'the "x"', "h&m"]), max_size=3).map(tuple),
)
FORMULAS = st.none() | st.sampled_from(
    [parse(text) for text in ("F holding(ball)", 'F (at(robot, "h&m") & F at(robot, park))', "true", "p")]
)


@given(st.lists(st.tuples(QUERIES, QUERIES, FORMULAS), max_size=8))
def test_there_and_back(answers: list[tuple[object, object, object]]) -> None:
    columns = zip(*answers, strict=True) if answers else ((), (), ())
    transcript = Transcript(*(tuple(column) for column in columns))  # type: ignore[arg-type]
    assert Transcript.from_json(json.loads(json.dumps(transcript.as_json()))) == transcript


def test_each_different_answer_is_kept_once() -> None:
    examples = generate(Domain.NAVIGATION).unseen
    queries = tuple(example.query for example in examples)
    data = Transcript(queries, queries, (None,) * len(queries)).as_json()
    assert len(data["queries"]["which"]) == len(queries)
    assert len(data["queries"]["different"]) == len(set(queries)) < len(queries)
    assert data["formulas"]["different"] == [None]
