"""FMUs for other platforms, built by zig from this one."""

from __future__ import annotations

import importlib.util
import struct
import zipfile
from pathlib import Path

import inertance as ia
import pytest

pytestmark = pytest.mark.skipif(
    importlib.util.find_spec("ziglang") is None, reason="ziglang is not installed (extra cross)"
)
WHERE = {
    "x86_64-linux": (".so", b"\x7fELF"),
    "x86_64-windows": (".dll", b"MZ"),
    "aarch64-linux": (".so", b"\x7fELF"),
    "x86_64-darwin": (".dylib", b"\xcf\xfa\xed\xfe"),
    "aarch64-darwin": (".dylib", b"\xcf\xfa\xed\xfe"),
}
MACHINES = {
    "x86_64-linux": 62,  # EM_X86_64
    "x86_64-windows": 0x8664,  # IMAGE_FILE_MACHINE_AMD64
    "aarch64-linux": 183,  # EM_AARCH64
    "x86_64-darwin": 0x01000007,  # CPU_TYPE_X86_64
    "aarch64-darwin": 0x0100000C,  # CPU_TYPE_ARM64
}


def exported_names(library: bytes) -> set[str]:
    """Return the names that a 64-bit Windows library exports."""
    (header,) = struct.unpack_from("<I", library, 0x3C)
    sections, optional = struct.unpack_from("<H", library, header + 6)[0], header + 24
    (table,) = struct.unpack_from("<I", library, optional + 112)
    first = optional + struct.unpack_from("<H", library, header + 20)[0]

    def place(address: int) -> int:
        for k in range(sections):
            size, begin, _, raw = struct.unpack_from("<4I", library, first + 40 * k + 8)
            if begin <= address < begin + size:
                return int(raw + address - begin)
        raise ValueError(address)

    (count,) = struct.unpack_from("<I", library, place(table) + 24)
    (names,) = struct.unpack_from("<I", library, place(table) + 32)
    starts = [place(a) for a in struct.unpack_from(f"<{count}I", library, place(names))]
    return {library[start : library.index(b"\0", start)].decode() for start in starts}


def machine_of(library: bytes) -> int:
    """Return the number of the processor that a library is for, as its format tells."""
    if library.startswith(b"\x7fELF"):
        return int(struct.unpack_from("<H", library, 18)[0])
    if library.startswith(b"MZ"):
        return int(struct.unpack_from("<H", library, struct.unpack_from("<I", library, 0x3C)[0] + 4)[0])
    return int(struct.unpack_from("<I", library, 4)[0])


def test_every_platform_is_built(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CFLAGS", "-O1")  # with -O0 zig builds a sanitizer's runtime first, for each platform
    net = ia.Network("body", mass=ia.Mass(m=2.0), push=ia.Force())
    net.connect(net.mass.flange, net.push.flange)
    path = ia.export_fmu(net, tmp_path / "body.fmu", fmi_version="3.0", platforms=list(WHERE))
    with zipfile.ZipFile(path) as archive:
        libraries = {p: archive.read(f"binaries/{p}/body{ending}") for p, (ending, _) in WHERE.items()}
    assert all(libraries[platform].startswith(magic) for platform, (_, magic) in WHERE.items())
    assert {p: machine_of(text) for p, text in libraries.items()} == MACHINES
    names = exported_names(libraries["x86_64-windows"])
    assert {"fmi3DoStep", "fmi3InstantiateCoSimulation", "fmi3InstantiateModelExchange"} <= names
    assert all(name.startswith("fmi3") for name in names)
