"""Task classes of many worlds with their wordings, to learn from what makes two commands ask for the same.

They are training data only. The classes by which teaching is measured (`models/language/dataset/teaching`) are of
other worlds, and none of them is here.
"""

from models.language.dataset.tasks.reader import TaskClass, task_classes

__all__ = ["TaskClass", "task_classes"]
