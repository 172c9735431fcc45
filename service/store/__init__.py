"""The store: templates, environments, policies and jobs in a SQL database."""

from service.store.answers import AnswerRepository, KeptAnswer, Once
from service.store.environments import EnvironmentRepository, StoredEnvironment
from service.store.examples import ExampleRepository, StoredExample
from service.store.jobs import JobRepository, JobState, NewJob, StoredJob
from service.store.policies import PolicyRepository, StoredPolicy
from service.store.store import Store, Transaction
from service.store.templates import StoredPair, StoredTemplate, TemplateRepository
from service.store.versions import Versions

__all__ = [
    "AnswerRepository",
    "EnvironmentRepository",
    "ExampleRepository",
    "JobRepository",
    "JobState",
    "KeptAnswer",
    "NewJob",
    "Once",
    "PolicyRepository",
    "Store",
    "StoredEnvironment",
    "StoredExample",
    "StoredJob",
    "StoredPair",
    "StoredPolicy",
    "StoredTemplate",
    "TemplateRepository",
    "Transaction",
    "Versions",
]
