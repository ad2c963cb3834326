"""Archives that are broken, hostile or no FMUs: told clearly, nothing run, nothing left behind."""

from __future__ import annotations

import stat
import tempfile
import zipfile
from collections.abc import Mapping
from pathlib import Path

import pytest
from inertance import FMU, FMUError, InertanceError

VALID = (
    '<?xml version="1.0"?>\n<fmiModelDescription fmiVersion="{version}" modelName="empty" guid="g">'
    '<ModelExchange modelIdentifier="empty"/><ModelVariables>'
    '<ScalarVariable name="x" valueReference="0"><Real/></ScalarVariable></ModelVariables>'
    "<ModelStructure/></fmiModelDescription>"
)
BINARY = "binaries/linux64/empty.so"


def packed(path: Path, entries: Mapping[str, bytes | str], version: str = "2.0") -> Path:
    given = {"modelDescription.xml": VALID.format(version=version), **entries}
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in given.items():
            archive.writestr(name, content)
    return path


@pytest.fixture
def clean_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder for temporary files that must be empty again in the end."""
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    return folder


def test_a_missing_file(tmp_path: Path) -> None:
    with pytest.raises(FMUError, match=r"there is no file '.*nowhere\.fmu'"):
        FMU(tmp_path / "nowhere.fmu")


def test_errors_are_the_library_s() -> None:
    assert issubclass(FMUError, InertanceError)


@pytest.mark.parametrize("keep", [0, 100, -30])
def test_a_corrupt_archive(tmp_path: Path, keep: int) -> None:
    whole = packed(tmp_path / "whole.fmu", {}).read_bytes()
    (tmp_path / "half.fmu").write_bytes(whole[:keep])
    with pytest.raises(FMUError, match="no sound zip archive"):
        FMU(tmp_path / "half.fmu")


def test_a_damaged_entry(tmp_path: Path) -> None:
    path = packed(tmp_path / "damaged.fmu", {})
    content = bytearray(path.read_bytes())
    content[60:80] = bytes(20)
    path.write_bytes(content)
    with pytest.raises(FMUError, match="no sound zip archive"):
        FMU(path)


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("../outside", "leads out of the archive"),
        ("resources/../../outside", "leads out of the archive"),
        ("/etc/outside", "is an absolute path"),
        ("C:/outside", "has a character"),
        ("resources\\outside", "has a character"),
    ],
)
def test_paths_that_escape(tmp_path: Path, name: str, told: str) -> None:
    with pytest.raises(FMUError, match=rf"{told}.*nothing was unpacked"):
        FMU(packed(tmp_path / "bad.fmu", {name: "x"}))


def test_links(tmp_path: Path) -> None:
    path = packed(tmp_path / "link.fmu", {})
    with zipfile.ZipFile(path, "a") as archive:
        link = zipfile.ZipInfo("resources/link")
        link.external_attr = (stat.S_IFLNK | 0o777) << 16
        archive.writestr(link, "/etc/passwd")
    with pytest.raises(FMUError, match="'resources/link' is a link"):
        FMU(path)


def test_an_entry_twice(tmp_path: Path) -> None:
    path = packed(tmp_path / "twice.fmu", {})
    with zipfile.ZipFile(path, "a") as archive, pytest.warns(UserWarning, match="Duplicate name"):
        archive.writestr("modelDescription.xml", "other")
    with pytest.raises(FMUError, match="comes twice, with other contents"):
        FMU(path)


def test_an_entry_twice_that_nothing_reads_or_that_is_the_same_is_a_note(tmp_path: Path) -> None:
    path = packed(tmp_path / "twice.fmu", {BINARY: "x", "extra/a.txt": "1"})
    for name, content in (("extra/a.txt", "2"), (BINARY, "x")):
        with zipfile.ZipFile(path, "a") as archive, pytest.warns(UserWarning, match="Duplicate name"):
            archive.writestr(name, content)
    fmu = FMU(path)
    assert {n for n in fmu.notes if "comes" in n} == {
        "the entry 'extra/a.txt' comes 2 times", f"the entry '{BINARY}' comes 2 times"
    }  # fmt: skip
    with pytest.raises(FMUError, match="does not load"):
        fmu.instantiate()


def test_two_libraries_of_one_name_are_refused(tmp_path: Path, clean_folder: Path) -> None:
    path = packed(tmp_path / "twice.fmu", {BINARY: "x"})
    with zipfile.ZipFile(path, "a") as archive, pytest.warns(UserWarning, match="Duplicate name"):
        archive.writestr(BINARY, "y")
    with pytest.raises(FMUError, match="comes twice, with other contents"):
        FMU(path).instantiate()
    assert list(clean_folder.iterdir()) == []


def test_a_folder_twice_is_harmless(tmp_path: Path) -> None:
    path = packed(tmp_path / "folders.fmu", {})
    with zipfile.ZipFile(path, "a") as archive:
        archive.mkdir("extra/")
        with pytest.warns(UserWarning, match="Duplicate name"):
            archive.mkdir("extra/")
    FMU(path)


def test_a_folder_instead_of_a_file(tmp_path: Path) -> None:
    (tmp_path / "folder.fmu").mkdir()
    with pytest.raises(FMUError, match="is a folder"):
        FMU(tmp_path / "folder.fmu")


@pytest.mark.parametrize("lie", [False, True], ids=["told", "denied by the header"])
def test_a_zip_bomb(tmp_path: Path, clean_folder: Path, lie: bool) -> None:
    path = packed(tmp_path / "bomb.fmu", {BINARY: b"x", "resources/zeros": bytes(80 << 20)})
    if lie:
        size = (80 << 20).to_bytes(4, "little")
        path.write_bytes(path.read_bytes().replace(size, (1000).to_bytes(4, "little")))
    fmu = FMU(path)
    with pytest.raises(FMUError, match=r"zip bomb|no sound zip archive"):
        fmu.instantiate()
    assert list(clean_folder.iterdir()) == []


def test_no_description(tmp_path: Path) -> None:
    with zipfile.ZipFile(tmp_path / "none.fmu", "w") as archive:
        archive.writestr("other.xml", "<a/>")
    with pytest.raises(FMUError, match=r"has no modelDescription\.xml"):
        FMU(tmp_path / "none.fmu")


@pytest.mark.parametrize(
    ("xml", "told"),
    [
        ("<fmiModelDescription", "is no XML: .*line 1"),
        ("<other/>", "describes no FMU"),
        (VALID.format(version="2.0").replace("<Real/>", "\n<Reel/>"), r"is invalid.*\n.*line 3.*Reel"),
        (VALID.format(version="2.0").replace("modelName", "modelNane"), r"(?s)is invalid.*modelNane"),
        (
            VALID.format(version="2.0").replace("<Real/>", '<Real declaredType="none"/>'),
            "declaredType=.none. which has not been defined",
        ),
    ],
)
def test_invalid_descriptions(tmp_path: Path, xml: str, told: str) -> None:
    with pytest.raises(FMUError, match=told):
        FMU(packed(tmp_path / "bad.fmu", {"modelDescription.xml": xml}))


def test_what_only_the_schema_refuses_can_be_tried(tmp_path: Path) -> None:
    xml = VALID.format(version="2.0").replace("<ModelStructure/>", "<ModelStructure/><More/>")
    path = packed(tmp_path / "loose.fmu", {"modelDescription.xml": xml})
    with pytest.raises(FMUError, match="validate=False"):
        FMU(path)
    assert "'More'" in FMU(path, validate=False).notes[0]


@pytest.mark.parametrize("version", ["1.0", "4.0", "2.1"])
def test_other_versions(tmp_path: Path, version: str) -> None:
    with pytest.raises(FMUError, match=f"is FMI {version}; only FMI 2.0 and 3.0"):
        FMU(packed(tmp_path / "old.fmu", {}, version))


def test_no_binary_for_this_machine(tmp_path: Path) -> None:
    fmu = FMU(packed(tmp_path / "other.fmu", {"binaries/amiga/empty.so": "x", "binaries/linux64/": ""}))
    with pytest.raises(FMUError, match=r"no binary for this machine \(.*\), only for amiga"):
        fmu.simulate(1.0)


def test_a_library_that_does_not_load(tmp_path: Path, clean_folder: Path) -> None:
    library = "binaries/{}/empty{}"
    places = {library.format(p, e): "no library" for p, e in (("linux64", ".so"), ("win64", ".dll"))}
    places |= {"binaries/darwin64/empty.dylib": "no library"}
    with pytest.raises(FMUError, match=r"does not load|no binary for this machine"):
        FMU(packed(tmp_path / "text.fmu", places)).simulate(1.0)
    assert list(clean_folder.iterdir()) == []
