"""The cache against a list that does the same slowly."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from service.cache import ByteCache

STEPS = st.lists(
    st.tuples(st.sampled_from(["put", "get", "forget"]), st.sampled_from("abcde"), st.integers(0, 12)), max_size=60
)


@given(STEPS, st.integers(0, 20))
def test_what_was_used_longest_ago_goes_first(steps: list[tuple[str, str, int]], most: int) -> None:
    cache: ByteCache[str, int] = ByteCache(most)
    held: list[tuple[str, int, int]] = []  # key, value, size; the least recently used first
    for number, (what, key, size) in enumerate(steps):
        before = [entry for entry in held if entry[0] == key]
        held = [entry for entry in held if entry[0] != key]
        if what == "put":
            cache.put(key, number, size)
            held += [(key, number, size)] if size <= most else []
            while sum(entry[2] for entry in held) > most:
                held.pop(0)
        elif what == "get":
            assert cache.get(key) == (before[0][1] if before else None)
            held += before
        else:
            cache.forget(key)
        assert cache.bytes == sum(entry[2] for entry in held) <= most
        assert len(cache) == len(held)
