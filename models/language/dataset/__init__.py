"""The datasets of the paper's experiments (Table I) and beyond, with vocabularies and wordings of our own."""

from models.language.dataset.corpus import Corpus, Domain, Part, Task, Word, parse_corpus, read_corpus
from models.language.dataset.examples import Dataset, Example, Span, by_task, fill, generate
from models.language.dataset.grounding import grounding_environment
from models.language.dataset.half import Half
from models.language.dataset.lexicon import OpenWords, open_words
from models.language.dataset.no_task import NoTask, no_task
from models.language.dataset.open_world import OpenWorld, open_world
from models.language.dataset.paraphrases import paraphrases
from models.language.dataset.speech import Frames, framed, frames, redetermined
from models.language.dataset.split import Split, split
from models.language.dataset.typos import misspell, with_typo

__all__ = [
    "Corpus",
    "Dataset",
    "Domain",
    "Example",
    "Frames",
    "Half",
    "NoTask",
    "OpenWords",
    "OpenWorld",
    "Part",
    "Span",
    "Split",
    "Task",
    "Word",
    "by_task",
    "fill",
    "framed",
    "frames",
    "generate",
    "grounding_environment",
    "misspell",
    "no_task",
    "open_words",
    "open_world",
    "paraphrases",
    "parse_corpus",
    "read_corpus",
    "redetermined",
    "split",
    "with_typo",
]
