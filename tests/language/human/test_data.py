"""The published files: what is read, and what is said of those that are missing or damaged."""

from __future__ import annotations

from pathlib import Path

import pytest

from models.language.human.data import (
    Command,
    HumanDataError,
    Utterance,
    read_commands,
    read_few,
    read_utterances,
)


def test_commands_are_read_with_their_folds(tmp_path: Path) -> None:
    rows = 'fold\ttext\tltl\tcanonical\n3\tgo to "the" red room .\tF R\tfinally ( the red room )\n'
    (tmp_path / "drone.tsv").write_text(rows)
    (tmp_path / "drone-few.tsv").write_text("text\tcanonical\nred room\tfinally ( the red room )\n")
    assert read_commands(tmp_path, "drone") == [Command('go to "the" red room .', "finally ( the red room )", 3)]
    assert read_few(tmp_path, "drone") == [Command("red room", "finally ( the red room )")]


def test_utterances_are_read_with_their_propositions(tmp_path: Path) -> None:
    rows = "pattern_type,props,utterance,ltl_formula\nvisit,\"['a', 'b']\",visit a and b,& F a F b\n"
    (tmp_path / "lang2ltl-lifted.csv").write_text(rows)
    assert read_utterances(tmp_path) == [Utterance("visit a and b", "visit", ("a", "b"), "& F a F b")]


def test_a_missing_file_says_in_one_line_where_to_get_it(tmp_path: Path) -> None:
    with pytest.raises(HumanDataError, match=r"cleanup\.tsv cannot be read .*Efficient-Eng-2-LTL") as refused:
        read_commands(tmp_path, "cleanup")
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("rows", "detail"),
    [
        ("fold\ttext\n0\tgo\n", "lacks the column canonical"),
        ("fold\ttext\tcanonical\n5\tgo\tfinally a\n", "line 2: the fold is '5'"),
        ("fold\ttext\tcanonical\n0\tgo\n", "line 2: a column is empty"),
    ],
)
def test_damaged_commands_are_refused_with_their_place(tmp_path: Path, rows: str, detail: str) -> None:
    (tmp_path / "pick.tsv").write_text(rows)
    with pytest.raises(HumanDataError, match=detail):
        read_commands(tmp_path, "pick")


@pytest.mark.parametrize("props", ["__import__('os')", "['ab']", "a", "3"])
def test_propositions_are_a_list_of_letters(tmp_path: Path, props: str) -> None:
    (tmp_path / "lang2ltl-lifted.csv").write_text(
        f'pattern_type,props,utterance,ltl_formula\nvisit,"{props}",visit a,F a\n'
    )
    with pytest.raises(HumanDataError, match="line 2: props is no list of letters"):
        read_utterances(tmp_path)
