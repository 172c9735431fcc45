"""Formulas made to be expensive end in a plan or a refusal, within limits of time and memory.

They are planned in a process of its own, which may take BUDGET seconds of its processor and MEMORY bytes for each; the
machine may be busy, so the clock allows for more. `CQLTL_HOSTILE=all` also tries those that are known to take longer
than a request may: the service runs them in a worker that is killed at its deadline.
"""

from __future__ import annotations

import json
import os
import resource
import select
import subprocess
import sys
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass

import pytest

from models.logic import MAX_DEPTH, FormulaSyntaxError, FormulaTooLargeError, parse

BUDGET = 10.0
CLOCK = 60.0
MEMORY = 2 * 2**30
LIBRARIES = 2**29
"""What the libraries take of the address space before anything is planned."""

SERVER = """
import json, resource, sys, time
from models.logic import FormulaTooLargeError, atoms, parse
from models.planning import plan
from tests.planning.doubles import ArrayWorld
moves = {s: {"on": {(s + 1) % 8: 0.9, (s * 3 + 2) % 8: 0.1}, "back": {s // 2: 1.0}} for s in range(7)}
for line in sys.stdin:
    begin = time.process_time()
    try:
        formula = parse(json.loads(line))
        names = {atom.function for atom in atoms(formula)}
        holds = {name: frozenset({i % 8, i * 3 % 8}) for i, name in enumerate(sorted(names))}
        answer = plan(ArrayWorld(8, moves, holds), formula).outcome
    except FormulaTooLargeError:
        answer = "too large"
    except Exception as error:
        answer = f"{type(error).__name__}: {error}"
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
    print(json.dumps([answer, time.process_time() - begin, peak]), flush=True)
"""


@dataclass
class Planner:
    """A process that plans one formula after the other, started again when one has ended it."""

    process: subprocess.Popen[str] | None = None

    def ask(self, text: str) -> tuple[str, float, int]:
        """How it ends, the processor's seconds, and the greatest memory so far; AssertionError where it does not."""
        if self.process is None:
            self.process = subprocess.Popen(
                [sys.executable, "-c", SERVER],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                text=True,
                env=os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)},
                preexec_fn=_limit,
            )
        process = self.process
        assert process.stdin is not None
        assert process.stdout is not None
        with suppress(BrokenPipeError):
            process.stdin.write(json.dumps(text) + "\n")
            process.stdin.flush()
        ready, _, _ = select.select([process.stdout], [], [], CLOCK)
        line = process.stdout.readline() if ready else ""
        if not line:
            self.close()
            raise AssertionError(f"{'ended the process' if ready else 'took more than a minute'}: {text[:100]}")
        answer, seconds, peak = json.loads(line)
        return answer, seconds, peak

    def close(self) -> None:
        if self.process is not None:
            self.process.kill()
            with suppress(BrokenPipeError):
                self.process.communicate()
            self.process = None


def _limit() -> None:
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY + LIBRARIES, MEMORY + LIBRARIES))


@pytest.fixture(scope="module")
def planner() -> Iterator[Planner]:
    made = Planner()
    yield made
    made.close()


def every(count: int, part: str, sign: str = "&") -> str:
    return f" {sign} ".join(part.format(i=i) for i in range(count))


def nested(parts: int, operators: str, *, right: bool) -> str:
    """p0, p1, ... with the operators in turn; the formula so far stands on the right or left of each."""
    text = "p0"
    for i in range(1, parts):
        operator = operators[i % len(operators)]
        text = f"p{i} {operator} ({text})" if right else f"({text}) {operator} p{i}"
    return text


def counter(bits: int) -> str:
    """A binary counter that starts at 0 and goes up for ever: 2 ** bits states in bits² letters."""
    parts = [every(bits, "!p{i}")]
    for bit in range(bits):
        carry = every(bit, "p{i}") or "true"
        parts += [
            f"G (({carry}) -> (X p{bit} <-> !p{bit}))",
            f"G (!({carry}) -> (X p{bit} <-> p{bit}))",
        ]
    return " & ".join(f"({part})" for part in parts)


def chained(depth: int, before: str, inside: str, after: str = "") -> str:
    return before * depth + inside + after * depth


FAMILIES: dict[str, list[str]] = {
    "goals": [every(n, "F p{i}") for n in (4, 8, 9, 12, 16, 17, 1_000)],
    "rounds": [every(n, "G F p{i}") for n in (3, 6, 7, 16, 1_000)],
    "one of many rounds": [every(n, "G F p{i}", "|") for n in (3, 9, 16, 17)],
    "one of many rests": [every(n, "F G p{i}", "|") for n in (3, 7, 9)],
    "responses": [every(n, "G (p{i} -> F q{i})") for n in (2, 4, 8, 500)],
    "fairness": [every(n, "(G F p{i} -> G F q{i})") for n in (2, 3, 4, 16)],
    "pairs": [every(n, "(G F p{i} & F G q{i})", "|") for n in (1, 2, 3)],
    "equivalences": [every(n, "G F p{i}", "<->") for n in (2, 3, 8)],
    "windows": [f"F (a & {'X ' * n}b)" for n in (4, 10, 13, 16, 60, 190)],
    "deadlines": [f"G (a -> {'X ' * n}b)" for n in (4, 8, 10, 14)],
    "windows again and again": [f"G F (a & {'X ' * n}b)" for n in (4, 8, 11)],
    "windows in the end": [f"F G (a | {'X ' * n}b)" for n in (4, 8)],
    "several windows": [every(n, "F (p{i} & X X p{i})") for n in (2, 3, 8, 500)],
    "windows side by side": [" & ".join(f"F (a & {'X ' * i}b)" for i in range(n)) for n in (2, 4, 6)],
    "counters": [counter(n) for n in (2, 4, 8)] + [f"!({counter(n)})" for n in (2, 4, 8)],
    "until, to the right": [nested(n, "U", right=True) for n in (4, 10, 16)],
    "until, to the left": [nested(n, "U", right=False) for n in (4, 8, 16)],
    "until and release, to the right": [nested(n, "UR", right=True) for n in (4, 7)],
    "until and release, to the left": [nested(n, "UR", right=False) for n in (4, 8, 10)],
    "weak and strong": [nested(n, "WM", right=right) for n in (4, 7) for right in (True, False)],
    "as deep as can be": [chained(MAX_DEPTH - 1, part, "a") for part in ("X ", "!", "F ", "G ")]
    + [chained(90, "F (a & X ", "b", ")"), chained(90, "G (a | F ", "b", ")")],
    "release below until": [chained(n, "(b U (a R ", "a", "))") for n in (4, 16, 32, 33, 60, 90)],
    "wide": [every(1_200, "F a") + " & F b", every(2_000, "a", "|"), every(400, "(a -> F b)")],
}
HEAVY = {
    "windows side by side 10": " & ".join(f"F (a & {'X ' * i}b)" for i in range(10)),
    "goals 11": every(11, "F p{i}"),
    "rests 11": every(11, "F G p{i}", "|"),
    "rests 16": every(16, "F G p{i}", "|"),
    "pairs 4": every(4, "(G F p{i} & F G q{i})", "|"),
    "pairs 5": every(5, "(G F p{i} & F G q{i})", "|"),
    "equivalences 4": every(4, "G F p{i}", "<->"),
    "equivalences 6": every(6, "G F p{i}", "<->"),
    "deadlines 20": f"G (a -> {'X ' * 20}b)",
    "windows in the end 12": f"F G (a | {'X ' * 12}b)",
    "until and release 8": nested(8, "UR", right=True),
    "until and release 10": nested(10, "UR", right=True),
    "until and release left 15": nested(15, "UR", right=False),
}


def check(planner: Planner, text: str) -> str:
    answer, seconds, peak = planner.ask(text)
    assert answer in ("solved", "unreachable", "unsatisfiable", "too large"), f"{answer}: {text[:100]}"
    assert seconds <= BUDGET, text[:100]
    assert peak <= MEMORY, text[:100]
    return answer


@pytest.mark.parametrize("family", FAMILIES)
def test_families_end(planner: Planner, family: str) -> None:
    answers = [check(planner, text) for text in FAMILIES[family]]
    assert set(answers) != {"too large"}, "the smallest of each family is planned"


@pytest.mark.skipif(os.environ.get("CQLTL_HOSTILE") != "all", reason="takes minutes: CQLTL_HOSTILE=all")
@pytest.mark.parametrize("name", HEAVY)
def test_heavier_ones_end(planner: Planner, name: str) -> None:
    check(planner, HEAVY[name])


@pytest.mark.parametrize("text", ["!" * MAX_DEPTH + "a", "(" * 60_000, every(4_000, "F p{i}"), "(" * 100_000])
def test_formulas_beyond_the_parser_are_refused(text: str) -> None:
    with pytest.raises((FormulaTooLargeError, FormulaSyntaxError)):
        parse(text)


def test_a_process_that_ends_is_told_from_a_refusal() -> None:
    planner = Planner()
    assert planner.ask("F a")[0] == "solved"
    assert planner.ask(every(17, "F p{i}"))[0] == "too large"
    process = planner.process
    assert process is not None
    process.kill()
    process.wait()
    with pytest.raises(AssertionError, match="ended the process"):
        planner.ask("F a")
    assert planner.ask("F a")[0] == "solved"
    planner.close()
