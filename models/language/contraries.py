"""Verbs that undo each other: nearness tells no opposites, so what says the contrary of a task must not pass for it.

A robot that was only taught to lock is not to lock what it is told to unlock. The list has what people tell robots, in
ordinary English; verbs that differ by a prefix ("load", "unload") need none.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cache

from models.language.teaching.utterance import DETERMINERS
from models.language.translation import NEGATIONS
from models.queries import ContextualQuery

_CONTRARIES = """
go enter visit navigate | leave exit vacate
pick pickup lift grab hold | drop release
lift raise hoist | lower drop
add insert mount attach install | remove detach
open unseal | close shut seal
lock bolt latch secure | unlock unbolt unlatch
start begin activate enable launch | stop end halt deactivate disable quit
connect plug | disconnect unplug
fill refill restock replenish | empty drain
cover wrap veil | uncover unwrap unveil
freeze | thaw defrost melt
heat warm | cool chill
light ignite | extinguish douse
wet soak | dry
show display reveal | hide conceal
wake awaken | sleep
push | pull
assemble build | disassemble dismantle demolish
tighten | loosen
inflate | deflate
increase | decrease reduce
lengthen | shorten
clean wash tidy | dirty soil
pause | resume continue
save keep | delete erase discard
arm | disarm
lend | borrow
give | take
send | receive
accept | reject refuse
"""
_PARTICLES: Mapping[str, str] = {
    one: other for pair in (("on", "off"), ("up", "down"), ("in", "out")) for one, other in (pair, pair[::-1])
}
_PREFIXES = ("un", "dis", "de")
_ENDINGS = ("", "s", "es", "d", "ed", "ing")


def contrary(spoken: Sequence[str], task: ContextualQuery, taught: Iterable[str]) -> tuple[str, str] | None:
    """A word of a command that undoes what the task is called, or what it was `taught` with, and the word of these that
    it is the contrary of; None without any, and where the command has a negation.

    It is a verb before an argument of the task ("unlock the cup", not "take the cover off the cup"), or what goes with
    a verb of theirs ("turn the lamp off", where "turn the lamp on" is known).

    Args:
        spoken: the folded words of the command.
        taught: words of the utterances that the task was taught with.
    """
    if not NEGATIONS.isdisjoint(spoken):
        return None
    own = {*task.task.split("_"), *taught}
    arguments = [tuple(argument.split()) for argument in task.arguments]
    for at, word in enumerate(spoken):
        if word in own or (at and spoken[at - 1] in DETERMINERS):
            continue
        particle = _PARTICLES.get(word, "")
        if particle in own and particle not in spoken and _goes_with(spoken, at, own, arguments):
            return word, particle
        if any(_stands_at(spoken, at + 1, argument) for argument in arguments):
            undone = next((verb for verb in _undone_by(word) if not own.isdisjoint(_forms(verb))), None)
            if undone is not None:
                return word, undone
    return None


def _undone_by(verb: str) -> Iterator[str]:
    yield from sorted(_listed().get(verb, ()))
    for prefix in _PREFIXES:
        yield prefix + verb
        if verb.startswith(prefix):
            yield verb.removeprefix(prefix)


@cache
def _listed() -> Mapping[str, frozenset[str]]:
    """The contraries of each verb of the list."""
    found: defaultdict[str, frozenset[str]] = defaultdict(frozenset)
    for line in _CONTRARIES.strip().splitlines():
        one, other = (frozenset(side.split()) for side in line.split("|"))
        for verbs, against in ((one, other), (other, one)):
            for verb in verbs:
                found[verb] |= against
    return dict(found)


def _forms(verb: str) -> set[str]:
    """The verb with its regular endings, and what is not a word: "opening", "closing", "closeing"."""
    stems = {verb, verb.removesuffix("e"), verb + verb[-1]}
    return {stem + ending for stem in stems for ending in _ENDINGS if ending or stem == verb}


def _goes_with(spoken: Sequence[str], at: int, own: set[str], arguments: Sequence[tuple[str, ...]]) -> bool:
    """Whether the word at a place goes with a verb that is known: "turn off the lamp", "turn the lamp off"."""
    if at and spoken[at - 1] in own and any(_stands_at(spoken, at + 1, argument) for argument in arguments):
        return True
    begins = (begin for argument in arguments for begin in range(1, at) if _stands_at(spoken, begin, argument, ends=at))
    return any(spoken[begin - 1] in own for begin in begins)


def _stands_at(spoken: Sequence[str], at: int, argument: tuple[str, ...], *, ends: int | None = None) -> bool:
    """Whether an argument stands at a place, with a determiner or without, and ends before another."""
    begin = at + (at < len(spoken) and spoken[at] in DETERMINERS and spoken[at] not in argument[:1])
    end = begin + len(argument)
    return tuple(spoken[begin:end]) == argument and (ends is None or end == ends)
