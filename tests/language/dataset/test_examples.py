"""S and U: sizes as in the paper's Table I, texts, queries, formulas and groundings that agree."""

from __future__ import annotations

from collections import Counter

import pytest

from models.language.dataset import Domain, Example, Part, generate, grounding_environment, read_corpus
from models.language.tokens import find, words
from models.logic import Formula, Name, atoms, parse
from models.queries import ContextualQuery
from models.world import Environment, Symbol, atom_symbols, ground, load_environment, resolve

TABLE_1 = {
    "move_to": (150, 36),
    "pickup": (450, 108),
    "pickup_colored": (2700, 648),
    "ship": (1350, 972),
    "navigate_one": (51, 18),
    "navigate_two": (612, 72),
    "navigate_three": (7344, 288),
}
PARTS = [(domain, part) for domain in Domain for part in Part]


def _examples(domain: Domain, part: Part) -> tuple[Example, ...]:
    return generate(domain).seen if part is Part.SEEN else generate(domain).unseen


def _choices(domain: Domain, part: Part) -> list[Example]:
    """One example for every task and choice of objects."""
    return list({(e.task, e.grounding): e for e in _examples(domain, part)}.values())


def _environment(domain: Domain, part: Part) -> Environment:
    return load_environment(grounding_environment(domain, part))


def test_sizes() -> None:
    counted = {part: Counter(e.task for d in Domain for e in _examples(d, part)) for part in Part}
    assert {task: (counted[Part.SEEN][task], counted[Part.UNSEEN][task]) for task in TABLE_1} == TABLE_1
    assert {d: (len(generate(d).seen), len(generate(d).unseen)) for d in Domain} == {
        Domain.MANIPULATION: (4650, 1764),
        Domain.NAVIGATION: (8007, 378),
    }


def test_no_text_twice_in_any_dataset() -> None:
    texts = [words(e.text) for domain, part in PARTS for e in _examples(domain, part)]
    assert len(set(texts)) == len(texts)


@pytest.mark.parametrize(("domain", "part"), PARTS)
def test_arguments_are_phrases_of_the_text(domain: Domain, part: Part) -> None:
    for example in _examples(domain, part):
        for phrase in example.query.arguments:
            assert find(words(phrase), words(example.text)) is not None
        assert "{" not in example.text + example.ltl


def test_the_sentences_of_the_paper() -> None:
    found = {e.text: e for e in generate("manipulation").seen}
    ship = found["Put the cylinder in the box, then put the box in the bedroom"]
    assert ship.query == ContextualQuery("ship", ("cylinder", "box", "bedroom"))
    assert ship.ltl == "F (in(cylinder, box) & F (in(cylinder, box) & at(box, bedroom)))"
    pickup = found["Pickup the sphere"]
    assert (pickup.query, pickup.ltl) == (ContextualQuery("pickup", ("sphere",)), "F holding(sphere)")
    red = found["Pickup the red ball"]
    assert red.query == ContextualQuery("pickup_colored", ("ball", "red"))
    assert red.ltl == "F (holding(ball) & colored(ball, red))"


def test_homonyms_have_symbols_of_their_own() -> None:
    texts = {e.text: e for e in generate("manipulation").seen}
    bags = texts["Put the bag in the bag, then put the bag in the kitchen"]
    assert bags.query.arguments == ("bag", "bag", "kitchen")
    assert bags.grounding == ("bag_toy", "bag", "kitchen")
    assert bags.ltl == "F (in(bag_toy, bag) & F (in(bag_toy, bag) & at(bag, kitchen)))"
    same = Counter((e.task, e.query.arguments[0]) for d, p in PARTS for e in _examples(d, p) if not e.distinct)
    assert same == {("ship", "bag"): 18, ("pickup_colored", "orange"): 18}


@pytest.mark.parametrize(("domain", "part"), PARTS)
def test_formulas_hold_in_the_grounding_environment(domain: Domain, part: Part) -> None:
    """Every formula parses, resolves, prints its own symbols, and every argument grounds to what it means."""
    environment = _environment(domain, part)
    for example in _choices(domain, part):
        formula = resolve(parse(example.ltl), environment)
        named = {term.text for atom in atoms(formula) for term in atom.arguments if isinstance(term, Name)}
        assert named - {"robot"} == set(example.grounding)
        used = _symbols(formula, environment)
        for phrase, symbol in zip(example.query.arguments, example.grounding, strict=True):
            meant = {candidate.symbol for candidate in ground(phrase, environment).candidates}
            assert symbol in {s.name for s in meant & used}


def _symbols(formula: Formula, environment: Environment) -> set[Symbol]:
    return {s for atom in atoms(formula) for s in atom_symbols(atom, environment) if s is not None}


@pytest.mark.parametrize(("domain", "part"), PARTS)
def test_the_environment_holds_the_whole_vocabulary(domain: Domain, part: Part) -> None:
    names = {symbol.name for symbol in _environment(domain, part).symbols()}
    wanted = {word.symbol for entries in read_corpus(domain).vocabulary[part].values() for word in entries}
    assert wanted <= names


def test_generated_once_and_alike() -> None:
    assert generate("navigation") is generate(Domain.NAVIGATION)
    with pytest.raises(ValueError, match="cooking"):
        generate("cooking")
