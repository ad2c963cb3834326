"""The documentation as a site, with the reference, pictures and search, read without a network."""

from __future__ import annotations

import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

from ..base import MissingPackageError, OutputError

ROOT = Path(__file__).parents[1]
NEEDED = ("material", "mkdocs", "mkdocstrings_handlers")
MARK = "search/search_index.js"


def site(folder: Path) -> Path:
    """Return the folder of the site, built there unless it is.

    Raises:
        MissingPackageError: without what builds it.
        OutputError: for a folder that holds something else, or cannot be written.
    """
    if (folder / MARK).exists():
        return folder
    if not all(map(find_spec, NEEDED)):
        raise MissingPackageError(
            "the site is built by MkDocs; run `pip install 'inertance[docs]'`, or read pages by "
            "`inertance docs PAGE`"
        )
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise OutputError(f"'{folder}' holds something else; name a folder for the site alone")
    command = [
        "-m",
        "mkdocs",
        "build",
        "--quiet",
        "--config-file",
        ROOT / "mkdocs.yml",
        "--site-dir",
        folder.resolve(),
    ]
    done = subprocess.run([sys.executable, *map(str, command)], capture_output=True, text=True, check=False)
    if done.returncode or not (folder / MARK).exists():
        raise OutputError(
            f"the site could not be built in '{folder}': {done.stderr.strip() or done.stdout.strip()}"
        )
    return folder
