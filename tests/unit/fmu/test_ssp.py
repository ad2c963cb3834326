"""Systems of FMUs: split networks, the SSP file, coupling errors, other masters."""

from __future__ import annotations

import shutil
import zipfile
from pathlib import Path
from typing import Any

import fmpy
import inertance as ia
import numpy as np
import pytest
from fmpy.ssp.simulation import simulate_ssp
from fmpy.ssp.ssd import read_ssd
from inertance import FMUError, ModelError, Network
from inertance.fmu import Connection, FMUForce, Split, SystemStructure, read_ssp, split
from inertance.machines import Sinusoid

from .conftest import MakeFMU

needs_compiler = pytest.mark.skipif(
    not any(shutil.which(name) for name in ("cc", "gcc", "clang")), reason="there is no C compiler"
)
STOP = 0.4
TIGHT: dict[str, Any] = {"rtol": 1e-9, "halving": False}
START = {"body.v": 1.0}


def car() -> Network:
    net = Network(
        "quarter car",
        road=ia.Position(s_ref=0.0),
        tyre=ia.Spring(k=150e3),
        wheel=ia.Mass(m=35.0),
        strut=ia.SpringDamper(k=20e3, d=1.5e3),
        body=ia.Mass(m=250.0),
        load=ia.Force(),
    )
    net.connect(net.road.flange, net.tyre.flange_a)
    net.connect(net.tyre.flange_b, net.wheel.flange, net.strut.flange_a)
    return net.connect(net.strut.flange_b, net.body.flange, net.load.flange)


def load(t: float) -> float:
    return 500.0 * float(np.sin(20.0 * t))


def exported(cut: Split, folder: Path, version: str = "2.0") -> SystemStructure:
    return cut.export(
        folder, fmi_version=version, start=START, outputs=["body.s"], tolerance=1e-9, sources=False, stop=STOP
    )


@pytest.fixture(scope="module")
def truth() -> ia.Result:
    inputs = {"load.f": Sinusoid(500.0, 10.0 / np.pi)}
    return car().simulate(STOP, step=0.01, start=START, inputs=inputs, rtol=1e-11, atol=1e-13)


@pytest.fixture(scope="module")
def cut_at_the_body(tmp_path_factory: pytest.TempPathFactory) -> SystemStructure:
    sides = split(car(), ["body", "load"], names=("body", "wheel"))
    return exported(sides, tmp_path_factory.mktemp("force"))


@pytest.fixture(scope="module")
def cut_through_the_strut(tmp_path_factory: pytest.TempPathFactory) -> SystemStructure:
    sides = split(car(), ["body", "load"], through=["strut"], names=("body", "wheel"))
    return exported(sides, tmp_path_factory.mktemp("motion"), "3.0")


def errors(
    system: SystemStructure, truth: ia.Result, steps: tuple[float, ...], **options: Any
) -> list[float]:
    found = []
    for step in steps:
        run = system.simulate(communication_step=step, inputs={"body.load.f": load}, **TIGHT, **options)
        found.append(
            float(np.abs(np.interp(truth.time, run.time, run["body.body.s"]) - truth["body.s"]).max())
        )
    return found


def test_split_by_force_and_displacement() -> None:
    cut = split(car(), ["body", "load"], names=("body", "wheel"))
    assert cut.terminals == {"body": {"body.flange": "force-in"}, "wheel": {"strut.flange_b": "motion-in"}}
    assert cut.pairs == [(("body", "body.flange"), ("wheel", "strut.flange_b"))]
    assert list(cut.sides["body"]._parts) == ["body", "load"]
    assert list(cut.sides["wheel"]._parts) == ["road", "tyre", "wheel", "strut"]


def test_split_through_an_element_gives_it_to_both() -> None:
    cut = split(car(), ["body", "load"], through=["strut"])
    assert cut.terminals == {
        "first": {"strut.flange_a": "motion-in", "body.flange": "motion-out"},
        "second": {"tyre.flange_b": "motion-out", "strut.flange_b": "motion-in"},
    }
    first, second = cut.sides.values()
    assert first._parts["strut"] is not second._parts["strut"]


def test_split_at_several_nodes_keeps_what_was_inserted() -> None:
    net = Network(
        "two ways", m1=ia.Mass(m=1.0), m2=ia.Mass(m=1.0), a=ia.Spring(k=1.0), b=ia.Spring(k=2.0), g=ia.Fixed()
    )
    net.connect(net.m1.flange, net.a.flange_a)
    net.connect(net.m2.flange, net.b.flange_a)
    net.connect(net.a.flange_b, net.g.flange)
    net.connect(net.b.flange_b, net.g.flange)
    net.insert(net.b.flange_b, play=ia.Backlash(k=1e6, d=1.0, eps=1e-3))
    cut = split(net, ["m1", "m2"])
    assert cut.terminals["first"] == {"m1.flange": "force-in", "m2.flange": "force-in"}
    assert [name for _, name in cut.sides["second"]._inserted] == ["play"]
    with pytest.raises(ModelError, match=r"'play' is inserted at 'b.flange_b'"):
        split(net, ["m1", "m2", "play"])


@pytest.mark.parametrize(
    ("first", "through", "told"),
    [
        (["boddy"], [], r"there is no component 'boddy'; did you mean 'body'"),
        (["body"], ["body"], r"'body' is in `first` and in `through`"),
        ([], [], r"the two sides do not touch"),
        (["body"], ["strut"], r"'strut.flange_b' of a coupling element meets both sides"),
    ],
)
def test_what_cannot_be_split_is_told(first: list[str], through: list[str], told: str) -> None:
    with pytest.raises(ModelError, match=told):
        split(car(), first, through=through)


def test_names_that_neither_side_has_are_told(tmp_path: Path) -> None:
    cut = split(car(), ["body", "load"])
    with pytest.raises(ModelError, match=r"'weel.s': there is no component 'weel'; did you mean 'wheel'"):
        cut.export(tmp_path, outputs=["weel.s"])
    assert not list(tmp_path.iterdir())


def test_signals_do_not_cross() -> None:
    net = Network("driven", wave=ia.signals.Sine(f=1.0), push=ia.Force(), mass=ia.Mass(m=1.0))
    net.connect(net.wave.y, net.push.f)
    net.connect(net.push.flange, net.mass.flange)
    with pytest.raises(ModelError, match=r"the signal at 'wave\.y' crosses the cut"):
        split(net, ["mass", "push"])


@needs_compiler
@pytest.mark.parametrize("kind", ["CS", "ME"])
def test_force_displacement_error_falls_with_step_or_its_square(
    cut_at_the_body: SystemStructure, truth: ia.Result, kind: str
) -> None:
    held = errors(cut_at_the_body, truth, (5e-3, 2.5e-3), order=0, kind=kind)
    line = errors(cut_at_the_body, truth, (5e-3, 2.5e-3), kind=kind)
    assert held[0] / held[1] == pytest.approx(2.0, rel=0.1)
    assert line[0] / line[1] == pytest.approx(4.0, rel=0.15)
    assert line[1] < 0.05 * held[1]


@needs_compiler
def test_displacement_displacement_in_fmi_3(cut_through_the_strut: SystemStructure, truth: ia.Result) -> None:
    held = errors(cut_through_the_strut, truth, (5e-3, 2.5e-3), order=0)
    line = errors(cut_through_the_strut, truth, (5e-3, 2.5e-3))
    assert held[0] / held[1] == pytest.approx(2.0, rel=0.15)
    assert line[0] / line[1] == pytest.approx(4.0, rel=0.15)


@needs_compiler
@pytest.mark.parametrize(("order", "fall"), [(0, 2.0), (1, 4.0)])
def test_a_position_beside_its_rate_follows_it_in_a_network(
    cut_at_the_body: SystemStructure, truth: ia.Result, order: int, fall: float
) -> None:
    motion = "strut_flange_b.motion.s_ref"
    wheel = FMUForce(
        cut_at_the_body.components["wheel"], position=motion, velocity=f"der({motion})",
        force="-strut_flange_b.sensor.f", kind="CS",
    )  # fmt: skip
    net = Network("body", wall=ia.Fixed(), wheel=wheel, body=ia.Mass(m=250.0, v=1.0), load=ia.Force())
    net.connect(net.wall.flange, net.wheel.flange_a)
    net.connect(net.wheel.flange_b, net.body.flange, net.load.flange)
    inputs = {"load.f": Sinusoid(500.0, 10.0 / np.pi)}
    found = []
    for step in (5e-3, 2.5e-3):
        run = ia.fmu.cosimulate(
            net, STOP, communication_step=step, order=order, inputs=inputs, halving=False, rtol=1e-9
        )
        found.append(np.abs(np.interp(truth.time, run.time, run["body.s"]) - truth["body.s"]).max())
    assert found[0] / found[1] == pytest.approx(fall, rel=0.2)


@needs_compiler
def test_step_error_is_that_of_the_step(cut_at_the_body: SystemStructure, truth: ia.Result) -> None:
    run = cut_at_the_body.simulate(communication_step=5e-3, inputs={"body.load.f": load})
    seen = np.interp(truth.time, run.time, run["body.body_flange.position.s"]) - truth["body.s"]
    assert run.step_error["body.body_flange.position.s"] == pytest.approx(0.75 * np.abs(seen).max(), rel=0.1)
    assert run.unit("body.body.s") == "m"
    assert run.to_dataframe().shape == (81, len(run.names()) - 1)
    with pytest.raises(KeyError, match=r"'body.body.z' of 'quarter car' was not recorded; did you mean"):
        run["body.body.z"]


@needs_compiler
def test_a_step_that_is_too_long_is_told(cut_at_the_body: SystemStructure) -> None:
    with pytest.raises(FMUError, match="the coupling is unstable"):
        cut_at_the_body.simulate(20.0, communication_step=0.2)


@needs_compiler
def test_parameters_by_component(cut_at_the_body: SystemStructure) -> None:
    values: dict[str, Any] = {"body.m": (0.5, "t"), "load.f": 100.0, "body.v": 0.5}
    joined = cut_at_the_body
    system = SystemStructure("heavy", joined.components, joined.connections, {"body": values}, stop=0.2)
    heavy = car().simulate(
        0.2, parameters={"body.m": 500.0}, start={"body.v": 0.5}, inputs={"load.f": 100.0}, rtol=1e-10
    )
    run = system.simulate(communication_step=1e-3, halving=False)
    assert run["body.body.s"][-1] == pytest.approx(heavy["body.s"][-1], rel=2e-4)


@needs_compiler
def test_events_end_the_step_for_all(tmp_path: Path) -> None:
    net = Network(
        "stopped", wall=ia.Fixed(s0=-0.02), stop=ia.HardStop(e=0.5), mass=ia.Mass(m=1.0, s=0.0, v=-1.0),
        spring=ia.SpringDamper(k=1e3, d=5.0), ground=ia.Fixed(),
    )  # fmt: skip
    net.connect(net.wall.flange, net.stop.flange_a)
    net.connect(net.stop.flange_b, net.mass.flange, net.spring.flange_a)
    net.connect(net.spring.flange_b, net.ground.flange)
    whole = net.simulate(0.1, rtol=1e-10)
    cut = split(net, ["wall", "stop", "mass"])
    system = cut.export(tmp_path, fmi_version="3.0", outputs=["mass.s"], tolerance=1e-8, sources=False)
    run = system.simulate(0.1, communication_step=5e-4, rtol=1e-8, halving=False)
    hits = {round(event.time, 9) for event in run.events}
    assert len(hits) == len({e.time for e in whole.events}) > 0
    assert min(hits) == pytest.approx(whole.events[0].time, abs=1e-5)
    assert run["first.mass.s"][-1] == pytest.approx(whole["mass.s"][-1], abs=2e-5)


@needs_compiler
def test_the_file_is_valid_and_reads_back(cut_at_the_body: SystemStructure, tmp_path: Path) -> None:
    told = [
        Connection(c.start, c.end, 1.0 + k, 0.5 * k, k != 1)
        for k, c in enumerate(cut_at_the_body.connections)
    ]
    given: dict[str, dict[str, Any]] = {"body": {"body.m": (0.3, "t")}, "wheel": {"tyre.k": 1e5}}
    system = SystemStructure("a <car>", cut_at_the_body.components, told, given, begin=0.25, stop=2.0)
    path = system.write(tmp_path / "car.ssp")
    described: Any = read_ssd(str(path))  # validates against SystemStructureDescription.xsd
    assert {unit.name for unit in described.units} >= {"m", "N", "m/s"}
    assert [c.name for c in described.system.connectors] == ["body:load.f"]
    back = read_ssp(path)
    assert (back.name, back.begin, back.stop, back.connections) == ("a <car>", 0.25, 2.0, told)
    assert back.parameters == {"body": {"body.m": (300.0, "kg")}, "wheel": {"tyre.k": (1e5, "N/m")}}
    assert back.free_inputs() == ["body.load.f"]


@needs_compiler
def test_fmpy_runs_the_file(cut_at_the_body: SystemStructure, truth: ia.Result, tmp_path: Path) -> None:
    path = cut_at_the_body.write(tmp_path / "car.ssp")
    found = []
    for step in (2e-3, 1e-3):
        rows = simulate_ssp(str(path), stop_time=STOP, step_size=step, input={"body:load.f": load})
        s = np.interp(truth.time[1:], rows["time"] + step, rows["body.body.s"])
        found.append(np.abs(s - truth["body.s"][1:]).max() / np.ptp(truth["body.s"]))
    assert found[1] < 0.03
    assert found[0] / found[1] == pytest.approx(2.0, rel=0.1)


@needs_compiler
def test_libcosim_runs_the_file(tmp_path: Path) -> None:
    execution = pytest.importorskip("libcosimpy.CosimExecution", reason="no libcosimpy: a second master")
    observers = pytest.importorskip("libcosimpy.CosimObserver")
    free = car()
    sides = split(free.with_values(load=ia.Force(f=0.0)), ["body", "load"], through=["strut"])
    system = exported(sides, tmp_path)
    path = system.write(tmp_path / "car.ssp")
    with zipfile.ZipFile(path) as archive:
        archive.extractall(tmp_path / "car")
    master = execution.CosimExecution.from_ssp_file(str(tmp_path / "car"), int(2.5e6))
    observer = observers.CosimObserver.create_last_value()
    master.add_observer(observer)
    slave = master.slave_index_from_instance_name("first")
    variables = {v.name: v.reference for v in master.slave_variables(slave)}
    own = system.simulate(communication_step=2.5e-3, order=0, **TIGHT)
    for s in own["first.body.s"][1:]:
        master.step()
        seen = observer.last_real_values(slave, [variables[b"body.s"]])[0]
        assert seen == pytest.approx(s, abs=1e-8)


def test_units_are_converted(make_fmu: MakeFMU) -> None:
    fmus = {"body": ia.FMU(make_fmu("body")), "spring": ia.FMU(make_fmu("spring"))}
    joined = [Connection("body.s", "spring.s"), Connection("spring.F", "body.F", -1.0)]
    assert fmus["spring"].unit("s") == "mm"
    system = SystemStructure("oscillator", fmus, joined, {"body": {"v": 1.0}, "spring": {"k": 0.1}}, stop=0.5)
    run = system.simulate(communication_step=1e-3, kind="ME", halving=False)
    w = np.sqrt(100.0 / 2.0)
    assert np.abs(run["body.s"] - np.sin(w * run.time) / w).max() < 1e-5


@pytest.mark.parametrize(
    ("joined", "told"),
    [
        ([Connection("boddy.s", "spring.s")], r"no component 'boddy'.*did you mean 'body'"),
        ([Connection("body.s", "spring.x")], r"no such variable 'x'"),
        ([Connection("spring.s", "body.F")], r"goes from input to input"),
        ([Connection("body.v", "spring.s")], r"m/s does not convert to mm"),
        ([Connection("body.s", "spring.s")] * 2, r"'spring.s' is the end of two connections"),
    ],
)
def test_what_cannot_be_joined_is_told(make_fmu: MakeFMU, joined: list[Connection], told: str) -> None:
    fmus = {"body": ia.FMU(make_fmu("body")), "spring": ia.FMU(make_fmu("spring"))}
    with pytest.raises(FMUError, match=told):
        SystemStructure("oscillator", fmus, joined).check()


def test_wrong_runs_are_told(make_fmu: MakeFMU, tmp_path: Path) -> None:
    system = SystemStructure("one", {"body": ia.FMU(make_fmu("body"))})
    with pytest.raises(FMUError, match=r"communication_step=0"):
        system.simulate(communication_step=0.0)
    with pytest.raises(FMUError, match=r"no free input 'body.G'"):
        system.simulate(communication_step=0.1, inputs={"body.G": 1.0})
    with pytest.raises(ModelError, match=r"ends in '.ssp'"):
        system.write(tmp_path / "one.zip")


SSD = """<ssd:SystemStructureDescription version="1.0" name="n"
 xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
 xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon"><ssd:System name="s">
 <ssd:Elements>{}</ssd:Elements></ssd:System></ssd:SystemStructureDescription>"""


@pytest.mark.parametrize(
    ("content", "told"),
    [
        ({}, r"has no SystemStructure.ssd: it is no SSP"),
        ({"SystemStructure.ssd": "<a>"}, r"SystemStructure.ssd is invalid"),
        ({"SystemStructure.ssd": SSD.format("<ssd:Part/>")}, r"SystemStructure.ssd is invalid: .*Part"),
        (
            {"SystemStructure.ssd": SSD.format('<ssd:Component name="c" source="../../c.fmu"/>')},
            r"has no \.\./\.\./c\.fmu",
        ),
        (
            {"SystemStructure.ssd": SSD.format('<ssd:Component name="c" source="http://x.org/c.fmu"/>')},
            r"component 'c' \(http://x.org/c.fmu\) is no FMU inside of it",
        ),
        ({"../SystemStructure.ssd": ""}, r"leads out of the archive"),
    ],
)
def test_bad_files_are_told(tmp_path: Path, content: dict[str, str], told: str) -> None:
    path = tmp_path / "bad.ssp"
    with zipfile.ZipFile(path, "w") as archive:
        for name, text in content.items():
            archive.writestr(name, text)
    with pytest.raises(FMUError, match=told):
        read_ssp(path)


def test_parameter_files_prefixes_and_reversed_connections(make_fmu: MakeFMU, tmp_path: Path) -> None:
    values = (
        '<ssv:ParameterSet version="1.0" name="p" '
        'xmlns:ssv="http://ssp-standard.org/SSP1/SystemStructureParameterValues"><ssv:Parameters>'
        '<ssv:Parameter name="m"><ssv:Real value="3"/></ssv:Parameter></ssv:Parameters></ssv:ParameterSet>'
    )
    binding = (
        '<ssd:ParameterBindings><ssd:ParameterBinding prefix="body." source="p.ssv"/></ssd:ParameterBindings>'
    )
    parts = "".join(
        f'<ssd:Component name="{name}" source="resources/{name}.fmu"><ssd:Connectors>'
        f'<ssd:Connector name="{connector}" kind="{kind}"><ssc:Real/></ssd:Connector></ssd:Connectors>'
        "</ssd:Component>"
        for name, connector, kind in (("body", "s", "output"), ("spring", "s", "input"))
    )
    joined = (
        '<ssd:Connections><ssd:Connection startElement="spring" startConnector="s" endElement="body" '
        'endConnector="s" suppressUnitConversion="true"/></ssd:Connections>'
    )
    ssd = SSD.replace('<ssd:System name="s">', f'<ssd:System name="s">{binding}').format(parts)
    path = tmp_path / "foreign.ssp"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("SystemStructure.ssd", ssd.replace("</ssd:Elements>", f"</ssd:Elements>{joined}"))
        archive.writestr("p.ssv", values)
        for name in ("body", "spring"):
            archive.write(make_fmu(name), f"resources/{name}.fmu")
    system = read_ssp(path)
    assert system.connections == [Connection("body.s", "spring.s", convert=False)]
    assert system.parameters == {"body": {"m": 3.0}}
    assert fmpy.read_model_description(str(system.components["body"].path)).modelName == "body"
