"""What the service itself refuses, beside what the core refuses.

CqltlError
├── NotFoundError
│   ├── UnknownEnvironmentError
│   ├── UnknownTemplateError
│   ├── UnknownExampleError
│   ├── UnknownPolicyError
│   └── UnknownJobError
├── TemplateConflictError      another template is stored for the task
├── TooManyExamplesError       a template keeps no more pairs or utterances
├── EnvironmentExistsError     an environment of that name is stored
├── NotUnderstoodError         no stored task fits the command to plan
├── AmbiguousCommandError      the command to plan leaves a question open
├── AnswerError                an answer is not one to the question that is asked
├── DrawingTooLargeError       an automaton or a world has too much in it to be drawn
├── OutOfTimeError             a budget of time was spent
├── OutOfMemoryError           the work needs more memory than a process may have
├── WorkerDiedError            the process that did the work died
├── KeyInUseError              an Idempotency-Key came with another request before
├── OverloadedError            too many requests wait already
└── NotReadyError              the store does not answer
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from models.errors import CqltlError

if TYPE_CHECKING:
    from service.questions import Question


class CannotStartError(Exception):
    """The service cannot start, and nobody has asked it for anything yet; the message is one line that says why."""


class NotFoundError(CqltlError):
    """What the request names is not stored."""

    slug = "not-found"


class UnknownEnvironmentError(NotFoundError):
    """No environment of this name is stored."""

    slug = "unknown-environment"


class UnknownTemplateError(NotFoundError):
    """No template is stored for this task."""

    slug = "unknown-template"


class UnknownExampleError(NotFoundError):
    """The task has no example with this id."""

    slug = "unknown-example"


class UnknownPolicyError(NotFoundError):
    """No policy with this id is stored."""

    slug = "unknown-policy"


class UnknownJobError(NotFoundError):
    """No job with this id is stored."""

    slug = "unknown-job"


class TemplateConflictError(CqltlError):
    """The task has another template, and the request did not say to replace it."""

    slug = "template-conflict"


class TooManyExamplesError(CqltlError):
    """A template keeps no more pairs or utterances."""

    slug = "too-many-examples"


class EnvironmentExistsError(CqltlError):
    """An environment of this name is stored already."""

    slug = "environment-exists"


class NotUnderstoodError(CqltlError):
    """The command to plan fits no stored task."""

    slug = "not-understood"


class AmbiguousCommandError(CqltlError):
    """The command to plan leaves a question open."""

    slug = "ambiguous-command"

    def __init__(self, detail: str, question: Question) -> None:
        super().__init__(detail)
        self.question = question
        self.choices = question.choices


class AnswerError(CqltlError):
    """An answer is none of the choices of the question, or nothing is asked."""

    slug = "wrong-answer"


class DrawingTooLargeError(CqltlError):
    """An automaton has too many states for a picture, or a world too many cells or things."""

    slug = "drawing-too-large"


class OutOfTimeError(CqltlError):
    """The work was stopped at its time limit."""

    slug = "out-of-time"


class OutOfMemoryError(CqltlError):
    """The work was stopped at its limit of memory."""

    slug = "out-of-memory"


class WorkerDiedError(CqltlError):
    """The process that did the work died."""

    slug = "worker-died"


class KeyInUseError(CqltlError):
    """The idempotency key was sent before, with another request."""

    slug = "idempotency-key-reused"


class OverloadedError(CqltlError):
    """Too many requests wait for a worker."""

    slug = "overloaded"


class NotReadyError(CqltlError):
    """The service cannot do its work yet, or no longer."""

    slug = "not-ready"
