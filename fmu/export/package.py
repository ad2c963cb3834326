"""Package: what lies where inside an FMU, and the archive itself."""

from __future__ import annotations

import zipfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from xml.etree import ElementTree as ET

from ...base import writing
from ..foreign.archive import library_name, platform_folder
from .model_description import text

FMI_2_FOLDERS = {"x86_64-linux": "linux64", "x86_64-windows": "win64", "x86_64-darwin": "darwin64"}
ENDINGS = {"linux": ".so", "windows": ".dll", "darwin": ".dylib"}
_EPOCH = (1980, 1, 1, 0, 0, 0)


def library_path(identifier: str, fmi_version: str, platform: str) -> str:
    """Return where a platform's library lies in the FMU."""
    if platform == "native":
        return f"binaries/{platform_folder(fmi_version)}/{library_name(identifier)}"
    folder = FMI_2_FOLDERS.get(platform, platform) if fmi_version == "2.0" else platform
    return f"binaries/{folder}/{identifier}{ENDINGS[platform.rpartition('-')[2]]}"


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
