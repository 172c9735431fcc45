"""Commands matched with taught tasks by what they mean: same task, other words."""

from models.language.matching.late import Known
from models.language.matching.matcher import Matcher, Shelf, TaughtTask

__all__ = ["Known", "Matcher", "Shelf", "TaughtTask"]
