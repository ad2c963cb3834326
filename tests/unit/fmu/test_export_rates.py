"""What Co-Simulation tells of its course: rates of outputs, and variables at each step of the integrator."""

from __future__ import annotations

import shutil
import zipfile
from collections.abc import Iterator
from io import BytesIO
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import casadi as ca
import fmpy
import inertance as ia
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave
from fmpy.validation import validate_fmu
from matplotlib import image

pytestmark = pytest.mark.skipif(
    not any(shutil.which(name) for name in ("cc", "gcc", "clang")), reason="there is no C compiler"
)
NAMES = ["m.s", "m.v", "sense.a", "k.f"]
REFUSED = FMICallException, Exception


def driven() -> ia.Network:
    """A mass on a spring and damper, driven by a force that time tells and by one from outside."""
    net = ia.Network(
        "driven",
        push=ia.Force(f=lambda t: 3 * ca.sin(5 * t)),
        more=ia.Force(),
        m=ia.Mass(m=2.0, s=0.1, v=0.3),
        k=ia.SpringDamper(k=50.0, d=1.0),
        w=ia.Fixed(s0=-0.2),
        sense=ia.AccelerationSensor(),
    )
    net.connect(net.push.flange, net.more.flange, net.m.flange, net.k.flange_b, net.sense.flange)
    return net.connect(net.k.flange_a, net.w.flange)


@pytest.fixture(scope="module", params=["2.0", "3.0"])
def path(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    target = tmp_path_factory.mktemp("rates") / "driven.fmu"
    return ia.export_fmu(
        driven(), target, fmi_version=request.param, outputs=NAMES, author="A", version="1.2"
    )


def begun(path: Path, folder: Path, **options: Any) -> tuple[Any, dict[str, int]]:
    description: Any = fmpy.read_model_description(str(path))
    fmpy.extract(str(path), str(folder))
    assert description.coSimulation.maxOutputDerivativeOrder == 1
    two = description.fmiVersion == "2.0"
    slave: Any = (FMU2Slave if two else FMU3Slave)(
        guid=description.guid,
        unzipDirectory=str(folder),
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="one",
    )
    slave.instantiate(**options)
    if two:
        slave.setupExperiment(startTime=0.4)
        slave.enterInitializationMode()
    else:
        slave.enterInitializationMode(startTime=0.4)
    slave.exitInitializationMode()
    return slave, {v.name: v.valueReference for v in description.modelVariables}


@pytest.fixture
def slave(path: Path, tmp_path: Path) -> Iterator[tuple[Any, dict[str, int], bool]]:
    made, references = begun(path, tmp_path)
    yield made, references, isinstance(made, FMU2Slave)
    made.terminate()
    made.freeInstance()


def test_rates_of_outputs_are_those_of_the_equations(slave: tuple[Any, dict[str, int], bool]) -> None:
    one, references, two = slave
    get = one.getReal if two else one.getFloat64
    rates_of = one.getRealOutputDerivatives if two else one.getOutputDerivatives
    (one.setReal if two else one.setFloat64)([references["more.f"]], [7.0])
    for k in range(3):
        t = 0.4 + 0.1 * k
        s, v, a, _ = get([references[name] for name in NAMES])
        rates = rates_of([references[name] for name in NAMES], [1] * 4)
        jerk = (15 * np.cos(5 * t) - 50 * v - 1.0 * a) / 2.0  # m a = 3 sin(5 t) + 7 - 50 (s + 0.2) - v
        assert a == pytest.approx((3 * np.sin(5 * t) + 7 - 50 * (s + 0.2) - v) / 2.0, rel=1e-9)
        assert rates == pytest.approx([v, a, jerk, 50 * v + 1.0 * a], rel=1e-7)
        one.doStep(t, 0.1)


def test_derivatives_of_higher_order_are_refused(slave: tuple[Any, dict[str, int], bool]) -> None:
    one, references, two = slave
    rates_of = one.getRealOutputDerivatives if two else one.getOutputDerivatives
    with pytest.raises(REFUSED):
        rates_of([references["m.s"]], [2])
    with pytest.raises(REFUSED):
        rates_of([references["k.k"]], [1])
    assert rates_of([references["m.s"]], [1])[0] == pytest.approx(0.3)


def test_variables_are_told_at_each_step_of_the_integrator(path: Path, tmp_path: Path) -> None:
    description: Any = fmpy.read_model_description(str(path))
    if description.fmiVersion == "2.0":
        pytest.skip("FMI 2.0 has no intermediate update")
    assert description.coSimulation.providesIntermediateUpdate
    told: list[tuple[float, float, float]] = []
    refused: list[str] = []

    def update(_: Any, time: float, set_: bool, get: bool, finished: bool, early: bool, *__: Any) -> None:
        assert (bool(set_), bool(get), bool(finished), bool(early)) == (False, True, True, False)
        position, rate = slave.getFloat64([references["m.s"], references["m.v"]])
        told.append((time, position, rate))
        try:
            slave.setFloat64([references["more.f"]], [1.0])
        except Exception as error:
            refused.append(str(error))

    slave, references = begun(path, tmp_path, intermediateUpdate=update, requiredIntermediateVariables=None)
    slave.doStep(0.4, 1.5)
    times, positions, rates = np.array(told).T
    assert len(told) > 10
    assert len(refused) == len(told)
    assert (np.diff(times) > 0).all()
    assert times[-1] == pytest.approx(1.9, abs=1e-12)
    native = driven().simulate(1.9, begin=0.4, step=1e-3, inputs={"more.f": 0.0}, rtol=1e-10)
    for name, values in {"m.s": positions, "m.v": rates}.items():
        apart = np.abs(values - np.interp(times, native.time, native[name])).max()
        assert apart < 1e-4 * np.ptp(native[name])
    slave.terminate()
    slave.freeInstance()


def test_binaries_are_stripped_and_rights_told(path: Path) -> None:
    assert validate_fmu(str(path)) == []
    with zipfile.ZipFile(path) as archive:
        described = archive.read("modelDescription.xml").decode()
        library = next(name for name in archive.namelist() if name.endswith((".so", ".dll", ".dylib")))
        binary = archive.read(library)
    assert 'author="A" version="1.2"' in described
    if binary.startswith(b"\x7fELF"):
        assert b".symtab" not in binary


def test_tools_are_shown_a_picture_of_the_network(path: Path) -> None:
    two = fmpy.read_model_description(str(path)).fmiVersion == "2.0"
    with zipfile.ZipFile(path) as archive:
        picture = archive.read("model.png" if two else "terminalsAndIcons/icon.png")
        drawn = b"" if two else archive.read("terminalsAndIcons/icon.svg")
        shown = b"" if two else archive.read("terminalsAndIcons/terminalsAndIcons.xml")
    pixels = image.imread(BytesIO(picture))
    assert pixels.shape[1] == 480
    assert pixels.shape[0] > 40
    assert pixels[..., :3].min() < 0.2 < 0.9 < pixels[..., :3].max()
    if not two:
        assert b"SpringDamper" in drawn
        assert b'<Icon x1="0" y1="0"' in shown
        ET.fromstring(drawn)
