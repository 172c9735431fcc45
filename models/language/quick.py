"""Tiny runs of the commands that train networks: through everything in minutes, with figures that mean nothing."""

from __future__ import annotations

import os

QUICK = "a tiny run to see that everything works; also with CQLTL_QUICK=1"
"""What `--quick` does."""


def quick() -> bool:
    """Whether such runs are asked for by the environment."""
    return bool(os.environ.get("CQLTL_QUICK"))
