"""Exchange with other tools: worlds and products in the PRISM language and in Storm's DRN, PRISM models as worlds."""

from models.interchange.drn import drn_model
from models.interchange.errors import (
    ExportTooLargeError,
    PrismConstantError,
    PrismModelError,
    PrismSyntaxError,
    StormMissingError,
)
from models.interchange.listing import MAX_EXPORT_STATES
from models.interchange.names import label_names
from models.interchange.prism import prism_model
from models.interchange.prism_import import read_prism
from models.interchange.product import drn_product, product_property
from models.interchange.properties import property_text

__all__ = [
    "MAX_EXPORT_STATES",
    "ExportTooLargeError",
    "PrismConstantError",
    "PrismModelError",
    "PrismSyntaxError",
    "StormMissingError",
    "drn_model",
    "drn_product",
    "label_names",
    "prism_model",
    "product_property",
    "property_text",
    "read_prism",
]
