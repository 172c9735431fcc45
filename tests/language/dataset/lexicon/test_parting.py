"""Names parted in two so that no word is in both parts."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from models.language.dataset import Half
from models.language.dataset.lexicon.parting import content_words, part_names

_word = st.sampled_from([a + b for a in "bcdfgh" for b in ("at", "it", "ot", "ut")])
_names = st.lists(st.lists(_word, min_size=1, max_size=3).map(" ".join), max_size=40)


def test_content_words() -> None:
    assert content_words("ship of-the line", {"of", "the"}) == ("ship", "line")


@given(st.fixed_dictionaries({"a": _names, "b": _names}))
def test_no_word_in_both_parts(lists: dict[str, list[str]]) -> None:
    parts = part_names(lists)
    said = {half: {w for names in parts[half].values() for name in names for w in name.split()} for half in Half}
    assert not said[Half.TRAINING] & said[Half.HELD_OUT]
    for key, names in lists.items():
        kept = [*parts[Half.TRAINING][key], *parts[Half.HELD_OUT][key]]
        assert set(kept) <= set(names)
        assert len(set(kept)) == len(kept)
        assert {name for name in names if " " not in name} <= set(kept)  # one word is in one part
        assert parts == part_names({other: list(reversed(entries)) for other, entries in lists.items()})


def test_most_names_are_kept_and_shared_out() -> None:
    """Forty clusters of three names that share a word, with nothing between clusters: all can be kept."""
    names = [f"{kind}{i} thing{i}" for i in range(40) for kind in ("red", "big", "old")]
    parts = part_names({"things": names})
    training, held_out = parts[Half.TRAINING]["things"], parts[Half.HELD_OUT]["things"]
    assert len(training) + len(held_out) >= 114
    assert min(len(training), len(held_out)) >= 40


def test_functions_do_not_count() -> None:
    names = [f"cup{i} of tea{i}" for i in range(30)]
    parts = part_names({"cups": names}, functions=["of"])
    assert all(len(parts[half]["cups"]) >= 10 for half in Half)
    assert set(names) == {*parts[Half.TRAINING]["cups"], *parts[Half.HELD_OUT]["cups"]}
