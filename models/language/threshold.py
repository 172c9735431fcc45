"""The least confidence at which a reading is given, measured on commands and on texts that no task fits."""

from __future__ import annotations

import math
from collections.abc import Sequence

from models.language.items import Item
from models.language.translator import CopyNetTranslator
from models.language.vocabulary import NO_TASK, Vocabulary


def best_threshold(
    translator: CopyNetTranslator, commands: Sequence[Item], refused: Sequence[Sequence[str]]
) -> float:
    """The confidence that tells commands from other text with the fewest mistakes.

    Commands are counted twice, as they are and with every argument hidden; the two kinds weigh the same in sum. Of
    equally good thresholds the middle is taken, on a logarithmic scale.
    """
    scores = [_score(translator, item.text, ()) for item in commands]
    scores += [_score(translator, item.text, [word for phrase in item.phrases for word in phrase]) for item in commands]
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

    gaps = [(low, high, math.sqrt(low * high)) for low, high in zip(values, values[1:], strict=False)]
    return max(gaps, key=lambda gap: (round(quality(gap[2]), 9), gap[1] / gap[0]))[2]


def _score(translator: CopyNetTranslator, text: Sequence[str], hidden: Sequence[str]) -> float:
    """The probability of the best output; 0 when that is that no task fits."""
    vocabulary: Vocabulary = translator.vocabulary
    source = vocabulary.source(text, hidden=frozenset(hidden))
    hypotheses = translator.hypotheses(source)
    if not hypotheses or vocabulary.spell(hypotheses[0].words, source.unknown)[0] == NO_TASK:
        return 0.0
    return math.exp(hypotheses[0].log_probability)
