"""Commands matched with taught tasks by what they mean: same task, other words."""

from models.language.matching.matcher import Matcher, Shelf, TaughtTask
from models.language.matching.nearness import Known

__all__ = ["Known", "Matcher", "Shelf", "TaughtTask"]
