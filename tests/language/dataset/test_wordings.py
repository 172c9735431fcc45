"""The trained wordings, in the form of taught ones: each reads the commands that it was made from."""

from __future__ import annotations

from models.language.dataset.corpus import Domain, read_corpus
from models.language.dataset.wordings import trained_wordings
from models.language.tokens import words


def test_every_wording_of_the_corpora_reads_its_command() -> None:
    known: dict[str, list[str]] = {}
    for domain in Domain:
        for task in read_corpus(domain).tasks:
            filled = {slot: f"zorb{number}" for number, slot in enumerate(task.arguments)}
            expected = f"{task.name}({', '.join(filled.values())})"
            for wording in task.wordings:
                said = words(wording.format_map(filled))
                found = {str(query) for w in trained_wordings() if (query := w.match(said)) is not None}
                known.setdefault(task.name, []).append(wording)
                assert expected in found, wording
    assert {wording.task for wording in trained_wordings()} == set(known)
    assert len(trained_wordings()) > sum(map(len, known.values()))
