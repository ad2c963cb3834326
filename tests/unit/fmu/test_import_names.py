"""Names in foreign files that lead elsewhere: no library is loaded that is not in the archive."""

from __future__ import annotations

import shutil
import subprocess
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Protocol
from xml.sax.saxutils import quoteattr

import fmpy
import pytest
from inertance import FMU, FMUError, Network, export_fmu
from inertance.fmu import SystemStructure, read_ssp

TWO = (
    '<?xml version="1.0"?>\n<fmiModelDescription fmiVersion="2.0" modelName="m" guid="g">{faces}'
    '<ModelVariables><ScalarVariable name="x" valueReference="0"><Real/></ScalarVariable></ModelVariables>'
    "<ModelStructure/></fmiModelDescription>"
)
THREE = (
    '<?xml version="1.0"?>\n<fmiModelDescription fmiVersion="3.0" modelName="m" instantiationToken="g">'
    "{faces}"
    '<ModelVariables><Float64 name="time" valueReference="0" causality="independent"/></ModelVariables>'
    "<ModelStructure/></fmiModelDescription>"
)
EVIL = [
    "../../x/evil", "../evil", "..", ".", "", " ", "/tmp/evil", "a/b", "a\\b", "..\\evil", "C:evil",
    "C:\\evil", "\\\\host\\share\\evil", ".hidden", "evil;id",
    "evil\u2215x", "e\tvil", "~/evil", "%2e%2e%2fevil",
    "file:///tmp/evil", "a..b", "-evil",
]  # fmt: skip


class Make(Protocol):
    def __call__(self, model: str, *defines: str) -> Path: ...


def fmu(path: Path, version: str, faces: str) -> Path:
    text = {"2.0": TWO, "3.0": THREE}[version].format(faces=faces)
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("modelDescription.xml", text)
        for folder in ("linux64", "x86_64-linux"):
            archive.writestr(f"binaries/{folder}/m.so", "x")
    return path


@pytest.mark.parametrize("name", EVIL)
@pytest.mark.parametrize("face", ["ModelExchange", "CoSimulation", "ScheduledExecution"])
def test_model_identifiers_that_are_no_file_names(tmp_path: Path, name: str, face: str) -> None:
    for version in ("2.0", "3.0") if face != "ScheduledExecution" else ("3.0",):
        good = "" if face == "CoSimulation" else '<CoSimulation modelIdentifier="m"/>'
        bad = f"<{face} modelIdentifier={quoteattr(name)}/>"
        faces = bad + good if face == "ModelExchange" else good + bad
        path = fmu(tmp_path / f"{version}.fmu", version, faces)
        for validate in (True, False):
            with pytest.raises(FMUError, match="modelIdentifier="):
                FMU(path, validate=validate)


@pytest.mark.parametrize("name", ["my-model", "2dof", "Größe", "a.b"])
def test_names_that_are_files_but_no_c_names_are_notes(tmp_path: Path, name: str) -> None:
    path = fmu(tmp_path / "odd.fmu", "2.0", f'<CoSimulation modelIdentifier="{name}"/>')
    assert FMU(path).notes[0] == f"modelIdentifier='{name}' is no C identifier"


@pytest.fixture
def evil(tmp_path: Path) -> Callable[[], bool]:
    """Build a library that leaves a mark when it is loaded; tell whether it was."""
    compiler = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
    if compiler is None or fmpy.platform != "linux64":
        pytest.skip("needs a C compiler (cc, gcc or clang) on 64-bit Linux")
    source, mark = tmp_path / "evil.c", tmp_path / "mark"
    source.write_text(
        '#include <stdio.h>\n__attribute__((constructor)) static void f(void) { fclose(fopen("'
        f'{mark}", "w")); }}'
    )
    subprocess.run([compiler, "-shared", "-fPIC", str(source), "-o", str(tmp_path / "evil.so")], check=True)
    return mark.exists


@pytest.mark.parametrize("isolated", [False, True])
def test_a_library_outside_is_not_loaded(tmp_path: Path, evil: Callable[[], bool], isolated: bool) -> None:
    for name in (f"{tmp_path}/evil", f"../../../{tmp_path.name}/evil"):
        path = fmu(tmp_path / "out.fmu", "2.0", f'<CoSimulation modelIdentifier="{name}"/>')
        with pytest.raises(FMUError, match="no plain name of a file"):
            FMU(path, isolated=isolated, validate=False).instantiate()
    assert not evil()


def test_a_description_that_changes_after_it_was_read(tmp_path: Path, evil: Callable[[], bool]) -> None:
    path = fmu(tmp_path / "out.fmu", "2.0", '<CoSimulation modelIdentifier="m"/>')
    read = FMU(path)
    fmu(path, "2.0", f'<CoSimulation modelIdentifier="{tmp_path}/evil"/>')
    with pytest.raises(FMUError, match="no plain name of a file"):
        read.instantiate()
    assert not evil()


def test_entities_do_not_read_files(tmp_path: Path) -> None:
    secret = tmp_path / "secret"
    secret.write_text("secret")
    path = fmu(tmp_path / "entity.fmu", "2.0", '<CoSimulation modelIdentifier="m"/>')
    text = TWO.format(faces='<CoSimulation modelIdentifier="m"/>').replace(
        "<fmi", f'<!DOCTYPE fmiModelDescription [<!ENTITY e SYSTEM "file://{secret}">]>\n<fmi', 1
    )
    for told in (
        text.replace("<Real/>", "<Real/>&e;"),
        text.replace("<ModelStructure/>", "&e;<ModelStructure/>"),
    ):
        with zipfile.ZipFile(path, "w") as archive:
            archive.writestr("modelDescription.xml", told)
        with pytest.raises(FMUError) as caught:
            FMU(path, validate=False)
        assert "secret" not in str(caught.value).replace(str(secret), "")


SOURCES = [
    "../evil.fmu",
    "/etc/passwd",
    "file:///etc/passwd",
    "..%2fevil.fmu",
    "C:\\evil.fmu",
    "resources/../../e",
]


@pytest.fixture(scope="module")
def good(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A system of one FMU with a parameter; the FMU, `a.fmu`, stands beside it."""
    folder = tmp_path_factory.mktemp("good")
    inner = FMU(export_fmu(small(), folder / "a.fmu"))
    system = SystemStructure("system", {"a": inner}, parameters={"a": {"mass.m": 2.0}})
    return system.write(folder / "good.ssp")


@pytest.mark.parametrize("source", SOURCES)
@pytest.mark.parametrize("what", ["component", "values"])
def test_sources_of_a_system_that_lead_out_of_it(good: Path, tmp_path: Path, source: str, what: str) -> None:
    with zipfile.ZipFile(good) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    text = files["SystemStructure.ssd"].decode()
    if what == "component":
        text = text.replace('source="resources/a.fmu"', f'source="{source}"')
    else:
        begin, end = text.index("<ssd:ParameterBinding>"), text.index("</ssd:ParameterBinding>")
        text = f'{text[:begin]}<ssd:ParameterBinding source="{source}">{text[end:]}'
    bad = tmp_path / "inside" / "bad.ssp"
    bad.parent.mkdir()
    shutil.copy(good.with_name("a.fmu"), tmp_path / "evil.fmu")
    with zipfile.ZipFile(bad, "w") as archive:
        for name, content in {**files, "SystemStructure.ssd": text.encode()}.items():
            archive.writestr(name, content)
    with pytest.raises(FMUError, match=r"bad\.ssp"):
        read_ssp(bad)


def small() -> Network:
    from inertance import Fixed, Mass, Spring

    net = Network("small", wall=Fixed(), spring=Spring(k=1.0), mass=Mass(m=1.0))
    net.connect(net.wall.flange, net.spring.flange_a)
    net.connect(net.spring.flange_b, net.mass.flange)
    return net
