"""What the exchange of models refuses.

CqltlError
├── ExportTooLargeError    what would be written is beyond a limit
├── StormMissingError      reading PRISM needs stormpy, which is not installed
├── PrismSyntaxError       the text is not PRISM: line, column, caret
├── PrismConstantError     constants that are undefined, unknown or of the wrong type
└── PrismModelError        a model that is no MDP or DTMC, has several initial states, is broken or too large
"""

from __future__ import annotations

from models.errors import CqltlError, Place


class ExportTooLargeError(CqltlError):
    """The exported text would have more states or more parts than the limit allows."""

    slug = "export-too-large"


class StormMissingError(CqltlError):
    """Storm is needed to read PRISM models and is not importable."""

    slug = "storm-missing"


class PrismSyntaxError(CqltlError):
    """The text is not a PRISM model.

    `line` and `column` are 1-based and where Storm's parser gave up; `caret` is that line over a `^`. All are None
    for what Storm refuses without a place.
    """

    slug = "prism-syntax"

    def __init__(
        self, detail: str, *, line: int | None = None, column: int | None = None, caret: str | None = None
    ) -> None:
        super().__init__(detail, places=(Place("", detail),))
        self.line = line
        self.column = column
        self.caret = caret


class PrismConstantError(CqltlError):
    """The constants given do not fit those that the model leaves open."""

    slug = "prism-constant"


class PrismModelError(CqltlError):
    """The model can be read, but is none that an explicit environment can hold."""

    slug = "prism-model"
