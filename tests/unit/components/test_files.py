"""Files that are written: whole or not at all, with what they had, and refused by name."""

import os
import stat
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from inertance.base import OutputError, check_output, write_text, writing

FULL = """
import resource, sys
from pathlib import Path
from inertance.base import OutputError, write_text
resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))  # as a disk that is full after 1000 bytes
try:
    write_text(sys.argv[1], "new" * 1000)
except OutputError as error:
    print(error)
"""


def left(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


def test_a_full_disk_leaves_what_was_there_and_names_the_file(tmp_path: Path) -> None:
    path = tmp_path / "größe und maß.json"
    path.write_text("old")
    told = subprocess.run(
        [sys.executable, "-c", FULL, str(path)], capture_output=True, encoding="utf-8", check=True,
        env={**os.environ, "PYTHONUTF8": "1"},
    ).stdout  # fmt: skip
    assert f"'{path}' cannot be written: file too large" in told
    assert path.read_text() == "old"
    assert left(tmp_path) == [path.name]


def test_an_exception_on_the_way_leaves_nothing(tmp_path: Path) -> None:
    with pytest.raises(KeyboardInterrupt):
        write_half(tmp_path / "a.csv")
    assert left(tmp_path) == []


def write_half(path: Path) -> None:
    with writing(path) as part:
        part.write_text("half")
        raise KeyboardInterrupt


def test_permissions_and_links_stay(tmp_path: Path) -> None:
    path, link = tmp_path / "a.json", tmp_path / "link.json"
    path.write_text("old")
    path.chmod(0o640)
    link.symlink_to(path)
    write_text(link, "new")
    assert (path.read_text(), link.is_symlink()) == ("new", True)
    assert stat.S_IMODE(path.stat().st_mode) == 0o640
    before = os.umask(0o027)
    try:
        write_text(tmp_path / "b.json", "new")
    finally:
        os.umask(before)
    assert stat.S_IMODE((tmp_path / "b.json").stat().st_mode) == 0o640


def test_a_pipe_is_filled_and_stays_a_pipe(tmp_path: Path) -> None:
    path, read = tmp_path / "pipe", list[str]()
    os.mkfifo(path)
    reader = threading.Thread(target=lambda: read.append(path.read_text()))
    reader.start()
    write_text(path, "told")
    reader.join(10)
    assert read == ["told"]
    assert stat.S_ISFIFO(path.stat().st_mode)
    assert left(tmp_path) == ["pipe"]


def test_standard_output_can_be_named() -> None:
    code = "from inertance.base import write_text; write_text('/dev/stdout', 'told')"
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert told == "told"


@pytest.fixture
def shared() -> Iterator[Path]:
    """Return a folder that every user may look into, with a file."""
    with TemporaryDirectory() as name:
        folder = Path(name)
        folder.chmod(0o755)
        (folder / "a.json").write_text("old and long")
        yield folder
        folder.chmod(0o755)


def as_a_user(code: str, path: Path) -> str:
    """Run code that may not write everywhere."""
    start = "import os, sys\nfrom inertance.base import OutputError, check_output, write_text\n"
    start += "if os.getuid() == 0:\n    os.setgroups([]); os.setgid(65534); os.setuid(65534)\n"
    script = [sys.executable, "-c", start + code, str(path)]
    return subprocess.run(script, capture_output=True, text=True, check=True).stdout


def test_a_file_in_a_folder_that_takes_no_new_ones_is_filled(shared: Path) -> None:
    path = shared / "a.json"
    path.chmod(0o666)
    shared.chmod(0o555)
    as_a_user("check_output(sys.argv[1]); write_text(sys.argv[1], 'new')", path)
    assert path.read_text() == "new"
    assert left(shared) == ["a.json"]


def test_a_protected_file_or_folder_is_known_before(shared: Path) -> None:
    path = shared / "a.json"
    code = "try:\n    check_output(sys.argv[1])\nexcept OutputError as error:\n    print(error)"
    path.chmod(0o444)
    shared.chmod(0o777)
    assert f"'{path}' cannot be written: it is protected" in as_a_user(code, path)
    shared.chmod(0o555)
    assert "cannot be written: permission denied" in as_a_user(code, shared / "b.json")
    assert path.read_text() == "old and long"


def test_what_cannot_be_written_is_known_before(tmp_path: Path) -> None:
    (tmp_path / "folder.json").mkdir()
    for path, told in (
        (tmp_path / "a.pdf", "a.pdf' ends in '.pdf'; it must end in .html or .htm"),
        (tmp_path / "a", "a' has no ending; it must end in .html or .htm"),
        (tmp_path / "a.hmtl", "did you mean '.html'?"),
    ):
        with pytest.raises(OutputError, match=told.replace("?", r"\?")):
            check_output(path, [".html", ".htm"])
    for path, told in (
        (tmp_path / "folder.json", "it is a folder"),
        (tmp_path / "absent" / "a.json", "there is no folder"),
        (tmp_path / f"{'a' * 300}.json", "file name too long; choose a shorter name"),
        (Path("/proc/a.json"), "'/proc/a.json' cannot be written"),
    ):
        with pytest.raises(OutputError, match=told):
            check_output(path, [".json"])
        with pytest.raises(OutputError, match=told), writing(path):
            raise AssertionError("not reached")
    assert left(tmp_path) == ["folder.json"]


def test_a_name_as_long_as_may_be_is_written(tmp_path: Path) -> None:
    path = tmp_path / f"{'a' * 250}.json"
    check_output(path, [".json"])
    write_text(path, "told")
    assert left(tmp_path) == [path.name]


def test_two_writers_leave_the_file_of_one(tmp_path: Path) -> None:
    path = tmp_path / "a.txt"
    with writing(path) as one, writing(path) as other:
        assert one != other
        one.write_text("one" * 1000)
        other.write_text("other")
    assert path.read_text() == "one" * 1000
    assert left(tmp_path) == ["a.txt"]
