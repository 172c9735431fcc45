"""Policies as bytes and as JSON: the same policy always gives the same bytes.

Bytes: the magic `cqltl\\0p2`, the length of the header (4 bytes, little-endian), the header (JSON, UTF-8,
keys sorted), then one zlib stream of the arrays `letter` ([places]), `action`, `probability` and `expected_steps`
([rows, places]) and, if the header has a kind for it, `indices` ([places]), each little-endian, row by row, of the
`kinds` that the header says. No clock, host or library version goes in.

JSON: see `to_json`.
"""

from __future__ import annotations

import json
import struct
import zlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

from models.planning.errors import InvalidPolicyError
from models.planning.policy import Policy
from models.world import Variable

MAGIC = b"cqltl\0p2"
LEVEL = 1
"""zlib level: on these arrays higher ones cost several times the time for a few percent."""


def to_bytes(policy: Policy) -> bytes:
    """Store a policy; `from_bytes` reads it back equal."""
    header = json.dumps(_header(policy), sort_keys=True, separators=(",", ":"), ensure_ascii=False).encode()
    stream = zlib.compressobj(LEVEL)
    body = [stream.compress(_little(array).data) for array in _arrays(policy)]
    return b"".join([MAGIC, struct.pack("<I", len(header)), header, *body, stream.flush()])


def _arrays(policy: Policy) -> tuple[NDArray[Any], ...]:
    arrays = (policy.letter, policy.action, policy.probability, policy.expected_steps)
    return arrays if policy.indices is None else (*arrays, policy.indices)


def _little(array: NDArray[Any]) -> NDArray[Any]:
    return np.ascontiguousarray(array, dtype=array.dtype.newbyteorder("<"))


def from_bytes(data: bytes) -> Policy:
    """Read a stored policy; raises InvalidPolicyError."""
    start = len(MAGIC) + 4
    if data[: len(MAGIC)] != MAGIC or len(data) < start:
        raise InvalidPolicyError("these bytes do not begin like a stored policy")
    end = start + struct.unpack("<I", data[len(MAGIC) : start])[0]
    try:
        header = json.loads(data[start:end])
        variables = tuple(Variable(v["object"], v["attribute"], tuple(v["values"])) for v in header["variables"])
        automaton = header["automaton"]
        row = np.array(automaton["row"], dtype=np.int32)
        letter, action, probability, steps, *indices = _read_arrays(
            data[end:], header["kinds"], places=header["places"], rows=int(row.max(initial=-1)) + 1
        )
        return Policy(
            variables=variables,
            strides=tuple(v["stride"] for v in header["variables"]),
            harmless=tuple(tuple(v["harmless"]) for v in header["variables"]),
            indices=indices[0] if indices else None,
            actions=tuple(header["actions"]),
            formula=header["formula"],
            atoms=tuple(header["atoms"]),
            hoa=header["hoa"],
            initial_state=header["initial"]["state"],
            initial_memory=header["initial"]["memory"],
            successors=np.array(automaton["successors"], dtype=np.int32),
            accepted=np.array(automaton["accepted"], dtype=np.bool_),
            row=row,
            letter=letter,
            action=action,
            probability=probability,
            expected_steps=steps,
        )
    except (KeyError, TypeError, ValueError, zlib.error) as error:
        raise InvalidPolicyError(f"the stored policy is damaged: {error}") from error


def _read_arrays(body: bytes, names: list[str], *, places: int, rows: int) -> list[NDArray[Any]]:
    kinds = [f"<{name}" for name in names]
    shapes = [(places,), (rows, places), (rows, places), (rows, places), (places,)][: len(kinds)]
    sizes = [int(np.dtype(kind).itemsize * np.prod(shape)) for kind, shape in zip(kinds, shapes, strict=True)]
    stream = zlib.decompressobj()
    raw = stream.decompress(body, sum(sizes) + 1)
    if len(raw) != sum(sizes) or not stream.eof:
        raise ValueError("its arrays do not have the size that the header says")
    arrays, position = [], 0
    for kind, shape, size in zip(kinds, shapes, sizes, strict=True):
        array = np.frombuffer(raw[position : position + size], dtype=kind).reshape(shape)
        arrays.append(array.astype(array.dtype.newbyteorder("=")))
        position += size
    return arrays


def _header(policy: Policy) -> dict[str, Any]:
    return {
        "actions": list(policy.actions),
        "atoms": list(policy.atoms),
        "automaton": {
            "accepted": policy.accepted.astype(int).tolist(),
            "row": policy.row.tolist(),
            "successors": policy.successors.tolist(),
        },
        "kinds": [array.dtype.str[1:] for array in _arrays(policy)],
        "formula": policy.formula,
        "hoa": policy.hoa,
        "places": policy.places,
        "initial": {"state": policy.initial_state, "memory": policy.initial_memory},
        "variables": [
            {
                "object": v.object,
                "attribute": v.attribute,
                "values": list(v.values),
                "stride": stride,
                "harmless": list(harmless),
            }
            for v, stride, harmless in zip(policy.variables, policy.strides, policy.harmless, strict=True)
        ],
    }


def to_json(policy: Policy) -> dict[str, Any]:
    """The whole policy as JSON values.

    `place = Σ stride[v] · (position of the state's value in variables[v].values)`; where `indices` is not null, the
    place is instead where that sum stands in `indices`, which is ascending (if it does not: the state cannot be reached
    from where the plan began; plan again). A variable with the stride 0 does not matter as long as that position is in
    its `harmless` (otherwise: plan again). `letter[place]` is what is read
    there (bit i: `atoms[i]` holds; -1: the state is invalid), and `after = automaton.successors[memory][letter]` the
    memory to use at the next state (start with `initial.memory`). Where `automaton.row[after]` is -1 the outcome is
    decided: the formula holds where `automaton.accepted[after]` is 1, else it cannot any more. Otherwise `entry =
    automaton.row[after] · places + place` of the flat arrays:

    - `action`: index into `actions`; -1 nothing to do (it cannot be satisfied any more, or the state is invalid); -2 no
      action is enabled, let one step pass;
    - `probability` of satisfying the formula and `expected_steps` until the outcome is decided, under this policy,
      rounded to 9 decimals. 0 steps with an action: the formula holds if the policy is followed for ever.
    """
    header = _header(policy)
    del header["kinds"]
    return {
        **header,
        "memories": policy.memories,
        "indices": None if policy.indices is None else policy.indices.tolist(),
        "letter": policy.letter.tolist(),
        "action": policy.action.ravel().tolist(),
        "probability": np.round(policy.probability, 9).ravel().tolist(),
        "expected_steps": _rounded(policy.expected_steps).ravel().tolist(),
    }


def _rounded(steps: NDArray[np.float64]) -> NDArray[np.float64]:
    """To 9 decimals, but never to 0 what is more: 0 has a meaning."""
    rounded: NDArray[np.float64] = np.round(steps, 9)
    return np.where((rounded == 0) & (steps > 0), steps, rounded)
