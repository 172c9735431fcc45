"""What `python -m models.language.evaluate` does: the paper's experiments, and those of the default translator.

runs  ──►  transcripts, systems  ──►  measurements  ──►  results.json  ──►  figures, tables
"""

from models.language.experiments.answer import Answer, System
from models.language.experiments.commands import CommandSet, paper_sets
from models.language.experiments.default import default_part, default_steps
from models.language.experiments.default_system import DefaultSystem, trained_system
from models.language.experiments.measurement import Measurement, Score, judge, measure
from models.language.experiments.paper import paper_part, paper_steps
from models.language.experiments.results import read_results, tables, write_page, write_results
from models.language.experiments.runs import Runs
from models.language.experiments.settings import Settings

__all__ = [
    "Answer",
    "CommandSet",
    "DefaultSystem",
    "Measurement",
    "Runs",
    "Score",
    "Settings",
    "System",
    "default_part",
    "default_steps",
    "judge",
    "measure",
    "paper_part",
    "paper_sets",
    "paper_steps",
    "read_results",
    "tables",
    "trained_system",
    "write_page",
    "write_results",
]
