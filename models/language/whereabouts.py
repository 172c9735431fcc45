"""Things with where they are: "take the ball out of the box" is said of the ball that is in the box.

A network takes the box for where the ball shall go, or the words for no command. Said without the box, the command has
nothing to mistake; the box tells which ball is meant, and is put back into its name.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from models.language.coordination import named
from models.language.restating import Restated
from models.language.teaching.sources import SOURCES
from models.language.tokens import marked_words
from models.queries import Composition, Query
from models.world import Environment
from models.world.phrase_index import DETERMINERS

STANDING = {
    (*which, place)
    for which in (("that's",), ("which's",), ("that", "is"), ("which", "is"))
    for place in ("in", "at", "on", "inside", "near")
}
"""Words that tell where a thing is, in a clause of their own: "the ball that's in the bedroom"."""


@dataclass(frozen=True, slots=True)
class Located(Restated):
    """A command without where a thing is, and the folded words for the thing and for where it is."""

    name: tuple[str, ...]
    whereabouts: tuple[str, ...]

    def put_together(self, queries: Sequence[Query]) -> Query | None:
        """The query of the text with the place put back; None where it does not speak of the thing by its name."""
        (query,) = queries
        found = self._restored(query)
        return None if found == query else found

    def _restored(self, query: Query) -> Query:
        if isinstance(query, Composition):
            return replace(query, operands=tuple(map(self._restored, query.operands)))
        arguments = (argument.split() for argument in query.arguments)
        return replace(query, arguments=tuple(" ".join(self._with_place(said)) for said in arguments))

    def _with_place(self, said: Sequence[str]) -> Sequence[str]:
        """The words of an argument, and where it is if it is the thing: of "red ball" the end may be the argument."""
        return (*said, *self.whereabouts) if tuple(said) == self.name[-len(said) :] else said


def located(text: str, environment: Environment) -> Iterator[Located]:
    """The things of an environment of which a command says where they are, left to right.

    Raises:
        TextTooLongError: the text is beyond the limits of a command.
    """
    said = marked_words(text)
    for thing, place in pairwise(named(said, environment)):
        between = said[thing[1] : place[0]]
        relation = tuple(w for at, w in enumerate(between) if w not in DETERMINERS or (at == 0 and w == "that"))
        relation = relation[-1:] if relation in STANDING else relation if relation in SOURCES else ()
        if relation:
            shorter = " ".join((*said[: thing[1]], *said[place[1] :]))
            yield Located(shorter, said[slice(*thing)], (*relation, *said[slice(*place)]))
