"""The set W: wordings of S and U about held-out open words, and a world in which each means what it should."""

from __future__ import annotations

from collections import Counter

import pytest

from models.language import VocabularyError
from models.language.dataset import Domain, OpenWorld, open_words, open_world, read_corpus
from models.language.tokens import words
from models.logic import Name, atoms, parse
from models.world import atom_symbols, ground, load_environment, resolve

WORLDS = [open_world(domain, seed=seed, size=700) for domain in Domain for seed in (0, 1)]
HELD_OUT = open_words("held_out")
LISTS = {
    "object": HELD_OUT.objects,
    "color": HELD_OUT.colors,
    "container": HELD_OUT.containers,
    **dict.fromkeys(["location", "first", "second", "third"], HELD_OUT.places),
}


@pytest.mark.parametrize("world", WORLDS)
def test_balanced(world: OpenWorld) -> None:
    domain = world.examples[0].domain
    tasks = read_corpus(domain).tasks
    counts = Counter(example.task for example in world.examples)
    assert sum(counts.values()) == 700
    assert set(counts) == {task.name for task in tasks}
    assert max(counts.values()) - min(counts.values()) <= 1
    assert len({words(example.text) for example in world.examples}) == 700


@pytest.mark.parametrize("world", WORLDS)
def test_every_wording_is_said_of_held_out_names(world: OpenWorld) -> None:
    said = Counter[tuple[str, str]]()
    for example in world.examples:
        task = read_corpus(example.domain).task(example.task)
        arguments = dict(zip(task.arguments, example.query.arguments, strict=True))
        assert all(phrase in LISTS[slot] for slot, phrase in arguments.items())
        assert example.distinct
        [wording] = [wording for wording in task.wordings if wording.format_map(arguments) == example.text]
        said[task.name, wording] += 1
        spoken = words(example.text)
        for phrase, spans in zip(example.query.arguments, example.mentions, strict=True):
            assert {" ".join(spoken[start:end]) for start, end in spans} == {phrase}
    for task in read_corpus(world.examples[0].domain).tasks:
        counts = [said[task.name, wording] for wording in task.wordings]
        assert max(counts) - min(counts) <= 1


@pytest.mark.parametrize("world", WORLDS)
def test_everything_means_one_thing_in_its_world(world: OpenWorld) -> None:
    environment = load_environment(world.environment)
    for example in world.examples[::5]:
        formula = resolve(parse(example.ltl), environment)
        named = {term.text for atom in atoms(formula) for term in atom.arguments if isinstance(term, Name)}
        assert named - {"robot"} == set(example.grounding)
        assert all(s is not None for atom in atoms(formula) for s in atom_symbols(atom, environment))
        for phrase, symbol in zip(example.query.arguments, example.grounding, strict=True):
            assert [found.symbol.name for found in ground(phrase, environment).candidates] == [symbol]


def test_several_words_and_one() -> None:
    lengths = Counter(len(phrase.split()) for world in WORLDS for e in world.examples for phrase in e.query.arguments)
    assert lengths[1] > 500
    assert lengths[2] > 500
    assert lengths[3] > 5


def test_seeds() -> None:
    first, second = WORLDS[:2]
    assert open_world("manipulation", seed=0, size=700) == first
    names = [set(world.environment["objects"]) for world in (first, second)]
    assert len(names[0] & names[1]) < len(names[0]) / 2
    assert [name for name in names[0] if name.replace("_", " ") in HELD_OUT.containers]


def test_small_and_too_large() -> None:
    assert [e.task for e in open_world("navigation", seed=5, size=4).examples] == [
        "navigate_one",
        "navigate_one",
        "navigate_two",
        "navigate_three",
    ]
    assert len(open_world("navigation", seed=5, size=1440).examples) == 1440  # every name in every wording
    with pytest.raises(VocabularyError, match="at most 480 commands of navigate_one, not 481"):
        open_world("navigation", seed=5, size=1441)
    with pytest.raises(ValueError, match="cooking"):
        open_world("cooking", seed=0)
