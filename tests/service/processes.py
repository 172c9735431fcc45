"""What the operating system says of the processes below one: Linux's /proc."""

from __future__ import annotations

import os
import time
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


def _parent(pid: int) -> int | None:
    fields = _stat(pid)
    return None if fields is None else int(fields[1])


def _stat(pid: int) -> list[str] | None:
    """The fields of /proc/PID/stat after the name: state, parent, ..."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return None
