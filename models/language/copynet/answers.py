"""What the three systems answer to many texts: greedy decoding in batches, no threshold.

An answer is None when the output is malformed, or the text has no word. Answers with a task that does not exist, or
with more or fewer arguments than their task takes, are given as they are.
"""

from __future__ import annotations

from collections.abc import Sequence

from models.language.copynet.formulas import read_formula
from models.language.copynet.greedy import greedy_search
from models.language.copynet.queries import query_or_none, read_query
from models.language.copynet.search import MAX_OUTPUT
from models.language.copynet.tagged import arguments
from models.language.copynet.weights import Model
from models.language.tagging import tagged
from models.language.tokens import words
from models.logic import Formula
from models.queries import ContextualQuery

Phrases = tuple[str, ...]
"""The arguments of one text."""


def answers(model: Model, texts: Sequence[str]) -> list[ContextualQuery | None]:
    """CQ-CopyNet: the contextual query of each text."""
    return [read_query(spelled) for spelled in outputs(model, texts)]


def pos_answers(
    model: Model, texts: Sequence[str], *, named: Sequence[Phrases] | None = None
) -> list[ContextualQuery | None]:
    """CQ-CopyNet+POS: the network's task class, with the nouns and adjectives of the text as arguments.

    `named` is what `pos_arguments` gives for the texts, for callers that ask several networks the same ones.
    """
    tasks = outputs(model, texts, steps=1)
    found = pos_arguments(texts) if named is None else named
    return [
        query_or_none(spelled[0], phrases) if spelled else None for spelled, phrases in zip(tasks, found, strict=True)
    ]


def pos_arguments(texts: Sequence[str]) -> list[Phrases]:
    """What CQ-CopyNet+POS takes for the arguments of each text; that is most of the work of `pos_answers`."""
    return [arguments(tokens) for tokens in tagged(texts)]


def formulas(model: Model, texts: Sequence[str]) -> list[Formula | None]:
    """LTL-CopyNet: the grounded formula of each text; `models.world.resolve` says whether an environment has it."""
    return [read_formula(spelled, model.domain) for spelled in outputs(model, texts)]


def outputs(model: Model, texts: Sequence[str], *, steps: int = MAX_OUTPUT) -> list[tuple[str, ...]]:
    """The words of the network for each text, `END` last unless there are `steps` of them; none for a text of no word.

    Raises:
        TextTooLongError: a text is beyond the limits of `models.language.tokens`.
    """
    spoken = [words(text) for text in texts]
    vocabulary = model.vocabulary
    sources = [vocabulary.source(text) for text in spoken if text]
    said = iter(greedy_search(model.network, vocabulary, sources, steps=steps))
    asked = iter(sources)
    return [vocabulary.spell(next(said), next(asked).unknown) if text else () for text in spoken]
