"""The training split T."""

from __future__ import annotations

from collections import Counter

import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.language.dataset import Domain, Part, generate, read_corpus, split
from models.language.dataset.split import equal_quotas, proportional_quotas

SIZES = {Domain.MANIPULATION: 1920, Domain.NAVIGATION: 840}


@pytest.mark.parametrize("domain", list(Domain))
@pytest.mark.parametrize("seed", [0, 1, 2])
def test_sizes(domain: Domain, seed: int) -> None:
    part = split(domain, seed=seed)
    chosen = {example.text for example in (*part.training, *part.validation)}
    assert len(chosen) == len(part.training) + len(part.validation) == SIZES[domain]
    assert chosen <= {example.text for example in generate(domain).seen}
    assert len(part.validation) * 10 == SIZES[domain]
    tasks = {task.name for task in read_corpus(domain).tasks}
    assert {e.task for e in part.training} == {e.task for e in part.validation} == tasks


@pytest.mark.parametrize("domain", list(Domain))
def test_no_class_is_used_up(domain: Domain) -> None:
    part = split(domain)
    chosen = Counter(example.task for example in (*part.training, *part.validation))
    for task, count in Counter(example.task for example in generate(domain).seen).items():
        assert chosen[task] <= count / 2
    assert set(chosen) == {task.name for task in read_corpus(domain).tasks}


@pytest.mark.parametrize("domain", list(Domain))
def test_training_speaks_of_every_seen_word(domain: Domain) -> None:
    spoken = {phrase for example in split(domain).training for phrase in example.query.arguments}
    seen = read_corpus(domain).vocabulary[Part.SEEN]
    assert spoken == {word.phrase for entries in seen.values() for word in entries}


def test_seeds() -> None:
    assert split("manipulation", seed=1) == split("manipulation", seed=1)
    assert split("manipulation", seed=1) != split("manipulation", seed=2)


@given(st.dictionaries(st.sampled_from("abcdef"), st.integers(0, 50), min_size=1), st.data())
def test_equal_quotas(limits: dict[str, int], data: st.DataObject) -> None:
    total = data.draw(st.integers(0, sum(limits.values())))
    quotas = equal_quotas(total, limits)
    assert sum(quotas.values()) == total
    for task, quota in quotas.items():
        assert quota <= limits[task]
        # below its limit nobody gets less than another, but for one that does not divide
        assert quota == limits[task] or quota >= max(quotas.values()) - 1


def test_quotas_that_cannot_be() -> None:
    with pytest.raises(ValueError, match="cannot draw 5 of 4"):
        equal_quotas(5, {"a": 4})


@given(st.dictionaries(st.sampled_from("abcdef"), st.integers(20, 500), min_size=1))
def test_proportional_quotas(sizes: dict[str, int]) -> None:
    total = round(sum(sizes.values()) / 10)
    quotas = proportional_quotas(total, sizes)
    assert sum(quotas.values()) == total
    for task, quota in quotas.items():
        assert abs(quota - sizes[task] * total / sum(sizes.values())) <= 1
