"""What clients that never finish cost the others, and how long they are put up with.

    python -m benchmarks.slow_clients [--sockets 200]

Opens so many sockets of five kinds to a server of its own: nothing sent, half a head, a head that drips, half a body, a
body that drips. Sends ordinary requests meanwhile until the server has closed every socket. Prints how long sockets of
each kind were open, at most, and the latencies of POST /translate and GET /livez alone and meanwhile. The exit status
is 1 where a socket was open for more than 10 s, or where more than one ordinary request in a hundred took over 100 ms.
"""

from __future__ import annotations

import argparse
import selectors
import socket
import statistics
import sys
import threading
import time
from collections.abc import Mapping, Sequence

import httpx

from benchmarks.server import serving

HEAD = b"POST /translate HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\nContent-Length: 50000\r\n"
LONGEST_S = 10.0
SLOW_MS = 100.0
KINDS: Mapping[str, tuple[bytes, bytes]] = {  # what is sent at once, and what drips
    "idle": (b"", b""),
    "half head": (HEAD[:60], b""),
    "dripping head": (HEAD[:60], b"x"),
    "half body": (HEAD + b'\r\n{"text": "go', b""),
    "dripping body": (HEAD + b'\r\n{"text": "go', b" "),
}
DRIP_S = 0.5
PATIENCE_S = 60.0
TEXT = {"text": "Put the cylinder in the box, then put the box in the bedroom", "environment": "toys"}


def attack(host: str, port: int, sockets: int) -> dict[str, list[float]]:
    """Seconds that each socket was open, by kind; infinite where the server has not closed it."""
    lasted: dict[str, list[float]] = {kind: [] for kind in KINDS}
    chosen = selectors.DefaultSelector()
    for number in range(sockets):
        kind = list(KINDS)[number % len(KINDS)]
        raw = socket.create_connection((host, port))
        raw.setblocking(False)
        raw.send(KINDS[kind][0])
        chosen.register(raw, selectors.EVENT_READ, (kind, time.monotonic()))
    until, drip_at = time.monotonic() + PATIENCE_S, 0.0
    while chosen.get_map() and time.monotonic() < until:
        for key, _ in chosen.select(0.05):
            if _closed(key.fileobj):  # type: ignore[arg-type]
                kind, opened = key.data
                lasted[kind].append(time.monotonic() - opened)
                chosen.unregister(key.fileobj)
        if time.monotonic() > drip_at:
            drip_at = time.monotonic() + DRIP_S
            for key in chosen.get_map().values():
                _drip(key.fileobj, KINDS[key.data[0]][1])  # type: ignore[arg-type]
    for key in chosen.get_map().values():
        lasted[key.data[0]].append(float("inf"))
    return lasted


def _closed(raw: socket.socket) -> bool:
    try:
        found = raw.recv(65_536)
    except OSError:
        found = b""
    if not found:
        raw.close()
    return not found


def _drip(raw: socket.socket, byte: bytes) -> None:
    try:
        raw.send(byte)
    except OSError:
        return  # it is read as closed next


def timed(client: httpx.Client, over: threading.Event, least: int) -> dict[str, list[float]]:
    """Milliseconds of ordinary requests, until it is over."""
    taken: dict[str, list[float]] = {"translate": [], "livez": []}
    while len(taken["livez"]) < least or not over.is_set():
        for name in taken:
            began = time.perf_counter()
            answer = client.post("/translate", json=TEXT) if name == "translate" else client.get("/livez")
            answer.raise_for_status()
            taken[name].append((time.perf_counter() - began) * 1_000)
        time.sleep(0.01)
    return taken


def broken(open_s: Mapping[str, Sequence[float]], latencies_ms: Mapping[str, Sequence[float]]) -> list[str]:
    """What is not as promised, of sockets and of ordinary requests."""
    late = [f"{kind}: open for {max(seconds):.1f} s" for kind, seconds in open_s.items() if max(seconds) > LONGEST_S]
    slow = [f"{name}: p99 of {p99:.0f} ms" for name, taken in latencies_ms.items() if (p99 := _p99(taken)) > SLOW_MS]
    return late + slow


def _p99(taken: Sequence[float]) -> float:
    return statistics.quantiles(taken, n=100)[98]


def main(arguments: Sequence[str] | None = None) -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0] if __doc__ else None)
    parser.add_argument("--sockets", type=int, default=200)
    options = parser.parse_args(arguments)
    found: dict[str, list[float]] = {}
    with serving() as client:
        over = threading.Event()
        over.set()
        timed(client, over, 20)
        alone = timed(client, over, 100)
        over.clear()

        def attacked() -> None:
            found.update(attack(client.base_url.host, client.base_url.port or 80, options.sockets))
            over.set()

        attacker = threading.Thread(target=attacked)
        attacker.start()
        meanwhile = timed(client, over, 100)
        attacker.join()
    for kind, seconds in found.items():
        print(f"{kind}: {len(seconds)} sockets, closed after {max(seconds):.1f} s at most")
    for when, latencies in (("alone", alone), ("meanwhile", meanwhile)):
        for name, taken in latencies.items():
            print(f"{name} {when}: median {statistics.median(taken):.1f} ms, worst of {len(taken)} {max(taken):.1f} ms")
    if faults := broken(found, meanwhile):
        sys.exit("\n".join(faults))


if __name__ == "__main__":
    main()
