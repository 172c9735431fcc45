"""`cqltl export` and `cqltl import`, in this process."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from service.__main__ import main

COUNTER = """mdp
const int N;
module counter
  x : [0..N] init 0;
  [go] x < N -> 0.9 : (x' = x + 1) + 0.1 : true;
endmodule
label "full" = x = N;
"""


@pytest.fixture(autouse=True)
def own_store(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CQLTL_DATA_DIR", str(tmp_path / "data"))


def test_a_stored_environment_in_both_languages(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["export", "toys-4x1-sphere", "--ltl", "F holding(sphere)"]) == 0
    text = capsys.readouterr().out
    assert text.startswith('// Pmax=? [ (F "holding_sphere") ]\n')
    assert "\nmdp\n" in text
    assert 'label "holding_sphere"' in text
    assert main(["export", "toys-4x1-sphere", "--format", "drn"]) == 0
    assert "@nr_states\n116\n" in capsys.readouterr().out


def test_the_product_with_a_formula(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "product.drn"
    task = ["export", "toys-4x1-sphere", "--ltl", "F holding(sphere)", "--product"]
    assert main([*task, "--output", str(file)]) == 0
    assert " accepting" in file.read_text()
    assert capsys.readouterr().out == ""
    assert main([*task, "--format", "prism"]) == 2
    assert "--product needs --ltl, and is written in DRN" in capsys.readouterr().err


def test_an_environment_in_a_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "tiny.json"
    move = {"from": 0, "action": "go", "to": [[1, 1.0]]}
    file.write_text(
        json.dumps({"name": "tiny", "kind": "explicit", "states": 2, "labels": {"b": [1]}, "transitions": [move]})
    )
    assert main(["export", "--environment-file", str(file)]) == 0
    assert "[go]" in capsys.readouterr().out


def test_an_environment_of_ones_own_is_stored_replaced_and_planned(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "hut.yaml"
    hut = """
        name: hut
        kind: oomdp
        domain: toys
        grid: {class: cell, map: [AB], names: {A: den, B: 2024-01-01}}
        objects: {ball: {class: toy}}
        state: {robot: {at: den}, ball: {in: den}}
    """
    file.write_text(hut)
    assert main(["import", str(file)]) == 0
    printed = capsys.readouterr()
    assert printed.out == "hut: 6 states, 6 actions\n"
    assert "stored in sqlite:///" in printed.err
    assert main(["plan", "--ltl", 'F at(ball, "2024-01-01")', "--environment", "hut"]) == 0
    assert json.loads(capsys.readouterr().out)["expected_steps"] == 3
    assert main(["import", str(file)]) == 1
    assert "environment-exists" in capsys.readouterr().err
    file.write_text(hut.replace("ball: {in: den}", 'ball: {in: "2024-01-01"}'))
    assert main(["import", str(file), "--replace"]) == 0
    assert main(["plan", "--ltl", 'F at(ball, "2024-01-01")', "--environment", "hut"]) == 0
    assert json.loads(capsys.readouterr().out.partition("\n")[2])["expected_steps"] == 0
    file.write_text(hut.replace("ball: {in: den}", "ball: {in: cellar}"))
    assert main(["import", str(file), "--name", "cabin", "--replace"]) == 1
    assert '"pointer": "/state/ball/in"' in capsys.readouterr().err
    assert main(["import", str(file), "--constant", "N=3"]) == 2
    assert main(["import", str(tmp_path / "counter.prism")]) == 2
    assert "--name" in capsys.readouterr().err


def test_a_file_that_is_no_environment_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "list.json"
    file.write_text("[1]")
    assert main(["import", str(file), "--name", "list", "--replace"]) == 1
    assert "urn:cqltl:problem:validation" in capsys.readouterr().err
    file.write_text("{a: ")
    with pytest.raises(SystemExit, match=r"list\.json"):
        main(["import", str(file)])
    with pytest.raises(SystemExit, match="No such file"):
        main(["import", str(tmp_path / "none.yaml")])


def test_a_prism_model_is_stored_and_planned(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("stormpy")
    file = tmp_path / "counter.prism"
    file.write_text(COUNTER)
    assert main(["import", str(file), "--name", "counter", "--constant", "N=3"]) == 0
    assert capsys.readouterr().out == "counter: 4 states, 3 transitions\n"
    assert main(["plan", "--ltl", "F full", "--environment", "counter"]) == 0
    assert json.loads(capsys.readouterr().out)["expected_steps"] == pytest.approx(3 / 0.9)
    assert main(["import", str(file), "--name", "counter", "--constant", "N=3"]) == 1
    assert "environment-exists" in capsys.readouterr().err


def test_rewards_become_costs(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("stormpy")
    file = tmp_path / "counter.prism"
    steps, time = (f'rewards "{name}" true : {cost}; endrewards\n' for name, cost in (("steps", 1), ("time", 4)))
    file.write_text(COUNTER + steps + time)
    arguments = ["import", str(file), "--constant", "N=3"]
    assert main([*arguments, "--name", "counted"]) == 0
    assert capsys.readouterr().out == "counted: 4 states, 3 transitions\n"
    assert main([*arguments, "--name", "timed", "--rewards", "time"]) == 0
    assert capsys.readouterr().out == "timed: 4 states, 3 transitions, with costs\n"
    assert main(["plan", "--ltl", "F full", "--environment", "timed"]) == 0
    assert json.loads(capsys.readouterr().out)["expected_steps"] == pytest.approx(4 * 3 / 0.9)
    assert main([*arguments, "--name", "other", "--rewards", "energy"]) == 1
    assert "it has steps, time" in capsys.readouterr().err


def test_refusals_say_what_is_wrong(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("stormpy")
    assert main(["export", "atlantis"]) == 1
    assert "atlantis" in capsys.readouterr().err
    assert main(["export", "toys-4x1-sphere", "--ltl", "F flying(sphere)"]) == 1
    assert "flying" in capsys.readouterr().err
    file = tmp_path / "counter.prism"
    file.write_text(COUNTER)
    assert main(["import", str(file), "--name", "counter"]) == 1
    assert "N" in capsys.readouterr().err
    file.write_text(COUNTER.replace("endmodule", "endmodul"))
    assert main(["import", str(file), "--name", "counter", "--constant", "N=3"]) == 1
    assert "^" in capsys.readouterr().err
