"""Plain English for formulas, put together from the readings of the propositional functions.

The reading is compositional: every operator has one way to be said, and what could be misread is put in parentheses or
set off by commas and semicolons (`models.world.phrases`), so that formulas which do not mean the same are never read
alike. Common shapes read as people say them: `F (a & F b)` is "eventually a, and then b". docs/ltl.md has the rules.

Subformulas are read on a stack of generators, each of which asks for the readings of its parts: nothing recurses over
a formula, and no part is read twice.
"""

from __future__ import annotations

from collections.abc import Generator, Iterable, Sequence
from dataclasses import replace

from models.logic import Atom, Binary, Constant, Formula, Nary, Op, Unary, atoms
from models.world.environment import Environment
from models.world.phrases import Level, Said, joined
from models.world.sequences import Step, complement, steps_of, strictly_ordered
from models.world.wording import word_atoms

MAX_READING = 10_000
"""Most characters of a reading; a longer one is cut after a word, and ends with CUT."""
CUT = " [...]"

_Wanted = tuple[Formula, bool]  # a formula, and whether its negation is to be read
_Reading = Generator[_Wanted, Said, Said]


def explain(formula: Formula, environment: Environment | None = None) -> str:
    """What the formula asks for, in English. Atoms that the environment does not have, and all without one, are read
    as they are written.
    """
    return cut(Speaker(atoms(formula), environment).say(formula).text)


def cut(text: str, most: int = MAX_READING) -> str:
    """The text, cut after a word if it is too long."""
    return text if len(text) <= most else text[: most - len(CUT)].rpartition(" ")[0] + CUT


class Speaker:
    """Reads formulas over some atoms, and their parts."""

    def __init__(self, found: Iterable[Atom], environment: Environment | None) -> None:
        self._words = word_atoms(found, environment)
        self._known: dict[_Wanted, Said] = {}

    def say(self, formula: Formula) -> Said:
        """The reading of the formula, or of a part of it."""
        wanted = (formula, False)
        waiting = [(wanted, self._read(*wanted))]
        answer: Said | None = None
        while waiting:
            asked, reading = waiting[-1]
            try:
                wanted = reading.send(answer) if answer is not None else next(reading)
            except StopIteration as finished:
                answer = self._known[asked] = finished.value
                waiting.pop()
                continue
            answer = self._known.get(wanted)
            if answer is None:
                waiting.append((wanted, self._read(*wanted)))
        assert answer is not None
        return answer

    def _read(self, formula: Formula, denied: bool) -> _Reading:
        """The reading of a formula or, if it is denied, of its negation."""
        match formula:
            case Constant(value=value):
                holds = value is not denied
                return Said("anything is allowed" if holds else "the impossible happens", Level.CLAUSE)
            case Atom():
                wording = self._words[formula]
                return wording.denied if denied else wording.affirmed
            case Unary(op=Op.NOT, operand=operand):
                return (yield operand, not denied)
            case Unary(op=Op.NEXT):
                return (yield from self._next(formula, denied))
            case Unary(op=op, operand=operand):
                eventually = (op is Op.FINALLY) is not denied
                return (yield from (self._eventually if eventually else self._always)(operand, denied))
            case Nary():
                return (yield from self._several(formula, denied))
            case Binary():
                return (yield from self._binary(formula, denied))

    def _next(self, formula: Formula, denied: bool) -> _Reading:
        count = 0
        while isinstance(formula, Unary) and formula.op is Op.NEXT:
            formula, count = formula.operand, count + 1
        when = "in the next step" if count == 1 else f"in {count} steps"
        inner, negated = _positive(formula, denied)
        if count == 1 and isinstance(inner, Unary) and (inner.op is Op.GLOBALLY) is not negated:
            kept = yield inner, negated
            return Said(f"from the next step on {kept.within(Level.PREFIX)}", Level.PREFIX)
        return (yield from self._behind(when, formula, denied))

    def _behind(self, words: str, formula: Formula, denied: bool) -> _Reading:
        """A formula behind words that apply to all of it."""
        said = yield formula, denied
        return Said(f"{words} {said.within(Level.PREFIX)}", Level.PREFIX)

    def _eventually(self, operand: Formula, denied: bool) -> _Reading:
        """`F operand`, or `F !operand`."""
        operand, denied = _positive(operand, denied)
        if isinstance(operand, Unary) and operand.op in (Op.FINALLY, Op.GLOBALLY):
            if (operand.op is Op.FINALLY) is not denied:
                return (yield from self._eventually(operand.operand, denied))
            kept = yield from self._always(operand.operand, denied)
            comma = "," if kept.level is Level.PHRASE else ""
            return Said(f"from some time on{comma} {kept.text}", kept.level)
        if denied:
            return (yield from self._behind("eventually", operand, denied))
        return (yield from self._sequence("eventually", None, steps_of(operand)))

    def _always(self, operand: Formula, denied: bool) -> _Reading:
        """`G operand`, or `G !operand`."""
        operand, denied = _positive(operand, denied)
        match operand:
            case Atom():
                return self._words[operand].never if denied else self._words[operand].always
            case Unary(op=Op.FINALLY | Op.GLOBALLY as op, operand=inner):
                if (op is Op.GLOBALLY) is not denied:
                    return (yield from self._always(inner, denied))
                inner, denied = _positive(inner, denied)
                if denied or _is_lasting(inner):
                    return (yield from self._behind("again and again", inner, denied))
                return (yield from self._sequence("again and again", None, steps_of(inner)))
            case Binary(op=Op.IMPLIES, left=left, right=right) if not denied:
                return (yield from self._whenever(left, right))
            case Nary(op=Op.OR, operands=operands) if not denied and (ruled_out := _denied_of(operands)):
                if len(ruled_out) == len(operands):
                    items = []
                    for one in ruled_out:
                        items.append((yield one, False))
                    return Said(f"never {joined('and', items).within(Level.PREFIX)}", Level.PREFIX)
                if len(operands) == 2:
                    (other,) = (one for one in operands if not _is_denial(one))
                    return (yield from self._whenever(ruled_out[0], other))
                return (yield from self._behind("always", operand, denied))
            case Nary() | Binary() if denied and operand.op not in (Op.IMPLIES, Op.IFF):
                return (yield from self._behind("never", operand, False))
            case _:
                return (yield from self._behind("always", operand, denied))

    def _whenever(self, left: Formula, right: Formula) -> _Reading:
        condition, said = (yield left, False), (yield right, False)
        text = f"whenever {condition.within(Level.PREFIX)}, {said.within(Level.PHRASE)}"
        return Said(text, Level.PHRASE)

    def _sequence(self, head: str, guard: Formula | None, steps: Sequence[Step]) -> _Reading:
        """Steps one after the other, the first behind `head`; `guard` has to hold until then."""
        throughout = guard is not None and len(steps) > 1 and all(step.guard == guard for step in steps[1:])
        strict = not throughout and len(steps) > 1 and _awaits(guard, steps)
        said: list[str] = []
        for place, step in enumerate(steps):
            now = yield from self._together(step, steps[place - 1] if place else None)
            if throughout:
                step = replace(step, kind="then")
            elif strict and place == 1:
                step = replace(step, kind="only")
            said.append((yield from self._follow(step, now)) if place else f"{head} {now.within(Level.PREFIX)}")
            if place == 0 and guard is not None and not throughout and not strict:
                kept = yield guard, False
                said.append(f"and until then {kept.within(Level.PREFIX)}")
        if throughout:
            assert guard is not None
            kept = yield guard, False
            said.append(f"and all the time until then {kept.within(Level.PREFIX)}")
        return Said(", ".join(said), Level.PHRASE if len(said) > 1 else Level.PREFIX)

    def _follow(self, step: Step, now: Said) -> Generator[_Wanted, Said, str]:
        """A later step behind the words that lead to it."""
        what, steps = now.within(Level.PREFIX), "one step" if step.count == 1 else f"{step.count} steps"
        match step.kind:
            case "until":
                assert step.guard is not None
                kept = yield step.guard, False
                return f"and from then on {kept.within(Level.CLAUSE)} until {what}"
            case "after":
                return f"and after that {what}" if step.count == 1 else f"and at least {steps} later {what}"
            case "next":
                return f"and {steps} later {what}"
            case "only":
                return f"and only then {what}"
            case _:
                return f"and then {what}"

    def _together(self, step: Step, before: Step | None) -> _Reading:
        """What holds at a step; what already held in the step before is said last: `b while a`."""
        items = []
        for part in step.parts:
            items.append((yield part, False))
        earlier = set() if before is None else set(before.parts)
        held = [part in earlier for part in step.parts]
        if any(held) and not all(held) and all(item.level is Level.CLAUSE for item in items):
            new, kept = (
                joined("and", [item for item, old in zip(items, held, strict=True) if old is wanted])
                for wanted in (False, True)
            )
            return Said(f"{new.within(Level.PREFIX)} while {kept.within(Level.PREFIX)}", Level.PREFIX)
        return joined("and", items)

    def _several(self, formula: Nary, denied: bool) -> _Reading:
        """`a & b & ...` and `a | b | ...`; `!(a | b)` is read as `!a & !b`."""
        if formula.op is Op.AND and denied:
            return (yield from self._deny(formula))
        if formula.op is Op.AND:
            return (yield from self._all(formula.operands))
        weak = None if denied else _weak_until(formula.operands)
        if weak is not None:
            return (yield from self._weak_until(*weak))
        items = []
        for operand in formula.operands:
            items.append((yield operand, denied))
        return joined("and" if denied else "or", items)

    def _all(self, operands: Sequence[Formula]) -> _Reading:
        """A conjunction; single eventualities are said together, "in any order"."""
        sequences = strictly_ordered(operands)
        single = [place for place, steps in sequences.items() if len(steps) == 1]
        loose = dict.fromkeys(sorted(single)) if len(single) > 1 else {}
        begins = next(iter(loose), None)
        items: list[Said] = []
        for place, operand in enumerate(operands):
            steps = sequences.get(place)
            if steps is None:
                items.append((yield operand, False))
            elif place == begins:
                group = []
                for member in loose:
                    group.append((yield operands[member], False))
                text = joined("and", group).text + ", in any order"
                items.append(Said(text, Level.PHRASE))
            elif steps and place not in loose:
                items.append((yield from self._sequence("eventually", None, steps)))
        if len(items) == 1 and loose:
            return Said(items[0].text, Level.LIST)
        return joined("and", items)

    def _deny(self, formula: Formula) -> _Reading:
        return (yield from self._behind("it is not so that", formula, False))

    def _binary(self, formula: Binary, denied: bool) -> _Reading:
        left, right = formula.left, formula.right
        match formula.op:
            case Op.IFF:
                one, other = (yield left, False), (yield right, denied)
                return Said(f"{one.within(Level.CLAUSE)} exactly when {other.within(Level.PREFIX)}", Level.PHRASE)
            case Op.IMPLIES if denied:
                return joined("and", [(yield left, False), (yield right, True)])
            case _ if denied:
                return (yield from self._deny(formula))
            case Op.IMPLIES:
                one, other = (yield left, False), (yield right, False)
                text = f"if {one.within(Level.PREFIX)}, then {other.within(Level.PHRASE)}"
            case Op.UNTIL:
                return (yield from self._sequence("eventually", left, steps_of(right)))
            case Op.WEAK_UNTIL:
                return (yield from self._weak_until(left, right))
            case Op.RELEASE:
                one, other = (yield left, False), (yield right, False)
                kept, freed = other.within(Level.CLAUSE), one.within(Level.PREFIX)
                text = f"{kept} up to and including when {freed}, if ever"
            case _:
                one, other = (yield left, False), (yield right, False)
                text = (
                    f"eventually {one.within(Level.PREFIX)}, and up to and including then {other.within(Level.PREFIX)}"
                )
        return Said(text, Level.PHRASE)

    def _weak_until(self, left: Formula, right: Formula) -> _Reading:
        one, other = (yield left, False), (yield right, False)
        return Said(f"{one.within(Level.CLAUSE)} until {other.within(Level.PREFIX)}, if ever", Level.PHRASE)


def _positive(formula: Formula, denied: bool) -> _Wanted:
    """Without negations around it."""
    while isinstance(formula, Unary) and formula.op is Op.NOT:
        formula, denied = formula.operand, not denied
    return formula, denied


def _is_denial(formula: Formula) -> bool:
    return isinstance(formula, Unary) and formula.op is Op.NOT


def _denied_of(operands: Sequence[Formula]) -> list[Formula]:
    """What the operands that are negations deny."""
    return [one.operand for one in operands if isinstance(one, Unary) and one.op is Op.NOT]


def _is_lasting(formula: Formula) -> bool:
    return isinstance(formula, Unary) and formula.op is Op.GLOBALLY


def _awaits(guard: Formula | None, steps: Sequence[Step]) -> bool:
    """Whether the guard of the first step is that the second does not hold yet: `!b U (a & F b)`."""
    late = None if guard is None else complement(guard)
    return late is not None and steps[1].kind == "then" and steps[1].only_part == late


def _weak_until(operands: Sequence[Formula]) -> tuple[Formula, Formula] | None:
    """`(a U b) | G a`, in either order, as (a, b)."""
    if len(operands) != 2:
        return None
    for one, other in (operands, operands[::-1]):
        if isinstance(one, Binary) and one.op is Op.UNTIL and other == Unary(Op.GLOBALLY, one.left):
            return one.left, one.right
    return None
