"""What words mean where they stand: MiniLM, a small language model, whose lower layers are never trained here."""

from models.language.encoder.memory import RememberingReader, WordReader
from models.language.encoder.minilm import Encoder, Pieced, encoder
from models.language.encoder.upper import UpperLayers, adapters, load_adapters

__all__ = [
    "Encoder",
    "Pieced",
    "RememberingReader",
    "UpperLayers",
    "WordReader",
    "adapters",
    "encoder",
    "load_adapters",
]
