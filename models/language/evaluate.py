"""Measure a trained model on the whole of S and U.

    python -m models.language.evaluate [--weights FOLDER] [--name NAME] [--json FILE]

Prints, by task class, how many commands of S and U get exactly the right contextual query from beam search, with the
least confidence applied, and how many texts that no task fits are refused. One thread, a few minutes.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

import torch

from models.language import accuracy
from models.language.accuracy import Tally
from models.language.dataset import Domain, generate, no_task
from models.language.translator import CopyNetTranslator
from models.language.weights import DEFAULT_NAME, Model, load_model


def main(arguments: Sequence[str] | None = None) -> None:
    """Read the command line, measure, print."""
    parser = argparse.ArgumentParser(description="Measure a trained model on S and U.")
    parser.add_argument("--weights", type=Path, help="folder of the model; the one that is shipped if not given")
    parser.add_argument("--name", default=DEFAULT_NAME, help="name of its files")
    parser.add_argument("--json", type=Path, help="write the counts to this file")
    options = parser.parse_args(arguments)
    torch.set_num_threads(1)
    model = load_model(options.weights, name=options.name)
    domains = [Domain(name) for name in str(model.training["domains"]).split()]
    table = measure(model, domains)
    for row, tally in table.items():
        print(f"{row:32} {tally}")
    if options.json:
        options.json.write_text(json.dumps({row: asdict(tally) for row, tally in table.items()}, indent=1) + "\n")


def measure(model: Model, domains: Sequence[Domain]) -> dict[str, Tally]:
    """The translator's accuracy on S and U by task class, and its refusals of the texts kept from training."""
    translator = CopyNetTranslator(model.network, model.vocabulary, model.arities, model.min_confidence)
    table: dict[str, Tally] = {}
    for domain in domains:
        for part, examples in (("S", generate(domain).seen), ("U", generate(domain).unseen)):
            tallies = accuracy.by_task(translator, examples)
            total = Tally(sum(t.right for t in tallies.values()), sum(t.total for t in tallies.values()))
            table |= {f"{part} {domain}/{task}": tally for task, tally in tallies.items()}
            table[f"{part} {domain}"] = total
    table["no task, held out"] = accuracy.refusals(translator, no_task(seed=int(model.training["seed"])).held_out)
    return table


if __name__ == "__main__":
    main()
