"""The datasets of the paper's experiments (Table I), with vocabularies and wordings of our own."""

from models.language.dataset.corpus import Corpus, Domain, Part, Task, Word, parse_corpus, read_corpus
from models.language.dataset.examples import Dataset, Example, by_task, generate
from models.language.dataset.grounding import grounding_environment
from models.language.dataset.no_task import NoTask, no_task
from models.language.dataset.split import Split, split

__all__ = [
    "Corpus",
    "Dataset",
    "Domain",
    "Example",
    "NoTask",
    "Part",
    "Split",
    "Task",
    "Word",
    "by_task",
    "generate",
    "grounding_environment",
    "no_task",
    "parse_corpus",
    "read_corpus",
    "split",
]
