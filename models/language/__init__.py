"""English to contextual queries: tokens, datasets, CopyNet, beam search, part-of-speech tags.

`models.language.dataset` holds the datasets, `python -m models.language.train` makes the weights in `weights/`.
"""

from models.language.errors import TextTooLongError, TrainingError, VocabularyError, WeightsError
from models.language.tagging import part_of_speech
from models.language.tokens import MAX_CHARACTERS, MAX_WORDS
from models.language.translator import BEAM_WIDTH, CopyNetTranslator, Translation, Translator
from models.language.wording import ExampleArgumentNotFoundError, ExampleTooGeneralError, TaughtTranslator, Wording

__all__ = [
    "BEAM_WIDTH",
    "MAX_CHARACTERS",
    "MAX_WORDS",
    "CopyNetTranslator",
    "ExampleArgumentNotFoundError",
    "ExampleTooGeneralError",
    "TaughtTranslator",
    "TextTooLongError",
    "TrainingError",
    "Translation",
    "Translator",
    "VocabularyError",
    "WeightsError",
    "Wording",
    "part_of_speech",
]
