"""A toys case as an environment and a formula, and as the text and properties of a PRISM model."""

from __future__ import annotations

import re
from dataclasses import dataclass

from benchmarks.planning.cases import TASKS, Toys
from models.interchange import label_names, prism_model, property_text
from models.logic import Atom, Formula, atoms, parse
from models.world import Environment, load_environment, resolve


@dataclass(frozen=True, slots=True)
class PrismText:
    """A model with the label "goal", and both questions."""

    model: str
    ltl: str
    least_steps: str


def resolved(case: Toys) -> tuple[Environment, Formula]:
    """The environment, and the task's formula in it."""
    environment = load_environment(case.spec())
    return environment, resolve(parse(TASKS[case.task].formula), environment)


def goal_atoms(case: Toys, environment: Environment) -> list[Atom]:
    """What holds in a goal state."""
    return [atom for text in TASKS[case.task].goal for atom in atoms(resolve(parse(text), environment))]


def prism_text(case: Toys) -> PrismText:
    """The environment as `models.interchange` writes it: one module, a bounded integer for each thing that moves, a
    command for each action with the guard that a person would write.

    The minimal automaton of a task with a goal has two states, so the label "goal" is all of it: a product with the
    automaton would have one more variable that says what is true already.
    """
    environment, formula = resolved(case)
    names = label_names(list(atoms(formula)))
    text = prism_model(environment, atoms=list(names))
    conditions = dict(re.findall(r'^label "(\w+)" = (.*?);', text, flags=re.MULTILINE))
    goal = [conditions[names[atom]] for atom in goal_atoms(case, environment)]
    if goal:
        text += f'label "goal" = {" & ".join(f"({condition})" for condition in goal)};\n'
    return PrismText(text, property_text(formula, names), 'R{"steps"}min=? [ F "goal" ]')
