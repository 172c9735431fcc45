"""What words mean where they stand: MiniLM, a small language model, whose lower layers are never trained here."""

from models.language.encoder.memory import RememberingReader, WordReader
from models.language.encoder.minilm import DeepReader, Encoder, encoder

__all__ = [
    "DeepReader",
    "Encoder",
    "RememberingReader",
    "WordReader",
    "encoder",
]
