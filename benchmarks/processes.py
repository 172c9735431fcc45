"""What the operating system says of the processes below one: Linux's /proc."""

from __future__ import annotations

import os
import time
from dataclasses import dataclass
from pathlib import Path


def children(pid: int) -> set[int]:
    """The processes that a process started."""
    numbers = (int(entry.name) for entry in Path("/proc").iterdir() if entry.name.isdigit())
    return {number for number in numbers if _parent(number) == pid}


def grandchildren(pid: int) -> set[int]:
    """What its children started: of a service, its worker processes, which its fork server starts."""
    return {found for child in children(pid) for found in children(child)}


def computing(pids: set[int], seconds: float = 0.5) -> int:
    """How many of them compute most of that time."""
    before = {pid: cpu(pid) for pid in pids}
    time.sleep(seconds)
    ticks = seconds * os.sysconf("SC_CLK_TCK")
    return sum(cpu(pid) - before[pid] > ticks / 5 for pid in pids if alive(pid))  # machines are shared


def busiest(pids: set[int], seconds: float = 0.3) -> int:
    """The one that computes the most in that time."""
    before = {pid: cpu(pid) for pid in pids}
    time.sleep(seconds)
    return max(pids, key=lambda pid: cpu(pid) - before[pid])


def cpu(pid: int) -> int:
    """Ticks of processor time; 0 for a process that is gone."""
    fields = _stat(pid)
    return 0 if fields is None else int(fields[11]) + int(fields[12])


def alive(pid: int) -> bool:
    """It exists, and not only for its parent to be told of its end."""
    fields = _stat(pid)
    return fields is not None and fields[0] != "Z"


def gone_within(pid: int, seconds: float) -> bool:
    """Whether the process is gone in that time."""
    until = time.monotonic() + seconds
    while alive(pid):
        if time.monotonic() > until:
            return False
        time.sleep(0.01)
    return True


def memory(pid: int) -> int:
    """Resident bytes."""
    return int(Path(f"/proc/{pid}/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


@dataclass(frozen=True)
class Usage:
    """What a process and those below it hold."""

    descriptors: int
    threads: int
    memory: int
    """Resident bytes, what is shared divided among those who share it."""


def usage(pid: int) -> Usage:
    """Of the process and all below it."""
    pids = _below(pid)
    return Usage(
        sum(len(list(Path(f"/proc/{each}/fd").iterdir())) for each in pids),
        sum(len(list(Path(f"/proc/{each}/task").iterdir())) for each in pids),
        sum(_proportional_bytes(each) for each in pids),
    )


def _below(pid: int) -> list[int]:
    pids = [pid]
    for each in pids:  # grows while it is read
        pids += children(each)
    return pids


def _proportional_bytes(pid: int) -> int:
    lines = Path(f"/proc/{pid}/smaps_rollup").read_text(encoding="ascii").splitlines()
    return next(int(line.split()[1]) * 1024 for line in lines if line.startswith("Pss:"))


def _parent(pid: int) -> int | None:
    fields = _stat(pid)
    return None if fields is None else int(fields[1])


def _stat(pid: int) -> list[str] | None:
    """The fields of /proc/PID/stat after the name: state, parent, ..."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return None
