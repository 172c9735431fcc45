"""Commands put together: which clauses a text has, and how they belong together.

`lessons` is what its networks are taught; it is not imported here, so that a service need not load what it needs.
"""

from models.language.composition.translator import NAMES, ComposedTranslator

__all__ = ["NAMES", "ComposedTranslator"]
