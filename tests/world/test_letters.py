"""A bound on how alike two texts are."""

from difflib import SequenceMatcher

from hypothesis import given
from hypothesis import strategies as st

from models.world.letters import LetterCounts

TEXTS = st.text(alphabet="abcdAB é箱\U0001f600", max_size=30) | st.text(
    alphabet=st.characters(exclude_categories=["Cs"]), max_size=30
)


@given(st.lists(TEXTS, max_size=8), TEXTS)
def test_no_ratio_exceeds_its_bound(texts, other):
    bounds = LetterCounts(texts).bounds(other)
    assert bounds.shape == (len(texts),)
    for text, bound in zip(texts, bounds, strict=True):
        if text or other:
            assert SequenceMatcher(None, text, other, autojunk=False).ratio() <= bound + 1e-12


def test_the_bound_is_the_common_letters():
    assert LetterCounts(["abc", "aab", "xyz"]).bounds("abb").tolist() == [4 / 6, 4 / 6, 0]
