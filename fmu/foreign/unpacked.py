"""Unpacked: the files of an FMU on disk, as long as instances need them."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory

from .archive import platform_folder, unpack
from .model_description import read_model_description


class Unpacked:
    """The files of an FMU in a temporary folder (in `parent`), for any number of instances."""

    def __init__(self, path: Path, parent: Path | None = None) -> None:
        self.path = path
        self.description, *_ = read_model_description(path, validate=False)
        self._folder = TemporaryDirectory(prefix="inertance-fmu-", dir=parent, ignore_cleanup_errors=True)
        self.folder, self.binaries = Path(self._folder.name), platform_folder(self.description.fmiVersion)
        try:
            unpack(path, self.folder, self.binaries)
        except BaseException:
            self.remove()
            raise

    def remove(self) -> None:
        """Remove the files."""
        self._folder.cleanup()
