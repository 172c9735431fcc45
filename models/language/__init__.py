"""English to contextual queries: the default translator, the paper's systems, datasets, training, experiments.

`python -m models.language.train` makes the weights in `weights/`, `python -m models.language.evaluate` measures them.
What is only needed for that, and the paper's systems (`models.language.copynet`), is not imported here.
"""

from models.language.composition import ComposedTranslator
from models.language.errors import TextTooLongError, TrainingError, VocabularyError, WeightsError
from models.language.spans import SpanTranslator
from models.language.tagging import part_of_speech
from models.language.teaching import (
    ExampleArgumentNotFoundError,
    ExampleMarkError,
    ExampleTooGeneralError,
    TaughtTranslator,
    Utterance,
    Wording,
    find_arguments,
    is_marked,
)
from models.language.tokens import MAX_CHARACTERS, MAX_WORDS
from models.language.translation import BEAM_WIDTH, Translation, Translator

__all__ = [
    "BEAM_WIDTH",
    "MAX_CHARACTERS",
    "MAX_WORDS",
    "ComposedTranslator",
    "ExampleArgumentNotFoundError",
    "ExampleMarkError",
    "ExampleTooGeneralError",
    "SpanTranslator",
    "TaughtTranslator",
    "TextTooLongError",
    "TrainingError",
    "Translation",
    "Translator",
    "Utterance",
    "VocabularyError",
    "WeightsError",
    "Wording",
    "find_arguments",
    "is_marked",
    "part_of_speech",
]
