"""A text that is said in an environment: what the tasks that it may ask for mean there."""

from __future__ import annotations

import copy
from collections.abc import Callable
from dataclasses import dataclass, field

from models.errors import CqltlError
from models.language.tagging import part_of_speech
from models.language.tokens import words
from models.queries import (
    AmbiguousGroundingError,
    ContextualQuery,
    GroundedTask,
    Query,
    Template,
    check_arity,
    evaluate,
)
from models.world import Environment, mentions


@dataclass(frozen=True, slots=True, eq=False)
class Scene:
    """A text, the environment in which it is said, if it is known, and the templates of tasks.

    Many readings of a text are put together from few tasks: each is grounded once.
    """

    text: str
    environment: Environment | None
    template_of: Callable[[str], Template | None]
    _grounded: dict[ContextualQuery, GroundedTask | CqltlError] = field(default_factory=dict, repr=False)

    def knows(self, query: Query) -> bool:
        """Whether all tasks of a query have templates."""
        return all(self.template_of(task.task) is not None for _, task in query.tasks)

    def check(self, query: Query) -> None:
        """Raises `ArityMismatchError` unless each task has as many arguments as its template."""
        for _, task in query.tasks:
            check_arity(self._template(task), task)

    def ground(self, task: ContextualQuery) -> GroundedTask:
        """`models.queries.evaluate` for a task that the text says: its parts of speech, whatever its case and
        punctuation, are asked when nothing else decides between homonyms. Raises as `evaluate`.
        """
        if task not in self._grounded:
            try:
                self._grounded[task] = self._ground(task)
            except CqltlError as error:
                self._grounded[task] = error
        found = self._grounded[task]
        if isinstance(found, CqltlError):
            raise copy.copy(found)  # whoever catches it says where it is in a query of its own
        return found

    def named(self) -> tuple[tuple[str, ...], ...]:
        """The phrases of the text that name things of the environment, each once."""
        if self.environment is None:
            return ()
        said = words(self.text)
        return tuple(dict.fromkeys(said[begin:end] for begin, end in mentions(said, self.environment)))

    def _ground(self, task: ContextualQuery) -> GroundedTask:
        template, environment = self._template(task), self.environment
        assert environment is not None
        try:
            return evaluate(template, task, environment)
        except AmbiguousGroundingError as error:
            is_object = environment.vocabulary.is_object
            if len({is_object(candidate.symbol) for candidate in error.candidates}) < 2:
                raise  # all are nouns, or all are adjectives
        plain = " ".join(words(self.text))
        tags = [part_of_speech(plain, phrase) for phrase in task.arguments]
        return evaluate(template, task, environment, parts_of_speech=tags)

    def _template(self, task: ContextualQuery) -> Template:
        template = self.template_of(task.task)
        assert template is not None
        return template
