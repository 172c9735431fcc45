"""Clauses completed by each other, with a table in the place of a translator."""

from __future__ import annotations

from collections.abc import Iterable

import pytest

from models.language import Translation
from models.language.composition.clauses import Clause, are_commands, is_bare, readings
from models.queries import parse_task

SAYS = {
    "go to the zoo": ["go(zoo)"],
    "go to the bank": ["go(bank)"],
    "go to the ball": ["go(ball)"],
    "go to the blue bag": ["go(blue bag)"],
    "go there": ["go(there)"],
    "visit the zoo": ["go(zoo)"],
    "visit bank": ["go(bank)"],
    "bank": ["go(bank)"],
    "pick up the ball": ["pickup(ball)"],
    "pick up the blue bag": ["pickup(blue bag)"],
    "pick up blue bag": ["pickup(blue bag)"],
    "put it in the box": ["put(it, box)"],
    "put the ball in the box": ["put(ball, box)"],
    "take it there": ["carry(it, there)"],
    "the ball in the box": ["put(ball, box)"],
    "put the bag in the box": ["put(bag, box)"],
    "put bag in the box": ["put(bag, box)"],
    "put the ball in the bag": ["put(ball, bag)"],
    "put the ball in the blue bag": ["put(ball, blue bag)"],
    "lift one of them": ["pickup(one)"],
    "grab the red ball": ["grab(ball, red)"],
}


class Table:
    def __call__(self, text: str, /) -> list[Translation]:
        return [Translation(parse_task(query), 0.8) for query in SAYS.get(text, [])]

    def prepare(self, texts: Iterable[str], /) -> None:
        pass


understand = Table()


def read(*texts: str, forbidden: tuple[int, ...] = ()) -> list[tuple[list[str], float]]:
    clauses = [Clause(number, tuple(text.split()), number in forbidden) for number, text in enumerate(texts, start=1)]
    found = readings(clauses, understand)
    return [([str(queries[number]) for number in sorted(queries)], share) for queries, share in found]


def test_clauses_that_say_all_themselves() -> None:
    assert read("pick up the ball", "go to the zoo") == [(["pickup(ball)", "go(zoo)"], pytest.approx(0.64))]


def test_a_bare_name_has_the_verb_of_the_clause_before_or_is_a_place() -> None:
    assert read("pick up the ball", "the blue bag") == [
        (["pickup(ball)", "pickup(blue bag)"], pytest.approx(0.8 * 0.8 * 0.75)),
        (["pickup(ball)", "go(blue bag)"], pytest.approx(0.8 * 0.8 * 0.25)),
    ]


def test_a_bare_name_that_comes_first_has_the_verb_of_the_one_after() -> None:
    assert read("bank", "visit the zoo")[0] == (["go(bank)", "go(zoo)"], pytest.approx(0.64))


def test_bare_names_alone_are_places() -> None:
    assert read("the bank", "the zoo") == [(["go(bank)", "go(zoo)"], pytest.approx(0.64))]


def test_what_is_avoided_is_a_place_first() -> None:
    assert [queries for queries, _ in read("pick up the ball", "the blue bag", forbidden=(2,))] == [
        ["pickup(ball)", "go(blue bag)"],
        ["pickup(ball)", "pickup(blue bag)"],
    ]


def test_a_bare_name_may_stand_for_the_first_or_the_last_that_another_names() -> None:
    """ "Put the ball in the box and the bag": the bag in the box, or the ball in the bag, or, hardly, go to the bag."""
    found = {queries[1]: share for queries, share in read("put the ball in the box", "the bag")}
    assert found == {"put(bag, box)": pytest.approx(0.64 * 0.75), "put(ball, bag)": pytest.approx(0.64 * 0.25)}


def test_a_bare_name_in_front_has_the_verb_in_front_of_all() -> None:
    """ "Put the bag or the ball in the box"."""
    clauses = [Clause(1, ("the", "bag"), False), Clause(2, ("the", "ball", "in", "the", "box"), False)]
    found = list(readings(clauses, understand, before=("put", "either")))
    assert [str(query) for query in found[0][0].values()] == ["put(bag, box)", "put(ball, box)"]


def test_a_bare_name_has_the_verb_that_leads_to_the_one_before() -> None:
    """ "Go to the zoo and pick up either the ball or the blue bag"."""
    first, second, third = ("go", "to", "the", "zoo"), ("the", "ball"), ("the", "blue", "bag")
    clauses = [
        Clause(1, first, False),
        Clause(2, second, False, lead=("and", "pick", "up", "either")),
        Clause(3, third, False, lead=("or",)),
    ]
    found = next(iter(readings(clauses, understand)))[0]
    assert [str(query) for query in found.values()] == ["go(zoo)", "pickup(ball)", "pickup(blue bag)"]


def test_pronouns_stand_for_what_was_named_before() -> None:
    assert read("pick up the ball", "put it in the box")[0] == (["pickup(ball)", "put(ball, box)"], pytest.approx(0.64))
    assert read("go to the zoo", "go there")[0][0] == ["go(zoo)", "go(zoo)"]


def test_the_likelier_antecedent_comes_first() -> None:
    found = read("put the ball in the box", "take it there")
    assert found[0][0] == ["put(ball, box)", "carry(ball, box)"]
    assert {tuple(queries) for queries, _ in found} > {("put(ball, box)", "carry(ball, box)")}
    assert sum(share for _, share in found) == pytest.approx(0.64)


def test_a_pronoun_for_nothing_and_a_clause_that_says_nothing_have_no_reading() -> None:
    assert read("put it in the box", "go to the zoo") == []
    assert read("pick up the ball", "sing a song") == []


@pytest.mark.parametrize(
    ("words", "bare"),
    [("the bank", True), ("bank", True), ("go to the bank", False), ("sing", True), ("pick up the ball", False)],
)
def test_bare_clauses(words: str, bare: bool) -> None:
    assert is_bare(words.split(), understand(words)) == bare


def test_a_verb_in_front_of_all_clauses_is_that_of_each() -> None:
    clauses = [Clause(1, ("the", "ball"), False), Clause(2, ("the", "blue", "bag"), False)]
    found = list(readings(clauses, understand, before=("pick", "up", "either")))
    assert [str(query) for query in found[0][0].values()] == ["pickup(ball)", "pickup(blue bag)"]


def test_there_is_not_the_place_that_is_forbidden() -> None:
    """ "Go to the zoo; don't go to the bank until you have been there": the zoo, although the bank is nearer."""
    (first, *_) = read("go to the zoo", "go to the bank", "go there", forbidden=(2, 3))
    assert first[0] == ["go(zoo)", "go(bank)", "go(zoo)"]


def test_it_is_what_the_last_clause_was_about() -> None:
    """ "Pick up the ball, put it in the box, then pick it up": the ball, although the box is nearer."""
    (first, *_) = read("pick up the ball", "put it in the box", "lift one of them")
    assert first[0] == ["pickup(ball)", "put(ball, box)", "pickup(ball)"]


def test_a_bare_name_has_the_verb_right_before_it() -> None:
    """ "Pick up the ball, then go to | the zoo": not "pick up the zoo"."""
    clauses = [
        Clause(1, ("pick", "up", "the", "ball"), False),
        Clause(2, ("zoo",), False, lead=("then", "go", "to", "the")),
    ]
    (first, *others) = readings(clauses, understand)
    assert [str(query) for query in first[0].values()] == ["pickup(ball)", "go(zoo)"]
    assert others == []


def test_what_says_by_itself_what_to_do_is_a_command() -> None:
    def commands(*texts: str) -> bool:
        return are_commands([Clause(1, tuple(text.split()), False) for text in texts], understand)

    assert commands("go to the zoo", "pick up the ball")
    assert not commands("go to the zoo", "the bank"), "it has no verb"
    assert not commands("go to the zoo", "sing a song"), "it is not understood"


def test_a_pronoun_stands_for_a_thing_with_what_describes_it() -> None:
    assert read("grab the red ball", "put it in the box")[0][0] == ["grab(ball, red)", "put(red ball, box)"]


def test_what_is_said_with_one_verb_is_rather_of_one_kind() -> None:
    """By hand: 0.2, 0.25, 0.2 and 0.25, of which the middle ones count a quarter, scaled to add up to 0.9 again."""

    class Doubtful(Table):
        def __call__(self, text: str, /) -> list[Translation]:
            shares = {"go to bay three": (0.5, 0.5), "go to bay seven": (0.4, 0.5), "see bay seven": (0.4, 0.5)}
            tasks = zip(("visit", "approach"), shares.get(text, ()), strict=False)
            return [Translation(parse_task(f"{task}({text[-9:].strip()})"), share) for task, share in tasks]

    def shares(*texts: str) -> dict[tuple[str, ...], float]:
        clauses = [Clause(number, tuple(text.split()), False) for number, text in enumerate(texts)]
        return {tuple(query.task for query in said.values()): share for said, share in readings(clauses, Doubtful())}

    assert shares("go to bay three", "go to bay seven") == {
        ("visit", "visit"): pytest.approx(0.32),
        ("visit", "approach"): pytest.approx(0.1),
        ("approach", "visit"): pytest.approx(0.08),
        ("approach", "approach"): pytest.approx(0.4),
    }
    assert shares("go to bay three", "see bay seven")["visit", "approach"] == pytest.approx(0.25), "another verb"
