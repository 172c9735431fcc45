"""Verbs that undo each other: nearness tells no opposites, so what says the contrary of a task must not pass for it.

A robot that was only taught to lock is not to lock what it is told to unlock. The list has what people tell robots, in
ordinary English; verbs that differ by a prefix ("load", "unload") need none.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cache, lru_cache

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
    for before, after in _around(spoken, task):
        verb = _word(spoken, before)
        if verb in _PARTICLES and _word(spoken, before - 1) in own and _is_contrary(verb, own, spoken):
            return verb, _PARTICLES[verb]  # "turn off the lamp"
        particle = _word(spoken, after)
        if particle in _PARTICLES and verb in own and _is_contrary(particle, own, spoken):
            return particle, _PARTICLES[particle]  # "turn the lamp off"
        if verb and verb not in own and _word(spoken, before - 1) not in DETERMINERS:
            undone = next((undone for undone in _undone_by(verb) if not own.isdisjoint(_forms(undone))), None)
            if undone is not None:
                return verb, undone
    return None


def _around(spoken: Sequence[str], task: ContextualQuery) -> Iterator[tuple[int, int]]:
    """The places of the words before and after each mention of an argument, a determiner belonging to it."""
    for argument in task.arguments:
        named = tuple(argument.split())
        for begin in range(len(spoken) - len(named) + 1):
            if tuple(spoken[begin : begin + len(named)]) == named:
                yield begin - 1 - (begin > 0 and spoken[begin - 1] in DETERMINERS), begin + len(named)


def _word(spoken: Sequence[str], place: int) -> str:
    """The word at a place; nothing beyond the ends."""
    return spoken[place] if 0 <= place < len(spoken) else ""


def _is_contrary(particle: str, own: set[str], spoken: Sequence[str]) -> bool:
    """Whether a particle is known only by the one that it is the contrary of, which the command does not have."""
    other = _PARTICLES[particle]
    return particle not in own and other in own and other not in spoken


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


@lru_cache(maxsize=1_024)
def _forms(verb: str) -> frozenset[str]:
    """The verb with its regular endings, and what is not a word: "opening", "closing", "closeing"."""
    stems = {verb, verb.removesuffix("e"), verb + verb[-1]}
    return frozenset(stem + ending for stem in stems for ending in _ENDINGS if ending or stem == verb)
