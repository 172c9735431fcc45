"""Further wordings of the task classes, beyond those of S, for a translator that knows more ways to say a thing."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from types import MappingProxyType

from pydantic import ConfigDict, RootModel

from models.errors import Place
from models.language.dataset.corpus import Domain, load_yaml, read_corpus, slots
from models.language.dataset.half import Half, half
from models.language.errors import VocabularyError


class _Paraphrases(RootModel[dict[Domain, dict[str, list[str]]]]):
    model_config = ConfigDict(frozen=True)


def paraphrases(domain: Domain | str, part: Half | str) -> Mapping[str, tuple[str, ...]]:
    """Wordings of every task class of a domain, by task, with slots in braces; every fifth is held out."""
    return _paraphrases(Domain(domain), Half(part))


def parse_paraphrases(text: str) -> dict[Domain, dict[str, list[str]]]:
    """Read the data file: wordings by domain and task class.

    Raises:
        VocabularyError: not YAML of this shape; a domain or task class is missing or unknown; a wording lacks a slot of
            its task or has another.
    """
    data = load_yaml(text, _Paraphrases).root
    problems = [
        *(Place(f"/{d}", f"{d} is missing") for d in Domain if d not in data),
        *(place for d, tasks in data.items() for place in _check(d, tasks)),
    ]
    if problems:
        raise VocabularyError(problems[0].detail, places=problems)
    return data


@cache
def _paraphrases(domain: Domain, part: Half) -> Mapping[str, tuple[str, ...]]:
    return MappingProxyType({task: half(wordings, part) for task, wordings in _read()[domain].items()})


@cache
def _read() -> dict[Domain, dict[str, list[str]]]:
    return parse_paraphrases((files("models.language.dataset") / "paraphrases.yaml").read_text(encoding="utf-8"))


def _check(domain: Domain, tasks: Mapping[str, list[str]]) -> list[Place]:
    arguments = {task.name: set(task.arguments) for task in read_corpus(domain).tasks}
    if set(tasks) != set(arguments):
        return [Place(f"/{domain}", f"the task classes of {domain} are {', '.join(arguments)}")]
    return [
        Place(f"/{domain}/{name}/{index}", f"{wording!r} must hold exactly the slots of {name}")
        for name, wordings in tasks.items()
        for index, wording in enumerate(wordings)
        if set(slots(wording)) != arguments[name]
    ]
