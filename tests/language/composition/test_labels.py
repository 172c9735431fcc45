"""Names with a letter or a number: how often, and that a text calls things alike."""

from __future__ import annotations

import random
from collections import Counter

from models.language.composition.labels import ALIKE, NAMES, STRAY, TEXTS, Told

DRAWN = 4_000


def test_some_texts_label_nearly_all_their_things_and_others_hardly_any() -> None:
    generator = random.Random(1)
    shares = Counter()
    for _ in range(DRAWN):
        told = Told.drawn(generator)
        labelled = sum(told.labels("object", generator) for _ in range(10))
        shares["most" if labelled >= 7 else "few" if labelled <= 3 else "some"] += 1
        assert not told.labels("color", generator)
    assert abs(shares["most"] / DRAWN - TEXTS) < 0.02
    assert shares["some"] < 0.01 * DRAWN
    assert STRAY < 0.1 < NAMES


def test_labels_of_a_text_are_of_one_kind_and_names_are_often_shared() -> None:
    generator = random.Random(2)
    shared = 0
    kinds = Counter()
    for _ in range(DRAWN):
        told = Told.drawn(generator)
        (first, one), (second, other) = (told.labelled(word, "place", generator) for word in ("gate", "ramp"))
        assert first == "gate"
        assert second in ("gate", "ramp")
        assert told.labelled("cup", "object", generator)[0] == "cup", "kinds of things have names of their own"
        shared += second == "gate"
        kinds[one.isdigit(), one.isalpha()] += 1
        assert (one.isdigit(), one.isalpha()) == (other.isdigit(), other.isalpha())
    assert abs(shared / DRAWN - ALIKE) < 0.03
    assert set(kinds) == {(True, False), (False, True), (False, False)}
