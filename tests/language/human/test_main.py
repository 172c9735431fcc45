"""The command that evaluates on human commands, and the table that it writes."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from models.language.human.__main__ import main
from models.language.human.tables import END, START, human_table, write_table

VALUES = {
    "tested": [100, 100],
    "right": [0.9, 0.92],
    "baseline": [0.8, 0.8],
    "duplicates": {"tested": 20, "right": 1.0, "baseline": 1.0},
    "others": {"tested": 0, "right": None, "baseline": None},
}


def test_the_table_has_the_mean_over_runs_beside_what_is_published() -> None:
    *_, row = human_table({"cleanup": {"folds": VALUES}}).splitlines()
    cells = [cell.strip() for cell in row.strip("|").split("|")]
    assert cells[:9] == ["cleanup", "five folds", "200", "91", "80", "95.51", "95.47", "97.84", "99.70"]
    assert cells[9:] == ["100 of 20", "none"]


def test_a_page_is_written_between_the_markers_only(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text(f"before\n{START}\nold\n{END}\nafter\n")
    write_table({"pick": {"few": VALUES}}, page)
    text = page.read_text()
    assert text.startswith(f"before\n{START}\n\n| commands")
    assert text.endswith(f"|\n\n{END}\nafter\n")
    assert "old" not in text
    page.write_text("nothing")
    with pytest.raises(ValueError, match="has no place"):
        write_table({}, page)


def test_a_missing_folder_is_said_in_one_line(tmp_path: Path) -> None:
    with pytest.raises(SystemExit, match=r"cannot be read.*Get drone"):
        main(["--data", str(tmp_path), "--quick", "--only", "drone", "--output", str(tmp_path / "out.json")])
    assert not (tmp_path / "out.json").exists()


def test_a_quick_run_measures_both_hold_outs(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    rows = ["pattern_type,props,utterance,ltl_formula"]
    formulas = {1: "F a", 2: "& F a F b", 3: "& F a & F b F c"}
    for length, formula in formulas.items():
        letters = list("abc"[:length])
        rows += [f'visit,"{letters}",go to {" and ".join(letters)} {word},{formula}' for word in ("now", "soon") * 5]
        rows += [f'never,"{letters}",avoid {" and ".join(letters)} {word},G ! {formula}' for word in ("ever", "x") * 5]
    (tmp_path / "lang2ltl-lifted.csv").write_text("\n".join(rows) + "\n")
    output = tmp_path / "out.json"
    main(["--data", str(tmp_path), "--quick", "--only", "lang2ltl", "--output", str(output)])
    results = json.loads(output.read_text())
    assert results["record"]["seeds"] == [0]
    assert results["lang2ltl"]["utterances"]["tested"] == [12]
    assert 0 <= results["lang2ltl"]["formulas"]["right"][0] <= 1
    printed = capsys.readouterr()
    assert "| lang2ltl | utterance hold-out | 12 |" in printed.out
    assert "network 2 of 2" in printed.err
