"""The kernel against loops, and its direct counterpart."""

from __future__ import annotations

import random

import numpy as np
import pytest
import torch

from models.planning import DeviceUnavailableError
from models.planning.bellman import THREADS_FROM, Bellman, threads
from models.planning.choices import Choices, Vector
from models.planning.direct import probability_bounds
from models.planning.options import Options
from models.planning.probability import iterate_intervals
from models.planning.ragged import offsets


def random_choices(seed: int, *, leak: float = 0.05) -> Choices:
    """Choices under which every policy leaves the unknowns for sure."""
    pick = random.Random(seed)
    unknowns = pick.randint(1, 8)
    owner = [*range(unknowns), *(pick.randrange(unknowns) for _ in range(pick.randrange(12)))]
    pick.shuffle(owner)
    rows = [pick.sample(range(unknowns), pick.randint(0, min(3, unknowns))) for _ in owner]
    stay = [pick.random() * (1 - leak) if row else 0.0 for row in rows]
    return Choices(
        unknowns=unknowns,
        owner=np.array(owner, dtype=np.int32),
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


@pytest.mark.parametrize("maximise", [True, False])
def test_a_sweep_takes_the_best_choice_of_every_unknown(maximise: bool) -> None:
    for seed in range(50):
        choices = random_choices(seed)
        x = np.random.default_rng(seed).random(choices.unknowns)
        operator = Bellman(choices, maximise=maximise)
        out = operator.vector(0.0)
        operator.sweep(operator.vector(x), out)
        values = worth(choices, x)
        best = max if maximise else min
        own = [[v for v, o in zip(values, choices.owner, strict=True) if o == u] for u in range(choices.unknowns)]
        assert operator.numpy(out) == pytest.approx([best(v) for v in own], abs=1e-15)
        chosen, rise = operator.greedy(operator.vector(x), 1e-12)
        assert choices.owner[chosen].tolist() == list(range(choices.unknowns))
        assert [values[c] for c in chosen] == pytest.approx([best(v) for v in own])
        assert rise == pytest.approx(max(values[c] - x[u] for u, c in enumerate(chosen)))


def test_ties_go_to_the_first_choice() -> None:
    choices = Choices(
        unknowns=1,
        owner=np.zeros(3, dtype=np.int32),
        constant=np.array([0.2, 0.5, 0.5 + 1e-13]),
        first_outcome=np.zeros(4, dtype=np.int32),
        successor=np.zeros(0, dtype=np.int32),
        probability=np.zeros(0),
    )
    operator = Bellman(choices, maximise=True)
    assert operator.greedy(operator.vector(0.0), 1e-9)[0].tolist() == [1]
    assert operator.greedy(operator.vector(0.0), 1e-15)[0].tolist() == [2]


def test_direct_bounds_enclose_what_iteration_converges_to() -> None:
    for seed in range(60):
        choices = random_choices(seed)
        lower, upper = iterate_intervals(choices, 0, options=Options())
        assert (upper - lower).max() <= 1e-10
        bounds = probability_bounds(choices, np.array([np.argmax(choices.owner == u) for u in range(choices.unknowns)]))
        assert bounds is not None
        assert (bounds[0] <= upper).all()
        assert (bounds[1] >= lower).all()
        assert (bounds[1] - bounds[0]).max() <= 1e-10


def test_the_thread_count_is_set_for_the_model_and_restored() -> None:
    before = torch.get_num_threads()
    with threads(THREADS_FROM - 1):
        assert torch.get_num_threads() == 1
    assert torch.get_num_threads() == before


def test_a_missing_device_is_refused() -> None:
    if torch.cuda.is_available():
        assert Bellman(random_choices(0), maximise=True, device="cuda").device.type == "cuda"
    else:
        with pytest.raises(DeviceUnavailableError):
            Bellman(random_choices(0), maximise=True, device="cuda")
