"""Translators are loaded when they are asked for, once."""

from __future__ import annotations

import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from typing import get_args

import pytest

from models.language import Translation, Translator
from service.translators import DEFAULT, TranslatorKey, Translators


class Silent:
    """Understands nothing."""

    def translate(self, text: str, *, candidates: int = 1) -> tuple[Translation, ...]:
        return ()


def test_each_is_loaded_once_by_whoever_asks_first() -> None:
    made: list[Silent] = []

    def load() -> Silent:
        time.sleep(0.05)  # long enough for every thread to ask
        made.append(Silent())
        return made[-1]

    translators = Translators({"a": load, "b": load}, {})
    assert made == []
    with ThreadPoolExecutor(8) as pool:
        found: list[Translator] = list(pool.map(lambda _: translators.queries("a"), range(8)))
    assert [each is made[0] for each in found] == [True] * 8
    assert translators.queries("b") is not made[0]
    assert len(made) == 2


def test_one_that_cannot_be_loaded_is_tried_again() -> None:
    answers = iter([OSError("no such file"), Silent()])

    def load() -> Silent:
        answer = next(answers)
        if isinstance(answer, OSError):
            raise answer
        return answer

    translators = Translators({"a": load}, {})
    with pytest.raises(OSError, match="no such file"):
        translators.queries("a")
    assert isinstance(translators.queries("a"), Silent)


def test_every_name_of_the_contract_is_a_translator() -> None:
    translators = Translators.shipped()
    kinds = {name: translators.gives_formulas(name) for name in get_args(TranslatorKey)}
    assert kinds == {DEFAULT: False, "cq-copynet": False, "cq-copynet-pos": False, "ltl-copynet": True}


def test_the_default_one_needs_neither_torch_nor_scipy() -> None:
    """They take seconds to load; a service that starts waits for neither, and nor does a worker."""
    used = """
import sys
from service.app import create_app
from service.translators import Translators
from models.language.hearing import Lessons
shipped = Translators.shipped()
assert shipped.queries("default").translate("put the mug in the crate and then go to the attic")
assert shipped.matcher.known([])== []
print(sorted({"torch", "scipy", "spacy"} & set(sys.modules)))
from models.language.tagging import part_of_speech
assert part_of_speech("pick up the orange", "orange") == "noun"
print("spacy" in sys.modules, "torch" in sys.modules)
import torch
"""
    found = subprocess.run([sys.executable, "-c", used], capture_output=True, text=True, check=True, timeout=60)
    assert found.stdout == "[]\nTrue False\n"
    assert not found.stderr
