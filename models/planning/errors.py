"""What planning refuses.

CqltlError
├── ModelTooLargeError       more states or memory than the limit allows
├── DeviceUnavailableError   the device asked for is not on this machine
├── InvalidMemoryError       a memory that the policy does not have
├── UncheckableError         the policy's chain cannot be evaluated
└── InvalidPolicyError       the bytes are not a stored policy
"""

from __future__ import annotations

from models.errors import CqltlError, Place


class ModelTooLargeError(CqltlError):
    """The product of world and automaton is beyond a limit; nothing was allocated.

    `estimate` and `limit` are in `unit`: "states" or "bytes". The place is the whole of what was asked.
    """

    slug = "model-too-large"

    def __init__(self, detail: str, *, estimate: int, limit: int, unit: str) -> None:
        super().__init__(detail, places=[Place("", detail)])
        self.estimate = estimate
        self.limit = limit
        self.unit = unit


class DeviceUnavailableError(CqltlError):
    """The device asked for is not on this machine."""

    slug = "device-unavailable"


class InvalidMemoryError(CqltlError):
    """The memory is not one of the policy's."""

    slug = "invalid-memory"


class UncheckableError(CqltlError):
    """A policy's Markov chain is too large, or too close to singular, to be evaluated by linear systems."""

    slug = "uncheckable"


class InvalidPolicyError(CqltlError):
    """The bytes are not a policy, or not one of a version this code reads."""

    slug = "invalid-policy"
