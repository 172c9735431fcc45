"""The default translator: which task, and which words name its arguments.

`training` makes what `SpanTranslator` loads; it is not imported here, so that a service need not load what it needs.
"""

from models.language.spans.model import DEFAULT_NAME, SpanModel, load_model, save_model
from models.language.spans.translator import SpanTranslator

__all__ = ["DEFAULT_NAME", "SpanModel", "SpanTranslator", "load_model", "save_model"]
