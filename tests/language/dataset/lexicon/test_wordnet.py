"""Reading WordNet: a sample in the format of its files, written by hand."""

from __future__ import annotations

import io
import tarfile
from pathlib import Path

import pytest

from models.language import VocabularyError
from models.language.dataset.lexicon.wordnet import WordNet, read, read_package

NOTICE = "  1 Permission to use this sample is granted.  \n  2   \n  3 It comes as it is.  \n"
FILES = {
    "data.noun": NOTICE
    + "00000100 03 n 01 thing 0 002 ~ 00000200 n 0000 ~ 00000500 n 0000 | what there is  \n"
    + "00000200 06 n 02 tool 0 implement 0 003 @ 00000100 n 0000 ~ 00000300 n 0000 ~ 00000400 n 0000 | a thing to use\n"
    + "00000300 06 n 01 claw_hammer 0 002 @ 00000200 n 0000 + 01234567 v 0101 | a hammer with a claw; for nails  \n"
    + "00000400 06 n 01 run 0 001 @ 00000200 n 0000 | a tool that is seldom meant by its name  \n"
    + "00000500 18 n 01 tool 1 002 @ 00000100 n 0000 ~i 00000600 n 0000 | somebody whom others use  \n"
    + "00000600 18 n 01 Jack 0 001 @i 00000500 n 0000 | one of them  \n",
    "index.noun": NOTICE
    + "thing n 1 1 ~ 1 1 00000100  \n"
    + "tool n 2 2 @ ~ 2 1 00000200 00000500  \n"
    + "implement n 1 2 @ ~ 1 0 00000200  \n"
    + "claw_hammer n 1 1 @ 1 0 00000300  \n"
    + "run n 1 1 @ 1 1 00000400  \n"
    + "jack n 1 1 @i 1 0 00000600  \n",
    "index.sense": "run%1:06:00:: 00000400 1 3\n"
    + "run%2:38:00:: 01234567 1 106\n"
    + "tool%1:06:00:: 00000200 1 8\n"
    + "tool%2:30:00:: 01234569 1 2\n"
    + "thing%1:03:00:: 00000100 1 0\n",
    "data.verb": NOTICE
    + "01234567 38 v 01 run 0 001 + 00000300 n 0101 01 + 02 00 | go fast, as a dog that claws does  \n",
}


@pytest.fixture(scope="module")
def wordnet() -> WordNet:
    return read(FILES)


def test_kinds(wordnet: WordNet) -> None:
    assert wordnet.kinds["00000200"].names == ("tool", "implement")
    assert wordnet.kinds["00000200"].kinds == ("00000300", "00000400")
    assert wordnet.kinds["00000500"].kinds == ("00000600",)
    assert wordnet.within(["thing.1"]) == {f"00000{n}00" for n in range(1, 7)}
    assert wordnet.within(["tool.1", "run.1"], ["claw_hammer.1"]) == {"00000200", "00000400"}
    assert wordnet.within(["thing.1"], ["tool.2"]) == {f"00000{n}00" for n in range(1, 5)}


def test_senses(wordnet: WordNet) -> None:
    assert (wordnet.offset("tool.1"), wordnet.offset("tool.2")) == ("00000200", "00000500")
    for sense in ("tool.3", "tool.0", "tool", "tool.x", "spanner.1"):
        with pytest.raises(VocabularyError, match=sense):
            wordnet.offset(sense)


def test_usual(wordnet: WordNet) -> None:
    assert wordnet.is_usual("tool", "00000200")
    assert not wordnet.is_usual("tool", "00000500")  # not the first sense
    assert not wordnet.is_usual("run", "00000400")  # mostly a verb
    assert wordnet.is_usual("claw_hammer", "00000300")  # never counted


def test_familiarity(wordnet: WordNet) -> None:
    assert wordnet.glosses["claw"] == wordnet.glosses["claws"] == wordnet.glosses["tool"] == 1
    assert wordnet.glosses["a"] == 5
    assert wordnet.familiarity("nail") == 1  # "nails"
    assert wordnet.familiarity("hammer_nail-a") == 1
    assert wordnet.familiarity("spanner") == 0


def test_notice(wordnet: WordNet) -> None:
    assert wordnet.notice == "Permission to use this sample is granted.\n\nIt comes as it is."


def test_a_file_is_missing() -> None:
    with pytest.raises(VocabularyError, match=r"index\.sense"):
        read({name: text for name, text in FILES.items() if name != "index.sense"})


def package(folder: Path) -> Path:
    """The sample as a package."""
    path = folder / "sample.tgz"
    with tarfile.open(path, "w:gz") as archive:
        for name, text in {**FILES, "README.md": "not one of them"}.items():
            data = text.encode("latin-1")
            member = tarfile.TarInfo(f"package/dict/{name}" if name != "README.md" else f"package/{name}")
            member.size = len(data)
            archive.addfile(member, io.BytesIO(data))
    return path


def test_package(tmp_path: Path, wordnet: WordNet) -> None:
    assert read_package(package(tmp_path)) == wordnet


def test_no_package(tmp_path: Path) -> None:
    (tmp_path / "text.tgz").write_text("not a package")
    for name in ("text.tgz", "missing.tgz"):
        with pytest.raises(VocabularyError, match="no package of WordNet"):
            read_package(tmp_path / name)
