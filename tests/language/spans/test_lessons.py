"""What the default translator is fitted to: it must never hold what it will be measured on."""

from __future__ import annotations

import random

import pytest

from models.language.dataset import Domain, Part, generate, no_task, open_words, paraphrases, read_corpus
from models.language.spans.items import Item
from models.language.spans.lessons import COMMANDS, OTHER_JOBS, REFUSALS, Lessons, misspelled
from models.language.tokens import words


@pytest.fixture(scope="module")
def lessons() -> Lessons:
    return Lessons.load(seed=0)


def words_of(part: Part) -> set[str]:
    lists = [entries for domain in Domain for entries in read_corpus(domain).vocabulary[part].values()]
    return {word for entries in lists for entry in entries for word in entry.phrase.split()}


def held_out_words() -> set[str]:
    held = open_words("held_out")
    return {w for words in (held.objects, held.colors, held.containers, held.places) for p in words for w in p.split()}


def test_an_epoch_names_nothing_of_u_or_of_the_held_out_lists(lessons: Lessons) -> None:
    items = lessons.epoch(random.Random(1))
    named = {item.text[place] for item in items for place in item.mentioned}
    seen = words_of(Part.SEEN) | lessons.names.words
    # what is made up or misspelt may fall on any word, once in a while; nothing is drawn from the lists
    assert lessons.names.words & (words_of(Part.UNSEEN) | held_out_words()) == {"of"}
    assert len(named & seen) > 500


def test_an_epoch_has_every_task_and_no_held_out_command(lessons: Lessons) -> None:
    items = lessons.epoch(random.Random(2))
    tasks = [task.name for domain in Domain for task in read_corpus(domain).tasks]
    assert {task: sum(item.task == task for item in items) for task in (*tasks, None)} == {
        **dict.fromkeys(tasks, COMMANDS),
        None: REFUSALS + OTHER_JOBS,
    }
    for item in items:
        if item.task is not None:
            assert all(item.mentions), item
    read = {item.text for item in items}
    assert not read & {words(text) for text in no_task().held_out}


def test_the_checks_are_commands_of_t_that_are_not_fitted_to(lessons: Lessons) -> None:
    fitted = {words(example.text) for group in lessons.training.values() for example in group}
    checked = [words(example.text) for example in lessons.validation]
    assert len(checked) == 192 + 84  # a tenth of each T
    assert not fitted & set(checked)
    unseen = {words(example.text) for domain in Domain for example in generate(domain).unseen}
    assert not (fitted | set(checked)) & unseen


def test_spoken_words_are_those_of_wordings_and_not_of_names(lessons: Lessons) -> None:
    spoken = set(lessons.words)
    assert {"put", "the", "then", "please", "go", "hold", "before"} <= spoken
    assert not {"cylinder", "bedroom", "basket", "purple", "bakery"} & spoken
    assert not spoken & words_of(Part.UNSEEN)
    held = {w for d in Domain for group in paraphrases(d, "held_out").values() for text in group for w in text.split()}
    assert held  # there are wordings that the network will only be measured on


def test_a_slip_changes_one_word(lessons: Lessons) -> None:
    generator = random.Random(0)
    item = Item(("take", "the", "garlic", "press"), "pickup", (((2, 4),),))
    for _ in range(50):
        other = misspelled(item, generator)
        changed = [place for place in range(4) if other.text[place] != item.text[place]]
        assert len(changed) == 1
        assert other.mentions == item.mentions
    assert misspelled(Item(("go", "up")), generator).text == ("go", "up")
