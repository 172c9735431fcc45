"""The least confidence at which a reading is given, measured on commands and on texts that no task fits."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

from models.language.items import Item
from models.language.translator import CopyNetTranslator
from models.language.vocabulary import NO_TASK, Vocabulary


def best_threshold(
    translator: CopyNetTranslator, commands: Sequence[Item], refused: Sequence[Sequence[str]], *, hide: bool
) -> float:
    """The confidence that tells commands from other text with the fewest mistakes.

    The share of commands that are accepted and the share of other texts that are refused weigh the same. With `hide`
    every command counts twice: as it is, and with all its arguments hidden.
    """
    scores = [_score(translator, item.text, ()) for item in commands]
    if hide:
        scores += [_score(translator, item.text, [w for phrase in item.phrases for w in phrase]) for item in commands]
    others = [_score(translator, text, ()) for text in refused]
    return middle_of_best(scores, others)


def middle_of_best(wanted: Sequence[float], unwanted: Sequence[float]) -> float:
    """The threshold t that maximises the share of `wanted` >= t plus the share of `unwanted` < t.

    Both hold probabilities. Between two neighbouring values every t is as good; the widest gap's geometric middle is
    returned.
    """
    floor = 1e-6
    values = sorted({max(value, floor) for value in (*wanted, *unwanted)} | {floor, 1.0})

    def quality(t: float) -> float:
        accepted = sum(value >= t for value in wanted) / max(len(wanted), 1)
        refused = sum(value < t for value in unwanted) / max(len(unwanted), 1)
        return accepted + refused

    gaps = [(low, high, math.sqrt(low * high)) for low, high in pairwise(values)]
    return max(gaps, key=lambda gap: (round(quality(gap[2]), 9), gap[1] / gap[0]))[2]


def _score(translator: CopyNetTranslator, text: Sequence[str], hidden: Sequence[str]) -> float:
    """The probability of the best output; 0 when that is that no task fits."""
    vocabulary: Vocabulary = translator.vocabulary
    source = vocabulary.source(text, hidden=frozenset(hidden))
    hypotheses = translator.hypotheses(source)
    if not hypotheses or vocabulary.spell(hypotheses[0].words, source.unknown)[0] == NO_TASK:
        return 0.0
    return math.exp(hypotheses[0].log_probability)
