"""What the language package refuses.

CqltlError
├── TextTooLongError        a command beyond the limits on characters or words
├── VocabularyError         a data file of the datasets does not say what it must
├── WeightsError            a trained model is missing, damaged, or does not fit the code
└── TrainingError           a training run cannot be done as asked
"""

from __future__ import annotations

from models.errors import CqltlError


class TextTooLongError(CqltlError):
    """The text has more characters or words than a command may have."""

    slug = "text-too-long"


class VocabularyError(CqltlError):
    """A data file of the datasets is wrong; `places` point into it."""

    slug = "invalid-vocabulary"


class WeightsError(CqltlError):
    """A trained model is missing, damaged, or does not fit the code."""

    slug = "invalid-weights"


class TrainingError(CqltlError):
    """A training run cannot be done as asked."""

    slug = "invalid-training"
