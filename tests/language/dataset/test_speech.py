"""Frames around commands and words for "the": what is asked for stays, and the mentions follow the words."""

from __future__ import annotations

import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.language.dataset import Domain, Example, Half, fill, framed, frames, generate, paraphrases, redetermined
from models.language.dataset.corpus import read_corpus
from models.language.dataset.speech import is_imperative, said
from models.language.tokens import words
from models.language.translation import NEGATIONS

EXAMPLES = [*generate("manipulation").seen[::97], *generate("navigation").seen[::97]]
NOT_IMPERATIVE = {
    *("a", "after", "as", "away", "back", "because", "before", "beside", "by", "can", "closer"),
    *("could", "do", "first", "having", "how", "i", "in", "inside", "into", "it", "kindly", "let"),
    *("let's", "near", "nearer", "next", "of", "off", "on", "once", "onward", "over", "please"),
    *("right", "shall", "since", "so", "somebody", "someone", "straight", "that", "the", "then"),
    *("there", "they", "to", "up", "via", "we", "what", "when", "with", "would", "you", "your"),
}
"""First words of wordings that ask, state or begin with when and where."""


def _mentioned(example: Example) -> list[set[str]]:
    spoken = words(example.text)
    return [{" ".join(spoken[start:end]) for start, end in spans} for spans in example.mentions]


@pytest.mark.parametrize(
    ("frame", "texts", "expected"),
    [
        ("Robot, {}", ("Grab the mug",), "Robot, grab the mug"),
        ("{}, please", ("Can you grab the mug?",), "Can you grab the mug, please?"),
        ("Could you {}?", ("Grab the mug!",), "Could you grab the mug?"),
        ("Hey, {}", ("I need the mug, pick it up.",), "Hey, I need the mug, pick it up."),
        ("{}, then {}", ("Grab the mug", "Visit the bank?"), "Grab the mug, then visit the bank?"),
        ("Either {} or {}", ("Stop", "Go"), "Either stop or go"),
    ],
)
def test_said(frame: str, texts: tuple[str, ...], expected: str) -> None:
    assert said(frame, *texts) == expected


def test_said_needs_a_text_for_every_place() -> None:
    with pytest.raises(ValueError, match="longer"):
        said("{} and {}", "Stop")


@given(st.sampled_from(EXAMPLES), st.randoms(use_true_random=False), st.sampled_from(list(Half)))
def test_framed(example: Example, generator: random.Random, part: Half) -> None:
    other = framed(example, generator, part=part)
    assert (other.query, other.ltl, other.grounding) == (example.query, example.ltl, example.grounding)
    assert _mentioned(other) == [{phrase} for phrase in example.query.arguments]
    assert [len(spans) for spans in other.mentions] == [len(spans) for spans in example.mentions]
    spoken, shorter = words(other.text), words(example.text)
    assert len(spoken) > len(shorter)
    assert any(spoken[at : at + len(shorter)] == shorter for at in range(len(spoken)))
    assert spoken.count("please") <= 1


def test_framed_says_what_is_listed() -> None:
    example = fill("navigation", "navigate_one", "Go to the {first}", {"first": "bank"})
    generator = random.Random(0)
    said_texts = {framed(example, generator, part="training").text for _ in range(12_000)}
    listed = frames("training")
    for frame in (*listed.calls, *listed.closings):
        assert (
            frame.replace("{}", "Go to the bank") in said_texts or frame.replace("{}", "go to the bank") in said_texts
        )
    assert {frame.replace("{}", "go to the bank") for frame in listed.requests} <= said_texts


def test_only_commands_that_begin_with_a_verb_stand_in_a_request() -> None:
    example = fill("manipulation", "pickup", "Can you pick up the {object}?", {"object": "drum"})
    generator = random.Random(0)
    texts = {framed(example, generator, part="training").text for _ in range(300)}
    assert not any(text.startswith(("Could you can", "I want you to can")) for text in texts)
    assert all("an you pick up the drum" in text and text.endswith("?") for text in texts)


def test_frames() -> None:
    training, held_out = frames("training"), frames("held_out")
    for name in ("calls", "requests", "closings"):
        entries = {part: set(getattr(part, name)) for part in (training, held_out)}
        assert len(entries[training]) >= 20
        assert len(entries[held_out]) >= 5
        assert not entries[training] & entries[held_out]
        for frame in entries[training] | entries[held_out]:
            assert frame.count("{}") == 1
            assert not NEGATIONS & set(words(frame))


def test_every_wording_begins_with_a_known_word() -> None:
    """A verb that is missing from the list would never be heard in a request."""
    wordings = [
        wording
        for domain in Domain
        for task in read_corpus(domain).tasks
        for wording in (*task.wordings, *(w for part in Half for w in paraphrases(domain, part)[task.name]))
    ]
    assert {words(w)[0] for w in wordings if not is_imperative(w)} <= NOT_IMPERATIVE
    assert not any(is_imperative(word) for word in NOT_IMPERATIVE)


@given(st.sampled_from(EXAMPLES), st.randoms(use_true_random=False), st.sampled_from(list(Half)))
def test_redetermined(example: Example, generator: random.Random, part: Half) -> None:
    other = redetermined(example, generator, part=part)
    assert (other.query, other.ltl, other.grounding) == (example.query, example.ltl, example.grounding)
    assert _mentioned(other) == [{phrase} for phrase in example.query.arguments]
    assert words(other.text).count("the") < words(example.text).count("the")


def test_redetermined_by_hand() -> None:
    wording = "The {container} comes first, put the {object} in the {container}, the {container} in the {location}"
    chosen = {"object": "apple", "container": "box", "location": "bedroom"}
    example = fill("manipulation", "ship", wording, chosen)
    texts = {redetermined(example, random.Random(seed), part="held_out").text for seed in range(200)}
    assert "His box comes first, put their apple in the box, the box in its bedroom" in texts
    texts = {redetermined(example, random.Random(seed), part="training").text for seed in range(2000)}
    assert "box comes first, put an apple in the box, the box in bedroom" in texts
    assert not any("a apple" in text for text in texts)
