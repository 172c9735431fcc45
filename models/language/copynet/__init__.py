"""The three systems of the paper (§ Training Pipelines): CQ-CopyNet, CQ-CopyNet+POS and LTL-CopyNet.

`train` fits the two networks of a domain together, `answers`, `pos_answers` and `formulas` ask them many texts at once,
and the translators are what `/translate` serves.
"""

from models.language.copynet.answers import answers, formulas, outputs, pos_answers, pos_arguments
from models.language.copynet.formulas import read_formula, spell_formula
from models.language.copynet.training import Models, Settings, train, train_paper
from models.language.copynet.translators import (
    CqCopyNetPosTranslator,
    CqCopyNetTranslator,
    FormulaTranslation,
    LtlCopyNetTranslator,
)
from models.language.copynet.weights import Model, System, load_model, model_name, save_model

__all__ = [
    "CqCopyNetPosTranslator",
    "CqCopyNetTranslator",
    "FormulaTranslation",
    "LtlCopyNetTranslator",
    "Model",
    "Models",
    "Settings",
    "System",
    "answers",
    "formulas",
    "load_model",
    "model_name",
    "outputs",
    "pos_answers",
    "pos_arguments",
    "read_formula",
    "save_model",
    "spell_formula",
    "train",
    "train_paper",
]
