"""Jobs and answers come back from their texts as they were."""

from __future__ import annotations

import math
from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from models.logic import Formula, parse
from models.queries import resolve_grounded
from models.world import toys_spec
from service.services import LoadedEnvironment
from service.worker import PlanAnswer, PlanJob, Verified, run_plan
from service.worker.records import answer_text, job_text, read_answer, read_job
from tests.logic.strategies import formulas, nasty_atoms

ENVIRONMENT = LoadedEnvironment.read({**toys_spec(columns=2, rows=1, toys=[("cube", "red")]), "name": "two"})


def job(formula: Formula, **changes: Any) -> PlanJob:
    values: dict[str, Any] = {
        "environment": ENVIRONMENT.text,
        "formula": formula,
        "state": None,
        "epsilon": 1e-6,
        "max_states": 10_000,
        "device": "auto",
        "objective": "max",
        "verify": False,
        "relevance": True,
        "timeout_s": 30.0,
    }
    return PlanJob(**values | changes)


@given(formulas(nasty_atoms), st.floats(1e-12, 0.5), st.dictionaries(st.text(), st.dictionaries(st.text(), st.text())))
def test_jobs_come_back(formula: Formula, epsilon: float, state: dict[str, dict[str, str]]) -> None:
    asked = job(formula, epsilon=epsilon, state=state, objective="min", verify=True)
    assert read_job(job_text(asked)) == asked


def test_a_job_that_was_kept_gives_the_same_answer_to_the_byte() -> None:
    for text in (
        "F holding(cube)",
        "G F holding(cube) & G F !holding(cube)",
        "F cube_in_box",
        "!holding(cube) U in(cube, box)",
    ):
        asked = job(resolve_grounded(parse(text), ENVIRONMENT.value), verify=True)
        assert run_plan(read_job(job_text(asked))) == run_plan(asked)


@given(st.floats(0, 1), st.sampled_from([None, 0.5, math.inf]), st.booleans())
def test_answers_come_back_without_their_policy(number: float, steps: float | None, some: bool) -> None:
    answer = PlanAnswer(
        outcome="solved",
        lower=number,
        upper=1.0,
        expected_steps=number,
        expected_steps_upper=steps,
        round_steps=(number, math.inf) if some else None,
        initial={"robot": {"at": "kitchen"}},
        initial_memory=1,
        trajectory=(({"robot": {"at": "küche"}}, 0, "east"), ({}, 1, None)) if some else (),
        run_probability=number if some else None,
        complete=some,
        loop=0 if some else None,
        policy=None,
        verified=Verified(number, math.inf, some, 3) if some else None,
        states=4,
        product_states=8,
        automaton_states=2,
    )
    assert read_answer(answer_text(answer)) == answer
