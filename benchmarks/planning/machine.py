"""What the figures were measured on."""

from __future__ import annotations

import os
import platform
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

import torch

PACKAGES = ("stormpy", "mdpsolver", "pymdptoolbox", "numpy", "scipy", "numba", "torch")


def gpu() -> str | None:
    """The name of the GPU that torch would use."""
    return torch.cuda.get_device_name() if torch.cuda.is_available() else None


def memory() -> int:
    """Bytes of the machine."""
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")


def machine() -> dict[str, str | int | None]:
    """By name; None for what is not there."""
    return {
        "cpu": _cpu(),
        "cores": len(os.sched_getaffinity(0)),
        "memory_gib": round(memory() / 2**30),
        "gpu": gpu(),
        "python": platform.python_version(),
        **{package: _version(package) for package in PACKAGES},
    }


def described(found: dict[str, str | int | None]) -> str:
    """In one line."""
    versions = ", ".join(f"{name} {found[name]}" for name in PACKAGES if found[name])
    return (
        f"{found['cpu']}, {found['cores']} cores, {found['memory_gib']} GiB, {found['gpu'] or 'no GPU'}; "
        f"Python {found['python']}, {versions}"
    )


def _cpu() -> str:
    for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
        if line.startswith("model name"):
            return line.partition(":")[2].strip()
    return platform.processor() or platform.machine()


def _version(package: str) -> str | None:
    try:
        return version(package)
    except PackageNotFoundError:
        return None
