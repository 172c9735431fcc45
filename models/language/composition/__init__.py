"""Commands put together: which clauses a text has, and how they belong together.

`lessons` is what its network is taught; it is not imported here, so that a service need not load what it needs.
"""

from models.language.composition.translator import NAME, ComposedTranslator

__all__ = ["NAME", "ComposedTranslator"]
