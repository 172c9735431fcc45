"""Policies as bytes and as JSON: the same policy always gives the same bytes.

Bytes: the magic `cqltl\\0p1`, the length of the header (4 bytes, little-endian), the header (JSON, UTF-8,
keys sorted), then one zlib stream of the arrays `action` and `next_memory` (int32), `probability` and
`expected_steps` (float64), each little-endian, [memories, states], row by row. No clock, host or library
version goes in.

JSON: see `to_json`.
"""

from __future__ import annotations

import json
import struct
import zlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

from models.planning import codec
from models.planning.errors import InvalidPolicyError
from models.planning.policy import Policy
from models.world import Variable

MAGIC = b"cqltl\0p1"
LEVEL = 1
"""zlib level: on these arrays higher ones cost several times the time for a few percent."""

_ARRAYS = (("action", "<i4"), ("next_memory", "<i4"), ("probability", "<f8"), ("expected_steps", "<f8"))


def to_bytes(policy: Policy) -> bytes:
    """Store a policy; `from_bytes` reads it back equal."""
    header = json.dumps(_header(policy), sort_keys=True, separators=(",", ":"), ensure_ascii=False).encode()
    stream = zlib.compressobj(LEVEL)
    body = [stream.compress(np.ascontiguousarray(getattr(policy, name), dtype=kind).data) for name, kind in _ARRAYS]
    return b"".join([MAGIC, struct.pack("<I", len(header)), header, *body, stream.flush()])


def from_bytes(data: bytes) -> Policy:
    """Read a stored policy; raises InvalidPolicyError."""
    start = len(MAGIC) + 4
    if data[: len(MAGIC)] != MAGIC or len(data) < start:
        raise InvalidPolicyError("these bytes do not begin like a stored policy")
    end = start + struct.unpack("<I", data[len(MAGIC) : start])[0]
    try:
        header = json.loads(data[start:end])
        memories = len(header["accepted"])
        variables = tuple(Variable(v["object"], v["attribute"], tuple(v["values"])) for v in header["variables"])
        shape = (memories, codec.size(variables))
        arrays = _read_arrays(data[end:], shape)
        return Policy(
            variables=variables,
            actions=tuple(header["actions"]),
            formula=header["formula"],
            atoms=tuple(header["atoms"]),
            hoa=header["hoa"],
            initial_state=header["initial"]["state"],
            initial_memory=header["initial"]["memory"],
            accepted=np.array(header["accepted"], dtype=np.bool_),
            **arrays,
        )
    except (KeyError, TypeError, ValueError, zlib.error) as error:
        raise InvalidPolicyError(f"the stored policy is damaged: {error}") from error


def _read_arrays(body: bytes, shape: tuple[int, int]) -> dict[str, NDArray[Any]]:
    count = shape[0] * shape[1]
    total = sum(np.dtype(kind).itemsize for _, kind in _ARRAYS) * count
    stream = zlib.decompressobj()
    raw = stream.decompress(body, total + 1)
    if len(raw) != total or not stream.eof:
        raise ValueError("its arrays do not have the size that the header says")
    arrays, position = {}, 0
    for name, kind in _ARRAYS:
        array = np.frombuffer(raw, dtype=kind, count=count, offset=position)
        arrays[name] = array.reshape(shape).astype(array.dtype.newbyteorder("="))
        position += array.nbytes
    return arrays


def _header(policy: Policy) -> dict[str, Any]:
    return {
        "accepted": policy.accepted.astype(int).tolist(),
        "actions": list(policy.actions),
        "atoms": list(policy.atoms),
        "formula": policy.formula,
        "hoa": policy.hoa,
        "initial": {"state": policy.initial_state, "memory": policy.initial_memory},
        "variables": [
            {"object": v.object, "attribute": v.attribute, "values": list(v.values)} for v in policy.variables
        ],
    }


def to_json(policy: Policy) -> dict[str, Any]:
    """The whole policy as JSON values.

    `state index = Σ stride[v] · (position of the state's value in variables[v].values)`; the flat arrays hold
    `memories · states` entries, `entry = memory · states + state index`, with the memory before the label of
    the state is read (start with `initial.memory`):

    - `action`: index into `actions`; -1 nothing to do (decided, or the state is invalid); -2 no action is
      enabled, let one step pass;
    - `next_memory`: the memory to use at the next state; -1 the state is invalid. Done where
      `accepted[next_memory]` is 1;
    - `probability` of satisfying the formula and `expected_steps` until the outcome is decided, under this
      policy, rounded to 9 decimals. Probability 0 with a valid state: it cannot be satisfied any more.
    """
    header = _header(policy)
    for variable, stride in zip(header["variables"], codec.strides(policy.variables), strict=True):
        variable["stride"] = stride
    return {
        **header,
        "states": policy.states,
        "memories": policy.memories,
        "action": policy.action.ravel().tolist(),
        "next_memory": policy.next_memory.ravel().tolist(),
        "probability": np.round(policy.probability, 9).ravel().tolist(),
        "expected_steps": np.round(policy.expected_steps, 9).ravel().tolist(),
    }
