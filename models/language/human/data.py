"""The published commands that people wrote, as they lie in a folder. They are not part of this repository."""

from __future__ import annotations

import ast
import csv
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from models.language.errors import VocabularyError
from models.language.human.spelling import in_one_spelling

FOLDS = 5
SOURCES = (
    "drone, cleanup, pick and their -few files: github.com/UM-ARM-Lab/Efficient-Eng-2-LTL (Pan et al. 2023); "
    "lang2ltl-lifted.csv: github.com/h2r/Lang2LTL"
)


class HumanDataError(VocabularyError):
    """A file of commands is missing, or not what it must be."""


@dataclass(frozen=True, slots=True)
class Command:
    """What was said, the formula that it means, and the published fold that it is tested in."""

    text: str
    formula: str
    fold: int | None = None


@dataclass(frozen=True, slots=True)
class Utterance:
    """A command of Lang2LTL about waypoints, which are letters in it: its family, arguments and lifted formula."""

    text: str
    family: str
    propositions: tuple[str, ...]
    formula: str


def read_commands(folder: Path, name: str) -> list[Command]:
    """All commands of `NAME.tsv`: tab-separated, with the columns fold, text and canonical.

    Raises:
        HumanDataError: the file is missing or damaged; the message says where to get it.
    """
    file = folder / f"{name}.tsv"
    commands = []
    for line, row in _rows(file, ("fold", "text", "canonical"), delimiter="\t"):
        if row["fold"] not in map(str, range(FOLDS)):
            raise HumanDataError(f"{file}, line {line}: the fold is {row['fold']!r}, not 0 to {FOLDS - 1}")
        commands.append(Command(row["text"], in_one_spelling(row["canonical"]), int(row["fold"])))
    return commands


def read_few(folder: Path, name: str) -> list[Command]:
    """The published small training set of `NAME-few.tsv`; raises as `read_commands` does."""
    rows = _rows(folder / f"{name}-few.tsv", ("text", "canonical"), delimiter="\t")
    return [Command(row["text"], in_one_spelling(row["canonical"])) for _, row in rows]


def read_utterances(folder: Path) -> list[Utterance]:
    """The lifted commands of Lang2LTL, `lang2ltl-lifted.csv`; raises as `read_commands` does."""
    file = folder / "lang2ltl-lifted.csv"
    columns = ("pattern_type", "props", "utterance", "ltl_formula")
    return [
        Utterance(row["utterance"], row["pattern_type"], _propositions(row["props"], file, line), row["ltl_formula"])
        for line, row in _rows(file, columns, delimiter=",")
    ]


def _rows(file: Path, columns: tuple[str, ...], *, delimiter: str) -> Iterator[tuple[int, Mapping[str, str]]]:
    """The rows with their line numbers."""
    quotes = None if delimiter == "\t" else '"'  # a tab-separated file has none
    try:
        with file.open(encoding="utf-8", newline="") as lines:
            reader = csv.DictReader(
                lines, delimiter=delimiter, quotechar=quotes, quoting=csv.QUOTE_MINIMAL if quotes else csv.QUOTE_NONE
            )
            if missing := sorted(set(columns) - set(reader.fieldnames or ())):
                raise HumanDataError(f"{file} lacks the column {missing[0]}")
            for row in reader:
                if any(not isinstance(row[column], str) or not row[column].strip() for column in columns):
                    raise HumanDataError(f"{file}, line {reader.line_num}: a column is empty")
                yield reader.line_num, row
    except OSError as error:
        raise HumanDataError(f"{file} cannot be read ({error.strerror}). Get {SOURCES}") from None
    except UnicodeDecodeError as error:
        raise HumanDataError(f"{file} is damaged: {error}") from None


def _propositions(text: str, file: Path, line: int) -> tuple[str, ...]:
    """The letters of a list as Python writes it."""
    try:
        letters = ast.literal_eval(text)
    except (SyntaxError, ValueError):
        letters = None
    if not isinstance(letters, list) or not all(isinstance(letter, str) and len(letter) == 1 for letter in letters):
        raise HumanDataError(f"{file}, line {line}: props is no list of letters: {text!r}")
    return tuple(letters)
