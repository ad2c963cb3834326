"""What is kept for other processes: in a private folder, whole, and not too much."""

import os
import tempfile
from pathlib import Path

import pytest
from inertance.base import kept_files
from inertance.base.kept_files import KeptFiles
from inertance.base.kept_files import kept_files as kept


@pytest.fixture(autouse=True)
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.delenv("LOCALAPPDATA", raising=False)
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    return tmp_path / "cache" / "inertance"


def made(folder: Path, content: bytes = b"library") -> Path:
    path = folder / "made.so"
    path.write_bytes(content)
    return path


def test_what_is_kept_is_found_by_its_name_alone(cache: Path, tmp_path: Path) -> None:
    assert kept().find("a") is None
    path = kept().keep(made(tmp_path), "a")
    assert path == kept().find("a")
    assert path is not None
    assert path.parent == cache
    assert path.read_bytes() == b"library"
    assert kept().find("b") is None
    assert (kept().holds("a"), kept().holds("b")) == (True, False)


@pytest.mark.parametrize("content", [b"", b"librar", b"Library", b"library of somebody else"])
def test_what_is_not_whole_is_removed(tmp_path: Path, content: bytes) -> None:
    path = kept().keep(made(tmp_path), "a")
    assert path is not None
    path.write_bytes(content)
    assert kept().find("a") is None
    assert not path.exists()


def test_what_was_not_used_for_longest_goes_first(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(kept_files, "MOST_BYTES", 20)
    for age, name in enumerate("abc"):
        path = kept().keep(made(tmp_path, 6 * name.encode()), name)
        assert path is not None
        os.utime(path, (path.stat().st_atime, path.stat().st_mtime - 100 * (3 - age)))
    kept().find("a")  # used again
    kept().keep(made(tmp_path, b"dddddd"), "d")
    assert [name for name in "abcd" if kept().holds(name)] == ["a", "c", "d"]


def test_all_can_be_removed(cache: Path, tmp_path: Path) -> None:
    for name in "ab":
        kept().keep(made(tmp_path), name)
    (cache / "notes.txt").touch()
    assert kept().clear() == 2
    assert [path.name for path in cache.iterdir()] == ["notes.txt"]


def test_a_cache_that_cannot_be_is_replaced_by_a_temporary_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    path = kept().keep(made(tmp_path), "a")
    assert path is not None
    assert path.parent.parent == tmp_path
    assert not path.parent.stat().st_mode & 0o077
    assert kept().find("a") == path


@pytest.mark.skipif(os.name != "posix", reason="permissions of POSIX")
@pytest.mark.parametrize("mode", [0o770, 0o707])
def test_a_folder_that_others_can_write_to_is_not_used(cache: Path, tmp_path: Path, mode: int) -> None:
    kept().keep(made(tmp_path), "a")
    cache.chmod(mode)
    assert kept().path == tmp_path / f"inertance-{os.getuid()}"
    assert kept().find("a") is None


@pytest.mark.skipif(os.name != "posix", reason="links of POSIX")
def test_a_link_that_somebody_has_laid_is_not_followed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    (tmp_path / "theirs").mkdir(mode=0o700)
    (tmp_path / f"inertance-{os.getuid()}").symlink_to(tmp_path / "theirs")
    assert kept() == KeptFiles(None)
    assert kept().keep(made(tmp_path), "a") is kept().find("a") is None
    assert (kept().files(), kept().clear()) == ([], 0)


def test_a_full_disk_keeps_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object) -> None:
        raise OSError("no space left on device")

    monkeypatch.setattr("shutil.copy", full)
    assert kept().keep(made(tmp_path), "a") is None
    assert not kept().holds("")
