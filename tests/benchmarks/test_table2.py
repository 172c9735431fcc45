"""What is measured, and how it is counted; the measuring itself needs a server and minutes."""

from __future__ import annotations

from typing import Any

import pytest

from benchmarks.table2 import SENTENCES, Size, line, median, sizes
from models.world import compile_world, load_environment


@pytest.mark.parametrize("size", [Size((4, 1), 1), Size((4, 1), 3), Size((2, 2), 2), Size((3, 3), 1)])
@pytest.mark.parametrize("task", SENTENCES)
def test_a_world_has_the_states_of_its_size(task: str, size: Size) -> None:
    cells = size.grid[0] * size.grid[1]
    environment = load_environment(size.spec(task, "any"))
    assert compile_world(environment).size == cells * (cells + 1) * (cells + 2) ** size.toys
    assert environment.vocabulary.named("cylinder" if task == "ship" else "sphere")


def test_the_table_is_the_papers_grid_and_the_sweep_has_larger_ones() -> None:
    assert [(size.grid, size.toys) for size in sizes(sweep=False)] == [((4, 1), toys) for toys in (1, 2, 3, 4)]
    sweep = sizes(sweep=True)
    assert len(set(sweep)) == len(sweep)
    assert {size.toys for size in sweep} == {1, 2, 3}
    for toys in (1, 2, 3):
        cells = [size.grid[0] * size.grid[1] for size in sweep if size.toys == toys]
        assert cells == sorted(cells)


@pytest.mark.parametrize(
    ("seconds", "expected", "asked"),
    [
        ([9, 1, 2, 3], 2, 4),  # the first does not count
        ([30], 30, 1),  # but for a slow one, which is not asked for again
        ([15, 15, 16], 15.5, 3),  # after 20 s no other is begun
    ],
)
def test_the_median_leaves_the_first_out(seconds: list[float], expected: float, asked: int) -> None:
    numbers = []

    def ask(number: int) -> tuple[float, dict[str, Any]]:
        numbers.append(number)
        return seconds[number], {"number": number}

    assert median(ask, 3) == (expected, {"number": asked - 1})
    assert numbers == list(range(asked))


def test_rows() -> None:
    row = {"task": "ship", "grid": "4x1", "toys": 1, "states": 1200, "expected_steps": 5.0}
    row |= {"new_world_s": 0.01234, "stored_world_s": 1.5, "paper_s": 363.72}
    assert line(row) == "| ship | 4x1 | 1 | 1,200 | 5 | 12.3 ms | 1,500.0 ms | 363.7 s |"
    beyond = {"task": "ship", "grid": "6x6", "toys": 3, "beyond": "model-too-large"}
    assert line(beyond) == "| ship | 6x6 | 3 | | | model-too-large | | |"
    assert line(beyond).count("|") == line(row).count("|")
