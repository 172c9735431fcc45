"""The seven task classes of the paper: one example is enough, whichever it is, if its groundings are distinct."""

from __future__ import annotations

import pytest

from models.language.dataset import Domain, Example, Part, by_task, generate, grounding_environment
from models.logic import parse
from models.logic import to_text as formula_text
from models.queries import AmbiguousParameterMappingError, evaluate, learn
from models.queries import Example as Pair
from models.world import load_environment

EXPECTED = {
    "move_to": "F near(robot, $1)",
    "pickup": "F holding($1)",
    "pickup_colored": "F (holding($1) & colored($1, $2))",
    "ship": "F (in($1, $2) & F (in($1, $2) & at($2, $3)))",
    "navigate_one": "F at(robot, $1)",
    "navigate_two": "F (at(robot, $1) & F at(robot, $2))",
    "navigate_three": "F (at(robot, $1) & F (at(robot, $2) & F at(robot, $3)))",
}
CHOICES = {  # of example arguments: seen, unseen (Table I over the number of wordings)
    "move_to": (25, 6),
    "pickup": (25, 6),
    "pickup_colored": (150, 36),
    "ship": (225, 162),
    "navigate_one": (17, 6),
    "navigate_two": (204, 24),
    "navigate_three": (2448, 96),
}


def choices(domain: Domain, part: Part) -> dict[str, list[Example]]:
    """One example of each choice of arguments, by task; the wordings of a choice share its query and formula."""
    dataset = generate(domain)
    examples = dataset.seen if part is Part.SEEN else dataset.unseen
    once = {(example.query, example.ltl): example for example in examples}
    return by_task(once.values())


@pytest.mark.parametrize("part", list(Part))
@pytest.mark.parametrize("domain", list(Domain))
def test_every_example_gives_the_expected_template_or_is_refused(domain: Domain, part: Part) -> None:
    environment = load_environment(grounding_environment(domain, part))
    refused = []
    for task, examples in choices(domain, part).items():
        assert len(examples) == CHOICES[task][part is Part.UNSEEN]
        for example in examples:
            pair = Pair(example.query, parse(example.ltl))
            if not example.distinct:
                with pytest.raises(AmbiguousParameterMappingError):
                    learn([pair], environment)
                refused.append(str(example.query))
                continue
            template = learn([pair], environment)
            assert formula_text(template.formula) == EXPECTED[task], example
    homonyms = domain is Domain.MANIPULATION and part is Part.SEEN
    assert len(refused) == (4 if homonyms else 0)  # (orange, orange), and (bag, bag, place) for three places
    assert all("orange, orange" in query or "bag, bag" in query for query in refused)


@pytest.mark.parametrize("domain", list(Domain))
def test_templates_learned_from_seen_objects_ground_every_unseen_one(domain: Domain) -> None:
    seen = load_environment(grounding_environment(domain, Part.SEEN))
    unseen = load_environment(grounding_environment(domain, Part.UNSEEN))
    others = choices(domain, Part.UNSEEN)
    for task, examples in choices(domain, Part.SEEN).items():
        template = learn([Pair(examples[0].query, parse(examples[0].ltl))], seen)
        for example in others[task]:
            assert evaluate(template, example.query, unseen).formula == parse(example.ltl)
