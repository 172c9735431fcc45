"""Both operators against plain loops, and their direct counterpart."""

from __future__ import annotations

import random
from itertools import pairwise

import numpy as np
import pytest
import torch

from models.planning import DeviceUnavailableError
from models.planning.choices import Choices, Vector
from models.planning.direct import probability_bounds
from models.planning.operator import KernelOperator, Operator, operator_of
from models.planning.options import Options
from models.planning.probability import iterate_intervals
from models.planning.ragged import offsets
from models.planning.tensors import TensorOperator
from tests.planning.doubles import DEVICES


def random_choices(seed: int, *, leak: float = 0.05) -> Choices:
    """Choices under which every policy leaves the unknowns for sure."""
    pick = random.Random(seed)
    unknowns = pick.randint(1, 8)
    owner = [*range(unknowns), *(pick.randrange(unknowns) for _ in range(pick.randrange(12)))]
    pick.shuffle(owner)
    rows = [pick.sample(range(unknowns), pick.randint(0, min(3, unknowns))) for _ in owner]
    stay = [pick.random() * (1 - leak) if row else 0.0 for row in rows]
    order = np.argsort(owner, kind="stable")
    rows, stay = [rows[i] for i in order], [stay[i] for i in order]
    return Choices(
        first_choice=offsets(np.bincount(owner)),
        constant=np.array([pick.random() * (1 - chance) for chance in stay]),
        first_outcome=offsets(np.array([len(row) for row in rows])),
        successor=np.array([u for row in rows for u in row], dtype=np.int32),
        probability=np.array([chance / len(row) for row, chance in zip(rows, stay, strict=True) for _ in row]),
    )


def worth(choices: Choices, x: Vector) -> list[float]:
    result = []
    for c, constant in enumerate(choices.constant):
        outcomes = range(choices.first_outcome[c], choices.first_outcome[c + 1])
        result.append(constant + sum(choices.probability[i] * x[choices.successor[i]] for i in outcomes))
    return result


def operators(choices: Choices) -> list[Operator]:
    return [KernelOperator(choices), *(TensorOperator(choices, torch.device(device)) for device in DEVICES)]


def owned(choices: Choices, values: list[float]) -> list[list[float]]:
    return [values[a:b] for a, b in pairwise(choices.first_choice.tolist())]


def test_greedy_takes_the_best_choice_of_every_unknown() -> None:
    for seed in range(50):
        choices = random_choices(seed)
        x = np.random.default_rng(seed).random(choices.unknowns)
        values = worth(choices, x)
        for maximise, best in ((True, max), (False, min)):
            for operator in operators(choices):
                chosen, above, below = operator.greedy(operator.vector(x), maximise=maximise, tie=1e-12)
                assert np.searchsorted(choices.first_choice, chosen, side="right").tolist() == [
                    *range(1, choices.unknowns + 1)
                ]
                assert [values[c] for c in chosen] == pytest.approx([best(v) for v in owned(choices, values)])
                assert above == pytest.approx(max(values[c] - x[u] for u, c in enumerate(chosen)))
                assert below == pytest.approx(max(x[u] - best(v) for u, v in enumerate(owned(choices, values))))


def test_sweeps_converge_to_the_fixed_point_of_the_loops() -> None:
    for seed in range(12):
        choices = random_choices(seed)
        for operator in operators(choices):
            lower, upper, least = operator.vector(0.0), operator.vector(1.0), operator.vector(0.0)
            for sweep in range(1, 2000):
                gap = operator.narrow(lower, upper, sweep)
                rise = operator.improve(least)
            assert gap < 1e-9
            assert rise < 1e-12
            for x, best in ((operator.numpy(lower), max), (operator.numpy(upper), max), (operator.numpy(least), min)):
                again = [best(values) for values in owned(choices, worth(choices, x))]
                assert again == pytest.approx(x.tolist(), abs=1e-9)


def test_a_chain_settles() -> None:
    for seed in range(30):
        choices = random_choices(seed)
        chain = choices.only(choices.first_choice[:-1])
        for operator in operators(chain):
            x = operator.vector(0.0)
            for sweep in range(1, 2000):
                change = operator.settle(x, sweep)
            assert change < 1e-12
            assert worth(chain, operator.numpy(x)) == pytest.approx(operator.numpy(x).tolist(), abs=1e-11)


@pytest.mark.parametrize("size", [2, 3, 50])
@pytest.mark.parametrize("stay", [0.9, 0.999])
def test_what_is_extrapolated_converges_to_the_values_also_on_circles(size: int, stay: float) -> None:
    circle = Choices(
        first_choice=np.arange(size + 1, dtype=np.int32),
        constant=np.ones(size),
        first_outcome=np.arange(size + 1, dtype=np.int32),
        successor=((np.arange(size) + 1) % size).astype(np.int32),
        probability=np.full(size, stay),
    )
    x = (operator := KernelOperator(circle)).vector(0.0)
    x[::2] = 10.0
    sweeps = next(sweep for sweep in range(10_000) if operator.improve(x) <= 1e-11)
    assert x == pytest.approx(1.0 / (1.0 - stay), rel=1e-8)
    assert sweeps < 3_000  # about what it takes without


def test_extrapolation_saves_sweeps_where_values_creep() -> None:
    size, draw = 200, np.random.default_rng(0)
    slow = Choices(
        first_choice=np.arange(size + 1, dtype=np.int32),
        constant=np.ones(size),
        first_outcome=np.arange(0, 3 * size + 1, 3, dtype=np.int32),
        successor=draw.integers(0, size, 3 * size).astype(np.int32),
        probability=np.full(3 * size, 0.98 / 3),
    )
    operator = KernelOperator(slow)
    x = operator.vector(0.0)
    sweeps = next(sweep for sweep in range(10_000) if operator.improve(x) <= 1e-9)
    assert x == pytest.approx(50.0, rel=1e-8)
    assert sweeps < 12


def test_ties_go_to_the_first_choice() -> None:
    choices = Choices(
        first_choice=np.array([0, 3], dtype=np.int32),
        constant=np.array([0.2, 0.5, 0.5 + 1e-13]),
        first_outcome=np.zeros(4, dtype=np.int32),
        successor=np.zeros(0, dtype=np.int32),
        probability=np.zeros(0),
    )
    for operator in operators(choices):
        assert operator.greedy(operator.vector(0.0), maximise=True, tie=1e-9)[0].tolist() == [1]
        assert operator.greedy(operator.vector(0.0), maximise=True, tie=1e-15)[0].tolist() == [2]


def test_direct_bounds_enclose_what_iteration_converges_to() -> None:
    for seed in range(60):
        choices = random_choices(seed)
        lower, upper, _ = iterate_intervals(choices, 0, options=Options())
        assert (upper - lower).max() <= 2e-10
        bounds = probability_bounds(choices, choices.first_choice[:-1])
        assert bounds is not None
        assert (bounds[0] <= upper).all()
        assert (bounds[1] >= lower).all()
        assert (bounds[1] - bounds[0]).max() <= 1e-10


def test_a_missing_device_is_refused() -> None:
    if torch.cuda.is_available():
        assert isinstance(operator_of(random_choices(0), "cuda"), TensorOperator)
    else:
        with pytest.raises(DeviceUnavailableError):
            operator_of(random_choices(0), "cuda")
    assert isinstance(operator_of(random_choices(0), "auto"), KernelOperator)
