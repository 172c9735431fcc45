"""`python -m models.planning`: compile what planning compiles; see `models.planning.warming`."""

from __future__ import annotations

from models.planning.warming import compile_all

if __name__ == "__main__":
    compile_all()
