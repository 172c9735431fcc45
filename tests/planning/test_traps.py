"""The known traps of planning for LTL, each a small world with values worked out by hand."""

from __future__ import annotations

import time

import pytest

from models.logic import parse
from models.planning import Options, Plan, plan, simulate
from models.planning.options import Device
from tests.planning.doubles import DEVICES, ArrayWorld, Transitions

SETTINGS: dict[str, Device] = {}


@pytest.fixture(params=DEVICES, autouse=True)
def _device(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Every trap is planned on each device of this machine."""
    monkeypatch.setitem(SETTINGS, "device", request.param)


def world(transitions: Transitions, *, initial: int = 0, **holds: set[int]) -> ArrayWorld:
    size = 1 + max(max(transitions), *(t for moves in transitions.values() for move in moves.values() for t in move))
    return ArrayWorld(size, transitions, {name: frozenset(states) for name, states in holds.items()}, initial=initial)


def solve(model: ArrayWorld, formula: str, **options: float | str) -> Plan:
    return plan(model, parse(formula), options=Options(**SETTINGS, **options))  # type: ignore[arg-type]


def test_a_slow_chain_that_looks_converged() -> None:
    # From 0: to a with 1e-6, to a trap with 3e-6, else stay. Iteration from below gains 1e-6 a sweep and looks done.
    model = world({0: {"go": {0: 1 - 4e-6, 1: 1e-6, 2: 3e-6}}}, a={1})
    result = solve(model, "F a")
    assert result.lower == pytest.approx(0.25, abs=1e-7)
    assert result.upper - result.lower <= 1e-6
    assert result.lower <= 0.25 <= result.upper
    assert result.expected_steps == pytest.approx(250_000, rel=1e-8)


def test_a_slow_chain_takes_no_time() -> None:
    model = world({0: {"go": {0: 1 - 4e-9, 1: 1e-9, 2: 3e-9}}}, a={1})
    began = time.process_time()
    result = solve(model, "F a")
    assert time.process_time() - began < 2.0  # a million sweeps more would be ten times that
    assert result.lower <= 0.25 <= result.upper
    assert result.upper - result.lower <= 1e-6


def test_a_long_fair_random_walk() -> None:
    # The gambler's ruin from the middle of 0 .. 60: probability 1/2, and 30 * 30 expected steps.
    steps = {i: {"bet": {i - 1: 0.5, i + 1: 0.5}} for i in range(1, 60)}
    result = solve(world({0: {}, **steps, 60: {}}, initial=30, a={60}), "F a")
    assert result.lower <= 0.5 <= result.upper
    assert result.upper - result.lower <= 1e-6
    assert result.expected_steps == pytest.approx(900, rel=1e-9)


def test_an_end_component_keeps_the_upper_bound_of_plain_iteration_up() -> None:
    # 0 and 1 may circle for ever; leaving reaches a half of the time. Without collapsing, the upper bound stays 1.
    model = world({0: {"circle": {1: 1.0}}, 1: {"circle": {0: 1.0}, "leave": {2: 0.5, 3: 0.5}}}, a={2})
    result = solve(model, "F a")
    assert result.lower == pytest.approx(0.5)
    assert result.upper == pytest.approx(0.5)
    assert result.expected_steps == pytest.approx(2)


def test_a_policy_does_not_loop_on_ties() -> None:
    # Circling between 0 and 1 keeps probability 1 just as leaving does, and comes first.
    model = world({0: {"circle": {1: 1.0}, "leave": {2: 1.0}}, 1: {"circle": {0: 1.0}}}, a={2})
    result = solve(model, "F a")
    assert (result.lower, result.upper, result.expected_steps) == (1.0, 1.0, 1.0)
    assert result.policy is not None
    assert result.policy.step(0, result.initial_memory).action == "leave"
    assert simulate(model, result.policy, runs=10, seed=0).satisfied.all()


def test_a_policy_does_not_loop_on_ties_below_probability_one() -> None:
    model = world({0: {"circle": {1: 1.0}, "leave": {2: 0.3, 3: 0.7}}, 1: {"circle": {0: 1.0}}}, a={2})
    result = solve(model, "F a")
    assert result.lower == pytest.approx(0.3)
    assert result.expected_steps == pytest.approx(1)
    assert result.policy is not None
    assert simulate(model, result.policy, runs=100, seed=0).decided.all()


def test_a_trap_end_component_is_left_while_it_can_be() -> None:
    # "rest" stays in 0, worth nothing; "dare" is decided at once: 0.4 to a, 0.6 into the trap {3, 4}.
    trap = {3: {"on": {4: 1.0}}, 4: {"on": {3: 1.0}}}
    result = solve(world({0: {"rest": {0: 1.0}, "dare": {2: 0.4, 3: 0.6}}, **trap}, a={2}), "F a")
    assert (result.lower, result.upper) == (pytest.approx(0.4), pytest.approx(0.4))
    assert result.expected_steps == pytest.approx(1)


def test_probability_comes_before_steps() -> None:
    # The quick way is decided in one step and succeeds with 0.9; the slow one takes 3 and always does.
    model = world({0: {"quick": {3: 0.9, 4: 0.1}, "slow": {1: 1.0}}, 1: {"on": {2: 1.0}}, 2: {"on": {3: 1.0}}}, a={3})
    result = solve(model, "F a")
    assert (result.lower, result.upper, result.expected_steps) == (1.0, 1.0, 3.0)


def test_no_discounting_prefers_a_near_chance_to_a_far_certainty() -> None:
    # 200 sure steps beat one step with probability 0.99, which any discount of 0.99 would prefer.
    far = {i: {"walk": {i + 1: 1.0}} for i in range(1, 200)}
    model = world({0: {"jump": {200: 0.99, 201: 0.01}, "walk": {1: 1.0}}, **far}, a={200})
    result = solve(model, "F a")
    assert (result.lower, result.expected_steps) == (1.0, 200.0)


def test_nearly_tied_probabilities_are_told_apart() -> None:
    # The second action is better by 1e-7, and takes longer.
    model = world({0: {"short": {2: 0.5, 3: 0.5}, "long": {1: 1.0}}, 1: {"on": {2: 0.5 + 1e-7, 3: 0.5 - 1e-7}}}, a={2})
    result = solve(model, "F a", epsilon=1e-9)
    assert result.lower == pytest.approx(0.5 + 1e-7, abs=1e-11)
    assert result.expected_steps == pytest.approx(2)


def test_small_losses_do_not_add_up() -> None:
    # "drift" loses 1e-11 each time and is faster on paper nowhere: repeated 1e6 times it would cost 1e-5.
    chain = {0: {"drift": {0: 1 - 1e-6, 1: 1e-6 - 1e-11, 2: 1e-11}, "safe": {0: 1 - 1e-7, 1: 1e-7}}}
    result = solve(world(chain, a={1}), "F a")
    assert (result.lower, result.upper) == (1.0, 1.0)
    assert result.expected_steps == pytest.approx(1e7, rel=1e-6)


def test_small_losses_below_probability_one_do_not_add_up() -> None:
    # One "drift" loses 5e-11, too little to see; but it is ten times faster, and drifting for ever would lose 5e-6.
    drift = {0: 1 - 1e-5, 1: 1e-5 * (0.5 - 5e-6), 2: 1e-5 * (0.5 + 5e-6)}
    model = world({0: {"drift": drift, "safe": {0: 1 - 1e-6, 1: 5e-7, 2: 5e-7}}}, a={1})
    result = solve(model, "F a")
    assert result.upper - result.lower <= 1e-6
    assert result.lower == pytest.approx(0.5, abs=1e-6)
    assert result.expected_steps == pytest.approx(1e6, rel=1e-6)


def test_the_label_of_the_initial_state_counts() -> None:
    model = world({0: {"go": {1: 1.0}}}, a={0}, b={1})
    assert solve(model, "a").expected_steps == 0
    assert solve(model, "a & F b").expected_steps == 1
    assert solve(model, "b").outcome == "unreachable"
    assert solve(model, "!a U b").outcome == "unreachable"


def test_next_counts_steps_from_now() -> None:
    model = world({i: {"go": {i + 1: 1.0}} for i in range(3)}, a={2})
    assert [solve(model, f).outcome for f in ("a", "X a", "X X a", "X X X a")] == [
        "unreachable", "unreachable", "solved", "unreachable",
    ]  # fmt: skip
    assert solve(model, "X X a").expected_steps == 2
    assert solve(model, "F X a").expected_steps == 2  # decided on entering a, not one step before


def test_the_label_read_is_that_of_the_state_entered() -> None:
    # One passes through a once; afterwards a is never seen again, so `F (a & X b)` needs the memory of the moment.
    model = world({0: {"go": {1: 1.0}}, 1: {"go": {2: 0.5, 3: 0.5}}}, a={1}, b={2})
    result = solve(model, "F (a & X b)")
    assert result.lower == pytest.approx(0.5)
    assert result.expected_steps == pytest.approx(2)


def test_the_ship_template_orders_nothing_and_the_strict_one_does() -> None:
    model = world({0: {"b": {1: 1.0}, "a": {2: 1.0}}, 1: {"on": {3: 1.0}}, 2: {"on": {1: 1.0}}}, a={2, 3}, b={1, 3})
    assert solve(model, "F (a & F (a & b))").expected_steps == 2
    assert solve(model, "(!b U a) & F (a & b)").expected_steps == 3


def test_order_needs_memory() -> None:
    # One hub, two rooms: the action in the hub depends on what has been seen.
    model = world(
        {0: {"left": {1: 1.0}, "right": {2: 1.0}}, 1: {"back": {0: 1.0}}, 2: {"back": {0: 1.0}}}, a={1}, b={2}
    )
    result = solve(model, "F (a & F b)")
    assert result.policy is not None
    step = result.policy.step(0, result.initial_memory)
    assert step.action == "left"
    step = result.policy.step(1, step.memory)
    assert step.action == "back"
    step = result.policy.step(0, step.memory)
    assert step.action == "right"
    step = result.policy.step(2, step.memory)
    assert (step.action, step.done, step.status, step.expected_steps) == (None, True, "satisfied", 0.0)


def test_a_state_without_actions_stays() -> None:
    model = world({0: {"go": {1: 1.0}}}, a={1})
    result = solve(model, "F (a & X a)")
    assert (result.lower, result.expected_steps) == (1.0, 2.0)
    assert result.policy is not None
    first = result.policy.step(0, result.initial_memory)
    waiting = result.policy.step(1, first.memory)
    assert (waiting.action, waiting.done, waiting.status) == (None, False, "running")
    assert simulate(model, result.policy, runs=3, seed=0).satisfied.all()
    assert result.trajectory is not None
    assert [(s.state, s.action) for s in result.trajectory.steps] == [(0, "go"), (1, None), (1, None)]


def test_an_unsatisfiable_formula_is_an_answer() -> None:
    result = solve(world({0: {"go": {0: 1.0}}}, a={0}), "F (a & !a)")
    assert (result.outcome, result.upper, result.policy, result.trajectory) == (
        "unsatisfiable",
        0.0,
        None,
        None,
    )


def test_an_unreachable_goal_is_an_answer() -> None:
    result = solve(world({0: {"go": {0: 1.0}}, 1: {"go": {1: 1.0}}}, a={1}), "F a")
    assert (result.outcome, result.upper, result.policy, result.trajectory) == (
        "unreachable",
        0.0,
        None,
        None,
    )


def test_a_formula_that_already_holds_takes_no_steps() -> None:
    for formula in ("true", "a", "F a", "b U a"):
        result = solve(world({0: {"go": {0: 1.0}}}, a={0}, b=set()), formula)
        assert (result.outcome, result.lower, result.expected_steps) == ("solved", 1.0, 0.0)
        assert result.policy is not None
        assert result.policy.step(0, result.initial_memory).done


def test_an_accepting_state_that_is_left_again_is_not_accepted() -> None:
    # a holds once on the way to a sink: F a is sure, G F a impossible.
    model = world({0: {"go": {1: 1.0}}, 1: {"go": {2: 1.0}}, 2: {}}, a={1})
    assert solve(model, "F a").lower == 1.0
    assert solve(model, "G F a").outcome == "unreachable"


def test_acceptance_needs_an_end_component_not_a_cycle() -> None:
    # From 1 every try to come back to a fails half of the time, so a is met for ever with probability 0.
    model = world({0: {"go": {1: 1.0}}, 1: {"back": {0: 0.5, 2: 0.5}}, 2: {}}, a={0})
    assert solve(model, "G F a").outcome == "unreachable"
    assert solve(model, "G F a", objective="min").upper == 0.0


def test_two_recurrences_need_memory() -> None:
    # From the middle to a or to b and back: a policy without memory meets only one of them.
    model = world(
        {0: {"left": {1: 1.0}, "right": {2: 1.0}}, 1: {"back": {0: 1.0}}, 2: {"back": {0: 1.0}}}, a={1}, b={2}
    )
    result = solve(model, "G F a & G F b")
    assert (result.outcome, result.lower, result.expected_steps) == ("solved", 1.0, 0.0)
    assert result.round_steps == pytest.approx((4.0, 4.0))
    assert result.policy is not None
    assert {result.policy.step(0, memory).action for memory in range(result.policy.memories)} == {"left", "right"}
    assert result.trajectory is not None
    loop = result.trajectory.steps[result.trajectory.loop :]
    assert {1, 2} <= {step.state for step in loop}
    assert (loop[0].state, loop[0].memory) == (loop[-1].state, loop[-1].memory)


def test_the_shortest_round_is_not_the_nearest_mark() -> None:
    # a holds in 1, one step away but five steps from coming again, and in 6, two steps away and two from coming again.
    far = {1: {"on": {2: 1.0}}, 2: {"on": {3: 1.0}}, 3: {"on": {4: 1.0}}, 4: {"on": {0: 1.0}}}
    model = world(
        {0: {"near": {1: 1.0}, "far": {5: 1.0}}, **far, 5: {"on": {6: 1.0}}, 6: {"on": {5: 1.0}, "back": {0: 1.0}}},
        a={1, 6},
    )
    result = solve(model, "G F a")
    assert result.policy is not None
    assert result.round_steps == pytest.approx((2.0, 2.0))
    assert result.policy.step(0, result.initial_memory).action == "far"


def test_safety_is_kept_by_staying() -> None:
    model = world({0: {"risk": {1: 0.5, 2: 0.5}, "wait": {0: 1.0}}, 1: {}, 2: {}}, b={2})
    result = solve(model, "G !b")
    assert (result.lower, result.expected_steps) == (1.0, 0.0)
    assert result.policy is not None
    step = result.policy.step(0, result.initial_memory)
    assert (step.action, step.status, step.done) == ("wait", "sustaining", False)
    forced = world({0: {"risk": {1: 0.75, 2: 0.25}}, 1: {}, 2: {}}, b={2})
    assert solve(forced, "G !b").lower == pytest.approx(0.75)


def test_persistence_may_be_reached_late() -> None:
    # F G a: leave the loop in which a comes and goes for one in which it stays, reached with 0.8.
    moves = {0: {"turn": {1: 1.0}, "leave": {2: 0.8, 3: 0.2}}, 1: {"turn": {0: 1.0}}, 2: {"stay": {2: 1.0}}, 3: {}}
    result = solve(world(moves, a={0, 2}), "F G a")
    assert result.lower == pytest.approx(0.8)
    assert result.expected_steps == pytest.approx(1.0)


def test_the_least_probability_goes_through_the_negation() -> None:
    moves = {0: {"a": {1: 0.3, 2: 0.7}, "b": {1: 0.6, 2: 0.4}}, 1: {}, 2: {}}
    result = solve(world(moves, g={1}), "F g", objective="min")
    assert result.lower == pytest.approx(0.3)
    assert result.upper == pytest.approx(0.3)
    assert result.policy is not None
    assert result.policy.step(0, result.initial_memory).action == "a"
    assert result.policy.step(0, result.initial_memory).probability == pytest.approx(0.7)  # of the policy's own formula
    for formula, outcome in (("F g | G !g", "unsatisfiable"), ("F (g | !g)", "unsatisfiable")):
        sure = solve(world(moves, g={1}), formula, objective="min")
        assert (sure.outcome, sure.lower, sure.upper) == (outcome, 1.0, 1.0)
    both = solve(world({0: {"a": {1: 1.0}}, 1: {}}, g={1}), "F g", objective="min")
    assert (both.outcome, both.lower, both.upper) == ("unreachable", 1.0, 1.0)


def test_either_of_two_ways_to_accept() -> None:
    # G F a -> G F b in a choice of loops: only with a for ever (refused), with neither, or with both.
    loops = {0: {"x": {1: 1.0}, "y": {2: 0.9, 1: 0.1}}, 1: {"stay": {1: 1.0}}, 2: {"stay": {2: 1.0}}}
    assert solve(world(loops, a={1}, b=set()), "G F a -> G F b").lower == pytest.approx(0.9)
    assert solve(world(loops, a={1, 2}, b={2}), "G F a -> G F b").lower == pytest.approx(0.9)
