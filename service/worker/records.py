"""Plans to be made, and what was found, as JSON texts: what the store keeps of a job."""

from __future__ import annotations

import json
from dataclasses import asdict, fields, replace
from typing import Any

from pydantic import TypeAdapter

from models.logic import Dialect, parse
from models.logic import to_text as formula_text
from service.worker.jobs import PlanAnswer, PlanJob

_ANSWER = TypeAdapter(PlanAnswer)


def job_text(job: PlanJob) -> str:
    """A plan to be made."""
    values = {field.name: getattr(job, field.name) for field in fields(job)}
    return json.dumps(values | {"formula": formula_text(job.formula, Dialect.INFIX)}, ensure_ascii=False)


def read_job(text: str) -> PlanJob:
    """The plan to be made of a text by `job_text`; resolved formulas are the same formulas when they are read again."""
    values: dict[str, Any] = json.loads(text)
    return PlanJob(**values | {"formula": parse(values["formula"], dialect=Dialect.INFIX)})


def answer_text(answer: PlanAnswer) -> str:
    """What was found, without the policy."""
    return json.dumps(asdict(replace(answer, policy=None)), ensure_ascii=False)  # infinite steps: Infinity


def read_answer(text: str) -> PlanAnswer:
    """What was found, of a text by `answer_text`."""
    return _ANSWER.validate_python(json.loads(text))
