"""English comparatives and superlatives."""

import pytest

from models.world.degrees import Degree, Scale, forms


@pytest.mark.parametrize(
    ("adjective", "comparative", "superlative"),
    [
        ("small", "smaller", "smallest"),
        ("large", "larger", "largest"),
        ("big", "bigger", "biggest"),
        ("hot", "hotter", "hottest"),
        ("red", "redder", "reddest"),
        ("heavy", "heavier", "heaviest"),
        ("gray", "grayer", "grayest"),
        ("tall", "taller", "tallest"),
        ("low", "lower", "lowest"),
        ("new", "newer", "newest"),
        ("cheap", "cheaper", "cheapest"),
        ("clean", "cleaner", "cleanest"),
        ("thin", "thinner", "thinnest"),
        ("good", "better", "best"),
        ("bad", "worse", "worst"),
        ("far", "further", "furthest"),
        ("expensive", "more expensive", "most expensive"),
    ],
)
def test_forms(adjective, comparative, superlative):
    comparatives, superlatives = forms((adjective,))
    assert tuple(comparative.split()) in comparatives
    assert tuple(superlative.split()) in superlatives


def test_a_scale_knows_which_end_its_words_are_for():
    scale = Scale("heat", ("cold", "mild", "very hot"), less=("icy",), more=("boiling",))
    assert scale.degrees["colder",] == scale.degrees["icier",] == Degree("heat", -1, superlative=False)
    assert scale.degrees["most", "very", "hot"] == scale.degrees["least", "cold"] == Degree("heat", 1, superlative=True)
    assert ("milder",) not in scale.degrees, "it is neither end"
    assert (scale.also_called("cold"), scale.also_called("mild"), scale.also_called("very hot")) == (
        ("icy",),
        (),
        ("boiling",),
    )
