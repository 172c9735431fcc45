"""Tasks that were taught by example: utterances, their wordings, and every command that says the same."""

from models.language.teaching.arguments import find_arguments
from models.language.teaching.gaps import Gap, OpenWordings, ends_open
from models.language.teaching.utterance import ExampleArgumentNotFoundError, ExampleMarkError, Utterance, is_marked
from models.language.teaching.wording import INTERROGATIVES, ExampleTooGeneralError, TaughtTranslator, Wording

__all__ = [
    "INTERROGATIVES",
    "ExampleArgumentNotFoundError",
    "ExampleMarkError",
    "ExampleTooGeneralError",
    "Gap",
    "OpenWordings",
    "TaughtTranslator",
    "Utterance",
    "Wording",
    "ends_open",
    "find_arguments",
    "is_marked",
]
