"""Counting, checked with systems whose answers are known."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import pytest

from models.language.dataset import Domain
from models.language.experiments.answer import Answer
from models.language.experiments.causes import Cause
from models.language.experiments.commands import paper_sets
from models.language.experiments.measurement import OVERALL, SHOWN, Score, judge, measure
from models.language.tokens import words
from models.logic import Op, parse
from models.logic.formula import build
from models.queries import ContextualQuery
from models.world import Environment

_, UNSEEN = paper_sets(Domain.MANIPULATION)


@dataclass(frozen=True, slots=True)
class _PickupOnly:
    """Reads every command as picking up its last word."""

    name: str = "pickup only"
    speaks_queries: bool = True

    def answer(self, texts: Sequence[str], environment: Environment) -> list[Answer]:
        last = [words(text)[-1] for text in texts]
        return [Answer(ContextualQuery("pickup", (word,)), parse(f"F holding({word})")) for word in last]


def test_a_system_that_knows_one_class() -> None:
    result = measure(_PickupOnly(), UNSEEN)
    ending = sum(e.task == "pickup" and words(e.text)[-1] == e.query.arguments[0] for e in UNSEEN.examples)
    assert 0 < ending < 108
    assert result.scores["pickup"] == Score(total=108, query=ending, ltl=ending, text=ending, structure=108)
    assert result.scores["ship"] == Score(total=972)
    assert result.overall == Score(total=1764, query=ending, ltl=ending, text=ending, structure=108)
    assert list(result.groups) == [OVERALL, "move_to", "pickup", "pickup_colored", "ship"]
    assert result.failures["ship"][Cause.WRONG_CLASS].count == 972
    assert result.failures["pickup"][Cause.WRONG_ARGUMENT].count == 108 - ending
    assert sum(result.right) == ending


def test_examples_of_failures_are_few_and_of_different_meaning() -> None:
    failures = measure(_PickupOnly(), UNSEEN).failures["ship"][Cause.WRONG_CLASS]
    assert len(failures.examples) == SHOWN
    assert len({failure.expected for failure in failures.examples}) == SHOWN
    assert failures.examples[0].text == "Put the mug in the crate, then put the crate in the bathroom"
    assert failures.examples[0].answer == "pickup(bathroom)"
    assert failures.examples[0].expected == "ship(mug, crate, bathroom)"


def test_an_equivalent_formula_is_right_though_its_text_is_another() -> None:
    commands = UNSEEN.thinned(1)
    assert [example.task for example in commands.examples] == ["move_to", "pickup", "pickup_colored", "ship"]
    doubled = [Answer(formula=build(Op.FINALLY, [formula])) for formula in commands.expected]
    result = judge(doubled, commands, queries=False)
    assert result.overall == Score(total=4, ltl=4)
    assert not any(result.failures.values())
    assert judge([Answer(formula=f) for f in commands.expected], commands, queries=False).overall == Score(
        total=4, ltl=4, text=4, structure=4
    )


def test_formulas_that_the_environment_does_not_have() -> None:
    commands = UNSEEN.thinned(1)
    said = [parse("F near(robot, sphere)"), parse("F holding_mug"), parse("F nonsense"), None]
    result = judge([Answer(formula=formula) for formula in said], commands, queries=False)
    mug = commands.examples[1].query.arguments == ("mug",)
    assert result.overall == Score(total=4, ltl=int(mug), text=int(mug), structure=2)
    assert list(result.failures["move_to"]) == [Cause.WRONG_PROPOSITION]
    assert list(result.failures["pickup_colored"]) == [Cause.WRONG_STRUCTURE]
    assert list(result.failures["ship"]) == [Cause.NOT_A_FORMULA]
    assert result.failures["ship"][Cause.NOT_A_FORMULA].examples[0].answer == "nothing"


def test_a_right_query_with_a_wrong_formula_is_no_right_answer() -> None:
    commands = UNSEEN.thinned(1)
    answers = [Answer(example.query, refusal="ambiguous-grounding") for example in commands.examples]
    result = judge(answers, commands, queries=True)
    assert result.overall == Score(total=4, query=4, structure=4)
    assert list(result.failures["ship"]) == [Cause.AMBIGUOUS_GROUNDING]


def test_rates() -> None:
    score = Score(total=8, query=2, ltl=4, text=1, structure=8)
    assert [score.rate(measure) for measure in ("query", "ltl", "text", "structure")] == [0.25, 0.5, 0.125, 1.0]
    assert Score().rate("ltl") == 1.0
    with pytest.raises(KeyError):
        score.rate("luck")


def test_every_command_needs_an_answer() -> None:
    with pytest.raises(ValueError, match="zip"):
        judge([], UNSEEN, queries=True)
