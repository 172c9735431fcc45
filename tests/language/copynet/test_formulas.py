"""The output language of formulas, against the grammar of LTL and the worlds' own reading of compound names."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.language.copynet.formulas import read_formula, spell_formula
from models.language.copynet.vocabulary import END
from models.language.dataset import Domain, Part, generate, grounding_environment
from models.logic import Atom, FormulaSyntaxError, Name, atoms, map_atoms, parse
from models.world import Environment, UnknownPropositionError, load_environment, resolve

MANIPULATION, NAVIGATION = Domain.MANIPULATION, Domain.NAVIGATION


@pytest.fixture(scope="module")
def environments() -> dict[tuple[Domain, Part], Environment]:
    return {(d, p): load_environment(grounding_environment(d, p)) for d in Domain for p in Part}


def _words(text: str) -> list[str]:
    return [*text.split(), END]


@pytest.mark.parametrize(
    ("domain", "text", "ltl"),
    [
        (
            MANIPULATION,
            "F ( cylinder_in_box & F ( cylinder_in_box & box_at_bedroom ) )",
            "F (in(cylinder, box) & F (in(cylinder, box) & at(box, bedroom)))",
        ),
        (MANIPULATION, "F ( robot_near_teddy_bear )", "F near(robot, teddy_bear)"),
        (MANIPULATION, "F ( holding_mug & mug_is_black )", "F (holding(mug) & colored(mug, black))"),
        (MANIPULATION, "F ( holding_orange & orange_is_orange )", "F (holding(orange) & colored(orange, orange))"),
        (MANIPULATION, "F ( bag_toy_in_bag & bag_at_kitchen )", "F (in(bag_toy, bag) & at(bag, kitchen))"),
        (NAVIGATION, "F ( bakery )", "F at(robot, bakery)"),
        (
            NAVIGATION,
            "F ( coffee shop & F ( town hall & F ( pier ) ) )",
            "F (at(robot, coffee_shop) & F (at(robot, town_hall) & F at(robot, pier)))",
        ),
    ],
)
def test_by_hand(domain: Domain, text: str, ltl: str) -> None:
    assert read_formula(_words(text), domain) == parse(ltl)
    assert spell_formula(parse(ltl), domain) == tuple(_words(text))


@pytest.mark.parametrize("domain", list(Domain))
@pytest.mark.parametrize("part", list(Part))
def test_the_formulas_of_the_datasets(
    environments: dict[tuple[Domain, Part], Environment], domain: Domain, part: Part
) -> None:
    """Read back as they were, and an environment with their objects has them."""
    data = generate(domain)
    examples = (data.seen if part is Part.SEEN else data.unseen)[::7]
    for ltl in {example.ltl for example in examples}:
        formula = read_formula(spell_formula(parse(ltl), domain), domain)
        assert formula == parse(ltl)
        assert resolve(formula, environments[domain, part]) == resolve(parse(ltl), environments[domain, part])


def test_compound_propositions_as_the_world_reads_them(
    environments: dict[tuple[Domain, Part], Environment],
) -> None:
    """The parser takes the words as nullary atoms, and `models.world` reads those by the display patterns."""
    for example in generate(MANIPULATION).unseen[::11]:
        spelled = spell_formula(parse(example.ltl), MANIPULATION)
        read = parse(" ".join(spelled[:-1]))
        assert not any(atom.arguments for atom in atoms(read))
        assert resolve(read, environments[MANIPULATION, Part.UNSEEN]) == read_formula(spelled, MANIPULATION)


def test_a_copied_word_is_a_proposition_that_no_environment_has(
    environments: dict[tuple[Domain, Part], Environment],
) -> None:
    formula = read_formula(_words("F ( mug )"), MANIPULATION)
    assert formula == parse("F mug")
    with pytest.raises(UnknownPropositionError):
        resolve(formula, environments[MANIPULATION, Part.UNSEEN])


@pytest.mark.parametrize("domain", list(Domain))
@pytest.mark.parametrize(
    "text",
    ["", "F", "F ( )", "F ( bakery", "bakery )", "F ( bakery & )", "F ( & bakery )", "bakery ( pier )", "( F ) bakery"],
)
def test_malformed(domain: Domain, text: str) -> None:
    assert read_formula(_words(text), domain) is None


def test_without_an_end() -> None:
    assert read_formula(["F", "(", "bakery", ")"], NAVIGATION) is None
    assert read_formula([], NAVIGATION) is None
    assert read_formula([END, END], NAVIGATION) is None


def test_words_of_manipulation_stand_alone() -> None:
    assert read_formula(_words("F ( holding_mug black )"), MANIPULATION) is None


@pytest.mark.parametrize(
    "ltl", ["G at(robot, bakery)", "F (at(robot, bakery) | at(robot, pier))", "F !at(robot, pier)"]
)
def test_what_no_task_says(ltl: str) -> None:
    with pytest.raises(ValueError, match="no task"):
        spell_formula(parse(ltl), NAVIGATION)


@given(st.lists(st.sampled_from(["F", "(", ")", "&", "holding_mug", "zorb", "o'hare", END]), max_size=14))
def test_any_output(spelled: list[str]) -> None:
    """It is read exactly when the grammar reads the text with every word in quotes, as a proposition of that name."""
    read = read_formula(spelled, MANIPULATION)
    body = [word if word in {"F", "(", ")", "&"} else f'"{word}"' for word in spelled[:-1]]
    try:
        expected = parse(" ".join(body))
    except FormulaSyntaxError:
        assert read is None
        return
    ended = spelled[-1:] == [END] and END not in spelled[:-1]
    applied = any(atom.arguments for atom in atoms(expected))
    assert (read is not None) == (ended and not applied)
    if read is not None:
        holding = Atom("holding", (Name("mug"),))
        assert read == map_atoms(expected, lambda atom: holding if atom.function == "holding_mug" else atom)
