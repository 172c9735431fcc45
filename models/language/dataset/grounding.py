"""An environment that holds everything a dataset speaks about, to ground its queries and read its formulas.

The domains of `models.world` give classes, propositional functions and names. Their dynamics are left out: a world with
every toy of the dataset has far too many states to plan in, and grounding needs none.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from importlib.resources import files
from typing import Any

from models.data import read_yaml
from models.language.dataset.corpus import Domain, Part, Word, read_corpus

_WORLD = {Domain.MANIPULATION: "toys", Domain.NAVIGATION: "navigation"}
"""The built-in domain of `models.world` that each dataset speaks about."""
_ATTRIBUTES = frozenset({"color"})
"""Slots whose words are attribute values; those of all others are objects."""
_CLASSES = {
    "object": "toy",
    "container": "box",
    "location": "cell",
    "first": "place",
    "second": "place",
    "third": "place",
}
"""The class of the objects of a slot."""


def grounding_environment(domain: Domain | str, part: Part | str) -> dict[str, Any]:
    """Environment data (for `models.world.load_environment`) with every object and value of a vocabulary.

    A phrase that is not its symbol's name is a synonym of it: `bag` of the toy `bag_toy`, beside the container `bag`.
    Nothing in the environment can move or be done.
    """
    domain, part = Domain(domain), Part(part)
    return environment_of(domain, read_corpus(domain).vocabulary[part], name=f"{domain}_{part}")


def environment_of(domain: Domain, vocabulary: Mapping[str, Sequence[Word]], *, name: str) -> dict[str, Any]:
    """As `grounding_environment`, with the objects and values of any vocabulary, by slot of the domain's tasks."""
    return {
        "kind": "oomdp",
        "name": name,
        "domain_spec": _without_dynamics(_WORLD[domain]),
        "values": {slot: [word.symbol for word in vocabulary[slot]] for slot in sorted(_ATTRIBUTES & set(vocabulary))},
        "objects": dict(_objects(vocabulary)),
    }


def _without_dynamics(name: str) -> dict[str, Any]:
    """A built-in domain whose state attributes are static and that has no actions."""
    text = (files("models.world") / "domains" / f"{name}.yaml").read_text(encoding="utf-8")
    data: dict[str, Any] = read_yaml(text)
    for declared in data["classes"].values():
        declared["static"] = {**declared.get("static", {}), **declared.pop("state", {})}
    return {**data, "name": f"{name}_at_rest", "actions": {}, "constraints": []}


def _objects(vocabulary: Mapping[str, Sequence[Word]]) -> Iterator[tuple[str, dict[str, Any]]]:
    for slot, entries in vocabulary.items():
        if slot not in _ATTRIBUTES:
            for word in entries:
                synonyms = [] if word == Word.of(word.phrase) else [word.phrase]
                yield word.symbol, {"class": _CLASSES[slot], "synonyms": synonyms}
