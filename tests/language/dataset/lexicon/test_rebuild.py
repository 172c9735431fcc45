"""Choosing open words and writing their files, from a sample of WordNet; and the built-in choice against its files."""

from __future__ import annotations

import io
import tarfile
from pathlib import Path
from typing import Any

import pytest
import yaml

from models.language import VocabularyError
from models.language.dataset import Half, open_words
from models.language.dataset.lexicon import rebuild
from models.language.dataset.lexicon.lists import names
from models.language.dataset.lexicon.selection import Selection, read_selection, select, spoken_words
from models.language.dataset.lexicon.wordnet import WordNet, read

NAMES = (
    "hammock, claw_hammock, garden_hammock, ball, crimson_hammock, odd_hammock, sun_hat, sun-hat, Jack, stew_of_beef"
)


def _files() -> dict[str, str]:
    """Every name a kind of `thing`, each word in five definitions but those of the last."""
    things = NAMES.split(", ")
    pointers = " ".join(f"~ {200 + index:08} n 0000" for index in range(len(things)))
    common = "claw garden crimson odd sun hat hammock ball jack " * 5
    lines = [f"00000100 03 n 01 thing 0 {len(things):03} {pointers} | {common}"]
    lines += [f"{200 + i:08} 06 n 01 {name} 0 001 @ 00000100 n 0000 | a thing" for i, name in enumerate(things)]
    index = ["thing n 1 1 ~ 1 0 00000100"]
    index += [f"{name.lower()} n 1 1 @ 1 0 {200 + i:08}" for i, name in enumerate(things)]
    return {"data.noun": "\n".join(["  1 Free.", *lines]), "index.noun": "\n".join(index), "index.sense": ""}


def _selection(**changes: Any) -> Selection:
    choice = {
        "roots": "thing.1",
        "familiar": {"single": 0, "multiple": 5},
        "not_words": "odd",
        "not_names": "thing",
        "also": "deck chair, bench",
        **changes,
    }
    return Selection.model_validate(
        {
            "functions": "of",
            "reserved": "robot, the",
            "colors": {"training": "crimson", "held_out": "dusty  rose, cyan"},
            "lists": {
                "objects": choice,
                "containers": choice,
                "places": {**choice, "also": "", "not_words": "hammock"},
            },
        }
    )


@pytest.fixture(scope="module")
def wordnet() -> WordNet:
    return read(_files())


def _found(selection: Selection, wordnet: WordNet, key: str) -> set[str]:
    parts = select(selection, wordnet)
    return {*parts[Half.TRAINING][key], *parts[Half.HELD_OUT][key]}


def test_what_is_chosen(wordnet: WordNet) -> None:
    """Not a word of the datasets, of a colour or unwanted; not rare; in one spelling; in the last list that has it."""
    assert _found(_selection(), wordnet, "places") == {"sun hat"}
    assert _found(_selection(), wordnet, "objects") == set()
    containers = _found(_selection(), wordnet, "containers")
    assert {"hammock", "bench"} <= containers <= {"hammock", "claw hammock", "garden hammock", "deck chair", "bench"}
    assert len(containers) >= 3


def test_familiarity_decides(wordnet: WordNet) -> None:
    rare = _selection(familiar={"single": 9, "multiple": 0}, also="")
    assert "hammock" not in _found(rare, wordnet, "containers")
    parts = select(rare, wordnet)
    assert any("stew of beef" in names for half in Half for names in parts[half].values()) or "beef" in spoken_words()


def test_colors(wordnet: WordNet) -> None:
    parts = select(_selection(), wordnet)
    assert parts[Half.TRAINING]["colors"] == ("crimson",)
    assert parts[Half.HELD_OUT]["colors"] == ("cyan", "dusty rose")


@pytest.mark.parametrize("name", ["red bench", "my robot", "crimson bench"])
def test_names_that_cannot_be_added(name: str, wordnet: WordNet) -> None:
    with pytest.raises(VocabularyError, match=name):
        select(_selection(also=name), wordnet)


def test_no_such_kind(wordnet: WordNet) -> None:
    with pytest.raises(VocabularyError, match=r"tool\.1"):
        select(_selection(roots="thing.1, tool.1"), wordnet)


def test_files_are_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "sample.tgz"
    with tarfile.open(path, "w:gz") as archive:
        for name, text in _files().items():
            member = tarfile.TarInfo(f"package/dict/{name}")
            member.size = len(text)
            archive.addfile(member, io.BytesIO(text.encode()))
    monkeypatch.setattr(rebuild, "read_selection", _selection)
    written = []
    for folder in ("a", "b"):
        (tmp_path / folder).mkdir()
        rebuild.main([str(path), "--output", str(tmp_path / folder)])
        written.append({half: (tmp_path / folder / f"{half}.yaml").read_text() for half in Half})
    assert written[0] == written[1]
    assert "training.yaml" in capsys.readouterr().out
    parts = select(_selection(), read(_files()))
    for half, text in written[0].items():
        assert "# Free." in text
        assert {key: names(entries) for key, entries in yaml.safe_load(text).items()} == parts[half]
        assert all(len(line) <= 120 for line in text.splitlines())


def test_the_built_in_files_follow_the_choice() -> None:
    selection = read_selection()
    for key, choice in selection.lists.items():
        kept = {name for half in Half for name in getattr(open_words(half), key)}
        later = [k for k in selection.lists if list(selection.lists).index(k) > list(selection.lists).index(key)]
        elsewhere = {name for half in Half for other in later for name in getattr(open_words(half), other)}
        single = {name for name in names(choice.also) if " " not in name and "-" not in name}
        assert single <= kept | elsewhere
        added = set(names(choice.also))
        assert not (kept - added) & set(names(choice.not_names))
        assert not {w for name in kept - added for w in name.split()} & set(names(choice.not_words))
    for half, text in ((Half.TRAINING, selection.colors.training), (Half.HELD_OUT, selection.colors.held_out)):
        assert open_words(half).colors == tuple(sorted(names(text)))
