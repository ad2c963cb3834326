"""Exported FMUs: valid, self-contained, and in agreement with the native run."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import fmpy
import inertance as ia
import numpy as np
import pytest
from fmpy.validation import validate_fmu
from lxml import etree  # type: ignore[import-untyped]

needs_compiler = pytest.mark.skipif(
    not any(shutil.which(name) for name in ("cc", "gcc", "clang")), reason="there is no C compiler"
)
KINDS = ("ModelExchange", "CoSimulation")
VERSIONS = ("2.0", "3.0")
SCHEMA = Path(fmpy.__file__).parent / "schema" / "fmi3"


def told_by(path: Path) -> Any:
    return fmpy.read_model_description(str(path))


def ball() -> ia.Network:
    """A driven ball above a stop: events, an input, a sensor."""
    net = ia.Network(
        "driven ball",
        floor=ia.Fixed(),
        stop=ia.HardStop(e=0.7),
        ball=ia.Mass(m=0.5, s=1.0),
        weight=ia.ConstantForce(f_constant=-4.905),
        push=ia.Force(),
        sensor=ia.PositionSensor(),
    )
    net.connect(net.floor.flange, net.stop.flange_a)
    net.connect(net.stop.flange_b, net.ball.flange, net.weight.flange, net.push.flange, net.sensor.flange)
    return net


@needs_compiler
@pytest.mark.parametrize(
    ("case", "version"), [("stick_slip", "2.0"), ("loop", "3.0"), ("ball", "2.0"), ("ball", "3.0")]
)
def test_every_kind_agrees_with_the_native_run(
    case: str, version: str, machines: Any, tmp_path: Path
) -> None:
    known = machines.CASES.get(case) or machines.Case(ball, 2.0, ["ball.s", "stop.mode"])
    dae, start, outputs, stop = known.build().dae(), known.start, known.outputs, known.stop
    path = ia.export_fmu(dae, tmp_path / "it.fmu", fmi_version=version, outputs=outputs, start=start)
    assert validate_fmu(str(path)) == []
    inputs = {name: 0.0 for name in dae.input_names if case == "ball"}
    native = ia.simulate(dae, stop, step=0.01, start=start, inputs=inputs, rtol=1e-8, atol=1e-10)
    for kind in KINDS:
        run = fmpy.simulate_fmu(
            str(path), fmi_type=kind, stop_time=stop, output_interval=0.01, relative_tolerance=1e-8
        )
        events = np.array([event.time for event in native.events])
        grid = np.arange(1, round(stop / 0.01)) * 0.01
        grid = grid[(np.abs(grid[:, None] - events) > 1e-4).all(axis=1)]
        for name in outputs:
            wanted = np.interp(grid, native.time, native[name])
            found = np.interp(grid, run["time"], run[name])
            assert found == pytest.approx(wanted, abs=1e-4 * max(1e-6, np.ptp(wanted))), (kind, name)


@pytest.fixture(scope="module", params=VERSIONS)
def sources_only(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("export") / "ball.fmu"
    return ia.export_fmu(ball(), path, fmi_version=request.param, platforms=[])


def test_variables_carry_units_starts_and_limits(sources_only: Path) -> None:
    model = told_by(sources_only)
    by_name = {v.name: v for v in model.modelVariables}
    assert [v.name for v in model.modelVariables if v.causality == "output"] == ["sensor.s"]
    assert [v.name for v in model.modelVariables if v.causality == "input"] == ["push.f"]
    mass = by_name["ball.m"]
    assert (mass.causality, mass.variability, mass.unit) == ("parameter", "tunable", "kg")
    assert (float(mass.start), float(mass.min)) == (0.5, 0.0)
    assert float(by_name["stop.e"].max) == 1.0
    assert (by_name["ball.s"].initial, float(by_name["ball.s"].start)) == ("exact", 1.0)
    assert (by_name["stop.s_rel"].initial, by_name["stop.s_rel"].start) == ("calculated", None)
    with zipfile.ZipFile(sources_only) as archive:
        text = archive.read("modelDescription.xml").decode()
    assert text.count('reinit="true"') == 2  # a shock changes velocities, contact sets them
    assert by_name["stop.mode"].declaredType.items[1].name == "contact"
    units = {u.name: u for u in model.unitDefinitions}
    assert (units["N"].baseUnit.kg, units["N"].baseUnit.m, units["N"].baseUnit.s) == (1, 1, -2)
    shown = {d.name: float(d.factor) for d in units["m"].displayUnits}
    assert shown["mm"] == 1000.0
    assert [v.valueReference for v in model.modelVariables] == list(range(len(model.modelVariables)))


def test_structure_tells_what_depends_on_what(sources_only: Path) -> None:
    model = told_by(sources_only)
    told = {
        u.variable.name: dict(zip([d.name for d in u.dependencies], u.dependenciesKind, strict=True))
        for u in model.derivatives
    }
    position, speed = (u.variable.derivative.name for u in model.derivatives)
    assert told[f"der({position})"] == {speed: "constant"}
    assert told[f"der({speed})"].keys() == {"push.f"}  # a free fall knows neither height nor speed
    assert told[f"der({speed})"]["push.f"] in ("discrete", "tunable")
    starting = {u.variable.name: {d.name for d in u.dependencies} for u in model.initialUnknowns}
    assert {"push.f", "ball.m", "weight.f_constant"} <= starting[f"der({speed})"]


@pytest.mark.parametrize("version", VERSIONS)
def test_the_rate_of_a_state_may_be_an_output(version: str, tmp_path: Path) -> None:
    net = ia.Network("free", mass=ia.Mass(m=1.0), push=ia.Force())
    net.connect(net.mass.flange, net.push.flange)
    names = ["der(mass.v)", "mass.s"]
    path = ia.export_fmu(net, tmp_path / "free.fmu", fmi_version=version, outputs=names, platforms=[])
    assert not validate_fmu(str(path))
    described = [v.name for v in told_by(path).modelVariables]
    assert len(set(described)) == len(described)
    assert {v.name for v in told_by(path).modelVariables if v.causality == "output"} == set(names)


def test_the_same_network_gives_the_same_bytes(tmp_path: Path) -> None:
    first, second = (
        ia.export_fmu(ball(), tmp_path / name, platforms=[]).read_bytes() for name in ("a.fmu", "b.fmu")
    )
    assert first == second


def test_documentation_and_licences_are_inside(sources_only: Path) -> None:
    with zipfile.ZipFile(sources_only) as archive:
        page = archive.read("documentation/index.html").decode()
        licences = archive.read("documentation/licenses/license.txt").decode()
        headers = [name for name in archive.namelist() if re.match(r"sources/fmi\d[A-Z]\w*\.h", name)]
    for name in ("push.f", "ball.m"):
        assert f"<td>{name}</td>" in page
    for words in ("BSD", "MIT No Attribution", "LGPL", "Redistribution and use"):
        assert words in licences
    assert len(headers) == 3


@needs_compiler
@pytest.mark.skipif(sys.platform != "linux", reason="nm and ldd are asked, on Linux")
def test_sources_compile_by_themselves_and_show_only_fmi(sources_only: Path, tmp_path: Path) -> None:
    folder = fmpy.extract(str(sources_only), unzipdir=str(tmp_path))
    library = tmp_path / "model.so"
    strict = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-O1", "-fPIC", "-fvisibility=hidden", "-shared"]
    files = sorted(str(path) for path in Path(folder, "sources").glob("*.c"))
    done = subprocess.run(["cc", *strict, *files, "-o", str(library), "-lm"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    symbols = subprocess.run(["nm", "-D", "--defined-only", str(library)], capture_output=True, text=True)
    shown = {line.split()[-1] for line in symbols.stdout.splitlines()}
    version = told_by(sources_only).fmiVersion[0]
    header = Path(folder, "sources", f"fmi{version}Functions.h").read_text()
    declared = set(re.findall(rf"^ *FMI{version}_Export fmi\w+TYPE\s+(fmi\w+);", header, re.MULTILINE))
    assert declared == shown
    needed = subprocess.run(["ldd", str(library)], capture_output=True, text=True).stdout
    assert not [n for n in re.findall(r"(lib\w+)[-.\w]*\.so", needed) if n not in ("libc", "libm")]


def test_fmi3_has_a_valid_build_description_and_terminals(tmp_path: Path) -> None:
    net = ia.Network("body", mass=ia.Mass(m=2.0), disc=ia.rotational.Inertia(J=1.0))
    path = ia.export_fmu(
        net, tmp_path / "body.fmu", fmi_version="3.0", platforms=[],
        terminals={"mass.flange": "force-in", "disc.flange": "motion-in"},
    )  # fmt: skip
    with zipfile.ZipFile(path) as archive:
        build = archive.read("sources/buildDescription.xml")
        terminals = archive.read("terminalsAndIcons/terminalsAndIcons.xml")
    for text, schema in ((build, "fmi3BuildDescription"), (terminals, "fmi3TerminalsAndIcons")):
        etree.XMLSchema(etree.parse(SCHEMA / f"{schema}.xsd")).assertValid(etree.fromstring(text))
    members = {
        terminal.attrib["name"]: {m.attrib["memberName"]: m.attrib["variableName"] for m in terminal}
        for terminal in ET.fromstring(terminals).iter("Terminal")
    }
    assert members["mass.flange"].keys() == {"f", "s", "v", "a"}
    assert members["disc.flange"].keys() == {"tau", "phi", "w", "a"}  # a rigid body needs its acceleration
    model = told_by(path)
    causality = {v.name: v.causality for v in model.modelVariables}
    assert causality[members["mass.flange"]["f"]] == "input"
    assert causality[members["mass.flange"]["a"]] == "output"
    assert causality[members["disc.flange"]["a"]] == "input"
    assert causality[members["disc.flange"]["tau"]] == "output"


def test_a_published_flange_moves_as_the_network_would() -> None:
    net = ia.Network("body", mass=ia.Mass(m=2.0))
    pushed, _ = ia.fmu.publish(net, {"mass.flange": "force-in"})
    run = pushed.simulate(1.0, inputs={"mass_flange.force.f": 3.0})
    assert run["mass_flange.acceleration.a"] == pytest.approx(1.5)
    moved, _ = ia.fmu.publish(net, {"mass.flange": "motion-in"})
    run = moved.simulate(1.0, inputs={"mass_flange.motion.s_ref": lambda t: 0.5 * t**2})
    assert run["mass_flange.sensor.f"] == pytest.approx(-2.0)  # the mass holds back whoever moves it
    assert "mass_flange" not in repr(net)  # the network itself stays as it is


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ({"fmi_version": "1.0"}, "fmi_version must be one of 2.0, 3.0"),
        ({"outputs": ["ball.z"]}, "no variable 'ball.z'; did you mean 'ball"),
        ({"outputs": ["ball.m"]}, "'ball.m' is no variable that moves"),
        ({"inputs": ["push.ff"]}, "there is no input 'push.ff'; did you mean 'push.f'"),
        ({"platforms": ["x86_64-linus"]}, "did you mean 'x86_64-linux'"),
        ({"platforms": [], "sources": False}, "needs sources or a platform"),
        ({"step": 0.0}, "step must be above 0 s"),
        ({"tolerance": 2.0}, "tolerance must lie between 0 and 1"),
        ({"terminals": {"ball.flang": "force-in"}}, "no flange 'ball.flang'; did you mean 'flange'"),
        ({"terminals": {"bal.flange": "force-in"}}, "no component 'bal'; did you mean 'ball'"),
        ({"terminals": {"ball.flange": "force"}}, "must be one of force-in, motion-in"),
    ],
)
def test_wrong_options_are_told(options: dict[str, Any], told: str, tmp_path: Path) -> None:
    with pytest.raises(ia.ModelError, match=re.escape(told)):
        ia.export_fmu(ball(), tmp_path / "ball.fmu", **{"platforms": [], **options})
    assert not list(tmp_path.iterdir())


def test_wrong_paths_are_told(tmp_path: Path) -> None:
    with pytest.raises(ia.ModelError, match=r"ends in '\.fmu'"):
        ia.export_fmu(ball(), tmp_path / "ball.zip", platforms=[])
    with pytest.raises(ia.ModelError, match="there is no folder"):
        ia.export_fmu(ball(), tmp_path / "absent" / "ball.fmu", platforms=[])
    taken = tmp_path / "taken.fmu"
    taken.mkdir()
    with pytest.raises(ia.ModelError, match="cannot be written"):
        ia.export_fmu(ball(), taken, platforms=[])
    assert list(tmp_path.iterdir()) == [taken]


def test_without_a_compiler_the_remedy_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")
    monkeypatch.delenv("CC", raising=False)
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with pytest.raises(ia.ModelError, match="install a C compiler"):
        ia.export_fmu(ball(), tmp_path / "ball.fmu")


@pytest.mark.parametrize("version", VERSIONS)
def test_the_licence_is_the_authors(version: str, tmp_path: Path) -> None:
    """Every FMU said that it is under BSD-3-Clause, whosever model it was."""
    silent = ia.export_fmu(ball(), tmp_path / "silent.fmu", fmi_version=version, platforms=[])
    told = told_by(silent)
    assert (told.author, told.version, told.copyright, told.license) == (None, None, None, None)
    path = ia.export_fmu(
        ball(), tmp_path / "told.fmu", fmi_version=version, platforms=[], author="A. <Müller>", version="1.2",
        copyright="© 2026 A. Müller", license="proprietary",
    )  # fmt: skip
    told = told_by(path)
    assert (told.author, told.version) == ("A. <Müller>", "1.2")
    assert (told.copyright, told.license) == ("© 2026 A. Müller", "proprietary")
    with zipfile.ZipFile(path) as archive:
        licences = archive.read("documentation/licenses/license.txt").decode()
        page = archive.read("documentation/index.html").decode()
    assert "author's, who licenses it under: proprietary." in licences
    assert "Redistribution and use" in licences  # of the program around the model
    assert "A. &lt;Müller&gt;" in page
    with pytest.raises(ia.ModelError, match="license must be a text"):
        ia.export_fmu(ball(), tmp_path / "wrong.fmu", platforms=[], license=3)  # type: ignore[arg-type]


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("name", ["größe", "große masse", "it's", "1st", "質量", 'a"b'])
def test_names_keep_to_the_convention_that_is_told(name: str, version: str, tmp_path: Path) -> None:
    """Names that are not structured as the standard says were told to be so."""
    net = ia.Network(f"netz {name}", **{name: ia.Mass(m=1.0, v=2.0)})
    path = ia.export_fmu(net, tmp_path / "it.fmu", fmi_version=version, outputs=[f"{name}.s"], platforms=[])
    assert validate_fmu(str(path)) == []
    told = told_by(path)
    assert told.variableNamingConvention == "flat"
    assert f"{name}.m" in {v.name for v in told.modelVariables}
    assert told.coSimulation.modelIdentifier.isascii()
    plain = ia.export_fmu(ball(), tmp_path / "ball.fmu", fmi_version=version, platforms=[])
    assert told_by(plain).variableNamingConvention == "structured"


@needs_compiler
def test_a_name_of_any_letters_runs(tmp_path: Path) -> None:
    net = ia.Network("größe", größe=ia.Mass(m=1.0, v=2.0))
    for version in VERSIONS:
        path = ia.export_fmu(net, tmp_path / "it.fmu", fmi_version=version, outputs=["größe.s"])
        assert ia.FMU(path).simulate(1.0, parameters={"größe.m": 3.0})["größe.s"][-1] == pytest.approx(2.0)


def test_a_network_without_a_name_is_told(tmp_path: Path) -> None:
    for name in ("", " ", 5):
        with pytest.raises(ia.ModelError, match="the name of a Network must"):
            ia.Network(name, mass=ia.Mass(m=1.0))  # type: ignore[arg-type]
    net = ball()
    net.name = ""
    with pytest.raises(ia.ModelError, match="name is empty"):
        ia.export_fmu(net, tmp_path / "it.fmu", platforms=[])
