"""A task is grounded once in a scene, and whoever is refused it has a refusal of their own."""

from __future__ import annotations

import pytest

from models.errors import CqltlError, Place
from models.language import scene as module
from models.language.scene import Scene
from models.logic import parse
from models.queries import ContextualQuery, Example, evaluate, learn, parse_query
from models.world import UnknownObjectError, load_environment, toys_spec

TOYS = load_environment(toys_spec(columns=2, rows=1, toys=[("sphere", "red")]))
TEMPLATE = learn([Example(parse_query("pickup(sphere)"), parse("F holding(sphere)"))], TOYS)


def scene(text: str = "pick up the sphere") -> Scene:
    return Scene(text, TOYS, {"pickup": TEMPLATE}.get)


def test_a_task_is_grounded_once(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[ContextualQuery] = []

    def counting(template: object, query: ContextualQuery, *rest: object, **more: object) -> object:
        asked.append(query)
        return evaluate(template, query, *rest, **more)  # type: ignore[arg-type]

    monkeypatch.setattr(module, "evaluate", counting)
    here, task = scene(), ContextualQuery("pickup", ("sphere",))
    assert here.ground(task) is here.ground(ContextualQuery("pickup", ("sphere",)))
    for _ in range(2):
        with pytest.raises(UnknownObjectError):
            here.ground(ContextualQuery("pickup", ("unicorn",)))
    assert [str(query) for query in asked] == ["pickup(sphere)", "pickup(unicorn)"]


def test_a_refusal_can_be_placed_without_placing_others() -> None:
    here, task = scene(), ContextualQuery("pickup", ("unicorn",))
    refused: list[CqltlError] = []
    for prefix in ("/operands/0", "/operands/1"):
        with pytest.raises(UnknownObjectError) as raised:
            here.ground(task)
        raised.value.places = tuple(Place(prefix + place.pointer, place.detail) for place in raised.value.places)
        refused.append(raised.value)
    assert [error.places[0].pointer for error in refused] == ["/operands/0/arguments/0", "/operands/1/arguments/0"]
    assert refused[0].detail == refused[1].detail


def test_what_it_knows_and_names() -> None:
    here = scene("pick up the sphere, then the sphere again, in the bedroom")
    assert here.knows(parse_query("then(pickup(a), pickup(b))"))
    assert not here.knows(parse_query("then(pickup(a), wait())"))
    assert here.named() == (("sphere",), ("bedroom",))
    assert Scene("pick up the sphere", None, here.template_of).named() == ()
