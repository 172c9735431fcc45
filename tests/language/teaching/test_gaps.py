"""What commands leave out, on cases worked out by hand, and on every wording with a name taken out."""

from __future__ import annotations

import pytest

from models.language import TextTooLongError, Utterance, Wording
from models.language.dataset.wordings import trained_wordings
from models.language.teaching import Gap, OpenWordings, ends_open
from models.queries import parse_task


def opened(*taught: tuple[str, str]) -> OpenWordings:
    return OpenWordings.of(Wording.of(Utterance.of(text, parse_task(query))) for text, query in taught)


BRING = ("bring the cup to the hall", "bring(cup, hall)")
PUT = ("put the cup in the box", "put_in(cup, box)")
SWITCH = ("turn the lamp on", "switch_on(lamp)")
GRAB = ("grab the red cup", "grab(cup, red)")


@pytest.mark.parametrize(
    ("taught", "command", "expected"),
    [
        (BRING, "bring the towel", ("towel", None)),
        (BRING, "Bring the towel to the!", ("towel", None)),
        (BRING, "could you please bring the old towel to", ("old towel", None)),
        (BRING, "bring me the towel", ("towel", None)),
        (BRING, "bring to the kitchen please", (None, "kitchen")),
        (BRING, "carry the towel", None),  # another wording
        (BRING, "bring", None),  # two names are left out
        (PUT, "put the towel in", ("towel", None)),
        (PUT, "put in the basket", (None, "basket")),
        (SWITCH, "turn on", (None,)),
        (SWITCH, "turn on the", (None,)),
        (SWITCH, "turn the oven", None),  # "on" is no name
        (GRAB, "grab the red", (None, "red")),
    ],
)
def test_gaps(taught: tuple[str, str], command: str, expected: tuple[str | None, ...] | None) -> None:
    task = parse_task(taught[1]).task
    assert opened(taught).gaps(command) == (() if expected is None else (Gap(task, expected),))


def test_all_tasks_of_the_same_words_are_given_and_less_literal_ones_are_not() -> None:
    known = opened(
        BRING, ("bring the bag to the yard", "lug(bag, yard)"), ("bring the cup back to the bar", "back(cup, bar)")
    )
    assert {gap.task for gap in known.gaps("bring the mug to")} == {"bring", "lug"}
    assert [gap.task for gap in known.gaps("bring the mug back to")] == ["back"]


def test_what_only_tells_more_of_a_thing_is_not_missing() -> None:
    gaps = opened(GRAB).gaps("grab the cup")
    assert Gap("grab", ("cup", None)) not in gaps


def test_prepositions_alone_say_no_task() -> None:
    assert opened(("in the box", "inside(box)")).gaps("in the") == ()


@pytest.mark.parametrize(
    ("text", "is_open"), [("put the cup in the", True), ("go to a", True), ("go to", False), ("", False)]
)
def test_a_text_ends_open_at_an_article(text: str, is_open: bool) -> None:
    assert ends_open(text) is is_open


def test_too_long_a_text_is_refused() -> None:
    with pytest.raises(TextTooLongError):
        opened(BRING).gaps("word " * 201)


def test_every_wording_of_one_place_is_recognised_without_its_name() -> None:
    wordings = [w for w in trained_wordings() if w.task == "navigate_one" and w.elements.count(0) == 1]
    known = OpenWordings.of(wordings)
    found = {w: known.gaps(" ".join(e for e in w.elements if isinstance(e, str))) for w in wordings}
    assert len(wordings) > 30
    missed = [w.elements for w, gaps in found.items() if gaps != (Gap("navigate_one", (None,)),)]
    assert len(missed) <= 0.1 * len(wordings), missed
