"""What words mean where they stand: MiniLM, a small language model, read once and never trained here."""

from models.language.encoder.minilm import MEANING, Encoder, encoder

__all__ = ["MEANING", "Encoder", "encoder"]
