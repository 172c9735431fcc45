"""The store: templates, environments and policies in a SQL database."""

from service.store.environments import EnvironmentRepository, StoredEnvironment
from service.store.examples import ExampleRepository, StoredExample
from service.store.policies import PolicyRepository, StoredPolicy
from service.store.store import Store, Transaction
from service.store.templates import StoredPair, StoredTemplate, TemplateRepository

__all__ = [
    "EnvironmentRepository",
    "ExampleRepository",
    "PolicyRepository",
    "Store",
    "StoredEnvironment",
    "StoredExample",
    "StoredPair",
    "StoredPolicy",
    "StoredTemplate",
    "TemplateRepository",
    "Transaction",
]
