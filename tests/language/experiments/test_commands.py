"""Sets of commands: their formulas, environments and parts."""

from __future__ import annotations

from dataclasses import replace

import pytest

from models.language.dataset import Domain, generate
from models.language.experiments.commands import AS_IS, CommandSet, paper_sets
from models.logic import to_text


def test_the_sets_of_the_paper() -> None:
    seen, unseen = paper_sets(Domain.MANIPULATION)
    assert (seen.name, unseen.name, seen.said) == ("S", "U", AS_IS)
    assert seen.examples == generate("manipulation").seen
    assert unseen.texts == tuple(example.text for example in generate("manipulation").unseen)


def test_formulas_belong_to_their_commands() -> None:
    for example, formula in zip(
        paper_sets(Domain.MANIPULATION)[1].examples, paper_sets(Domain.MANIPULATION)[1].expected, strict=True
    ):
        assert to_text(formula) == example.ltl  # the data write formulas as the printer does, with unambiguous names


def test_homonyms_keep_their_meaning() -> None:
    seen, _ = paper_sets(Domain.MANIPULATION)
    both = next(
        formula
        for example, formula in zip(seen.examples, seen.expected, strict=True)
        if example.query.arguments == ("orange", "orange")
    )
    assert to_text(both) == "F (holding(orange) & colored(orange, orange))"


def test_thinned_takes_some_of_every_class_and_keeps_pairs() -> None:
    seen, _ = paper_sets(Domain.NAVIGATION)
    thin = seen.thinned(5)
    assert [example.task for example in thin.examples].count("navigate_three") == 5
    assert len(thin.examples) == 15
    by_text = dict(zip(seen.texts, seen.expected, strict=True))
    assert [by_text[text] for text in thin.texts] == list(thin.expected)
    assert thin.examples == seen.thinned(5).examples
    assert seen.thinned(None) is seen
    assert len(seen.thinned(1_000_000).examples) == len(seen.examples)


def test_changed_keeps_what_is_meant() -> None:
    seen = paper_sets(Domain.NAVIGATION)[0].thinned(2)
    loud = seen.changed("loud", lambda example: replace(example, text=example.text.upper()))
    assert (loud.said, loud.name) == ("loud", "S")
    assert loud.expected == seen.expected
    assert all(text.isupper() for text in loud.texts)


def test_an_empty_set_is_refused() -> None:
    with pytest.raises(ValueError, match="at least one"):
        CommandSet.of("S", [], paper_sets(Domain.NAVIGATION)[0].environment)
