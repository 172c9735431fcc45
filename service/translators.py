"""The translators that `/translate` offers, each loaded when it is first asked for."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from threading import Lock
from types import ModuleType
from typing import TYPE_CHECKING, Generic, Literal, Protocol, Self, TypeVar

from models.language import ComposedTranslator, Translator

if TYPE_CHECKING:
    from models.language.copynet import FormulaTranslation
    from models.language.matching import Matcher

TranslatorKey = Literal["default", "cq-copynet", "cq-copynet-pos", "ltl-copynet"]
"""The names of the translators."""
DEFAULT: TranslatorKey = "default"
"""The one that taught wordings come before."""

T = TypeVar("T")


class FormulaTranslator(Protocol):
    """What turns a text into formulas, without a contextual query in between."""

    def translate(self, text: str, *, candidates: int = 1) -> tuple[FormulaTranslation, ...]:
        """Up to `candidates` readings, best first; raises TextTooLongError."""


class _Lazy(Generic[T]):
    """A value that is made once, by the first thread that asks for it; the others wait."""

    def __init__(self, make: Callable[[], T]) -> None:
        self._make, self._lock = make, Lock()
        self._made: list[T] = []

    def get(self) -> T:
        """The value."""
        with self._lock:
            if not self._made:
                self._made.append(self._make())
            return self._made[0]


class Translators:
    """Translators by name: those that give contextual queries, and those that give formulas."""

    def __init__(
        self,
        queries: Mapping[str, Callable[[], Translator]],
        formulas: Mapping[str, Callable[[], FormulaTranslator]],
        matcher: Callable[[], Matcher] | None = None,
    ) -> None:
        self._matcher = _Lazy(matcher or _load_matcher)
        self._queries = {name: _Lazy(make) for name, make in queries.items()}
        self._formulas = {name: _Lazy(make) for name, make in formulas.items()}

    @classmethod
    def shipped(cls) -> Self:
        """The default one and the paper's three."""
        return cls(
            {DEFAULT: _default, "cq-copynet": _cq_copynet, "cq-copynet-pos": _cq_copynet_pos},
            {"ltl-copynet": _ltl_copynet},
        )

    @property
    def matcher(self) -> Matcher:
        """What compares commands with what was taught."""
        return self._matcher.get()

    @property
    def own(self) -> frozenset[str]:
        """The tasks that the default translator's networks know."""
        chosen = self.queries(DEFAULT)
        return chosen.tasks if isinstance(chosen, ComposedTranslator) else frozenset()

    def gives_formulas(self, name: str) -> bool:
        """Whether the translator of that name is one for `formulas`, and not for `queries`."""
        return name in self._formulas

    def queries(self, name: str) -> Translator:
        """The translator of that name that gives contextual queries."""
        return self._queries[name].get()

    def formulas(self, name: str) -> FormulaTranslator:
        """The translator of that name that gives formulas."""
        return self._formulas[name].get()


def _default() -> Translator:
    from models.language import SpanTranslator

    return ComposedTranslator.load(SpanTranslator.load())


def _load_matcher() -> Matcher:
    from threadpoolctl import threadpool_limits

    from models.language.matching import Matcher

    threadpool_limits(1, "blas")  # as ONNX Runtime: of two threads for products this small one waits for the other
    return Matcher.load()


def _copynet() -> ModuleType:
    """The paper's systems, which run in torch: seconds to load, and of no use to the default translator."""
    from models.language.tagging import TORCH

    with TORCH:
        import torch

        from models.language import copynet

    torch.set_num_threads(1)  # the networks are small: a second thread makes a translation slower
    return copynet


def _cq_copynet() -> Translator:
    translator: Translator = _copynet().CqCopyNetTranslator.load()
    return translator


def _cq_copynet_pos() -> Translator:
    translator: Translator = _copynet().CqCopyNetPosTranslator.load()
    return translator


def _ltl_copynet() -> FormulaTranslator:
    translator: FormulaTranslator = _copynet().LtlCopyNetTranslator.load()
    return translator
