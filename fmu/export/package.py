"""Package: what lies where inside an FMU, and the archive itself."""

from __future__ import annotations

import platform as machine
import sys
import zipfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from xml.etree import ElementTree as ET

from ...base import writing
from .model_description import text

FMI_2_FOLDERS = {"x86_64-linux": "linux64", "x86_64-windows": "win64", "x86_64-darwin": "darwin64"}
ENDINGS = {"linux": ".so", "windows": ".dll", "darwin": ".dylib"}
_EPOCH = (1980, 1, 1, 0, 0, 0)


def native() -> str:
    """Return the platform this runs on, in the words of FMI 3."""
    system = {"win32": "windows", "darwin": "darwin"}.get(sys.platform, "linux")
    processor = machine.machine().lower()
    return f"{ {'amd64': 'x86_64', 'arm64': 'aarch64'}.get(processor, processor) }-{system}"


def library_path(identifier: str, fmi_version: str, platform: str) -> str:
    """Return where a platform's library lies in the FMU."""
    name = native() if platform == "native" else platform
    folder = FMI_2_FOLDERS.get(name, name) if fmi_version == "2.0" else name
    return f"binaries/{folder}/{identifier}{ENDINGS[name.rpartition('-')[2]]}"


def build_description(identifier: str, sources: Sequence[str]) -> bytes:
    """Return sources/buildDescription.xml."""
    root = ET.Element("fmiBuildDescription", fmiVersion="3.0")
    build = ET.SubElement(root, "BuildConfiguration", modelIdentifier=identifier)
    files = ET.SubElement(build, "SourceFileSet", language="C99")
    for name in sources:
        ET.SubElement(files, "SourceFile", name=name)
    ET.SubElement(build, "Library", name="m", external="true", description="C mathematics, where it is apart")
    return text(root)


def write_archive(path: Path, files: Mapping[str, bytes]) -> None:
    """Write the FMU, whole or not at all; the same files give the same bytes.

    Raises:
        OutputError: if it cannot be written.
    """
    with writing(path) as part, zipfile.ZipFile(part, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            entry = zipfile.ZipInfo(name, _EPOCH)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, content)
