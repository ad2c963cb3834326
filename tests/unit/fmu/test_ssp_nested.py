"""Systems inside a system, and parameters under other names, as other tools write them."""

from __future__ import annotations

import zipfile
from dataclasses import replace
from pathlib import Path

import inertance as ia
import pytest
from inertance import FMUError
from inertance.fmu import SystemStructure, read_ssp, split

HEAD = """<?xml version="1.0" encoding="UTF-8"?>
<ssd:SystemStructureDescription version="1.0" name="nested"
 xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
 xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon"
 xmlns:ssv="http://ssp-standard.org/SSP1/SystemStructureParameterValues"
 xmlns:ssm="http://ssp-standard.org/SSP1/SystemStructureParameterMapping">
"""
UNITS = """<ssd:Units><ssc:Unit name="t"><ssc:BaseUnit kg="1" factor="1000"/></ssc:Unit></ssd:Units>
<ssd:DefaultExperiment startTime="0" stopTime="1"/></ssd:SystemStructureDescription>"""


def connector(name: str, kind: str) -> str:
    return f'<ssd:Connector name="{name}" kind="{kind}"><ssc:Real/></ssd:Connector>'


def component(name: str, inputs: list[str], outputs: list[str], more: str = "") -> str:
    listed = [connector(n, "input") for n in inputs] + [connector(n, "output") for n in outputs]
    return (
        f'<ssd:Component name="{name}" type="application/x-fmu-sharedlibrary" source="resources/{name}.fmu">'
        f"<ssd:Connectors>{''.join(listed)}</ssd:Connectors>{more}</ssd:Component>"
    )


def joined(start: str, end: str, inner: str = "") -> str:
    told = []
    for side, path in (("start", start), ("end", end)):
        element, _, name = path.partition(":")
        told += [f'{side}Element="{element}"'] * bool(element) + [f'{side}Connector="{name}"']
    return f"<ssd:Connection {' '.join(told)}>{inner}</ssd:Connection>"


S, V, F = "body_flange.position.s", "body_flange.speed.v", "body_flange.force.f"
REF, RATE, TOLD = "strut_flange_b.motion.s_ref", "der(strut_flange_b.motion.s_ref)", "strut_flange_b.sensor.f"


@pytest.fixture(scope="module")
def flat(tmp_path_factory: pytest.TempPathFactory) -> SystemStructure:
    net = ia.Network(
        "car", road=ia.Fixed(), tyre=ia.Spring(k=150e3), wheel=ia.Mass(m=35.0),
        strut=ia.SpringDamper(k=20e3, d=1.5e3), body=ia.Mass(m=250.0),
    )  # fmt: skip
    net.connect(net.road.flange, net.tyre.flange_a)
    net.connect(net.tyre.flange_b, net.wheel.flange, net.strut.flange_a)
    net.connect(net.strut.flange_b, net.body.flange)
    cut = split(net, ["body"], names=("body", "wheel"))
    return cut.export(tmp_path_factory.mktemp("flat"), platforms=[])


def packed(flat: SystemStructure, path: Path, system: str, **files: str) -> Path:
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("SystemStructure.ssd", HEAD + system + UNITS)
        for name, fmu in flat.components.items():
            archive.write(fmu.path, f"resources/{name}.fmu")
        for name, text in files.items():
            archive.writestr(name, text)
    return path


def nested(scale: str = "", inner_scale: str = "", values: str = "", inside: str = "") -> str:
    """Return a body, and a wheel within an axle within a chassis; two connections are written backward."""
    walls = [connector("x", "input"), connector("v", "input"), connector("f", "output")]
    walled = f"<ssd:Connectors>{''.join(walls)}</ssd:Connectors>"
    axle = (
        f'<ssd:System name="axle">{walled}{inside}<ssd:Elements>{component("wheel", [REF, RATE], [TOLD])}'
        f"</ssd:Elements><ssd:Connections>{joined(':x', f'wheel:{REF}', inner_scale)}"
        f"{joined(f'wheel:{RATE}', ':v')}{joined(f'wheel:{TOLD}', ':f')}</ssd:Connections></ssd:System>"
    )
    chassis = (
        f'<ssd:System name="chassis">{walled}<ssd:Elements>{axle}</ssd:Elements><ssd:Connections>'
        f"{joined(':x', 'axle:x')}{joined(':v', 'axle:v')}{joined(':f', 'axle:f')}"
        "</ssd:Connections></ssd:System>"
    )
    return (
        f'<ssd:System name="whole">{values}<ssd:Elements>'
        f"{component('body', [F], [S, V])}{chassis}</ssd:Elements>"
        f"<ssd:Connections>{joined(f'body:{S}', 'chassis:x', scale)}{joined('chassis:v', f'body:{V}')}"
        f"{joined('chassis:f', f'body:{F}')}</ssd:Connections></ssd:System>"
    )


def test_a_system_in_a_system_in_a_system_is_the_flat_one(flat: SystemStructure, tmp_path: Path) -> None:
    read = read_ssp(packed(flat, tmp_path / "n.ssp", nested()))
    assert set(read.components) == {"body", "chassis_axle_wheel"}
    told = {(c.start, c.end) for c in read.connections}
    deep = {f"chassis_axle_wheel.{name}": f"wheel.{name}" for name in (REF, RATE, TOLD)}
    assert {(deep.get(a, a), deep.get(b, b)) for a, b in told} == {(c.start, c.end) for c in flat.connections}
    assert read.free_inputs() == []
    again = read.write(tmp_path / "again.ssp")
    assert set(read_ssp(again).components) == set(read.components)


@pytest.mark.parametrize("outside", [True, False])
def test_a_transformation_on_the_way_counts(flat: SystemStructure, tmp_path: Path, outside: bool) -> None:
    linear = '<ssc:LinearTransformation factor="-2.0" offset="0.5"/>'
    text = nested(linear, "") if outside else nested("", linear)
    read = read_ssp(packed(flat, tmp_path / "t.ssp", text))
    (link,) = [c for c in read.connections if c.end.endswith(REF) and "der" not in c.end]
    assert (link.factor, link.offset) == (-2.0, 0.5)
    with pytest.raises(FMUError, match="reached by two linear transformations"):
        read_ssp(packed(flat, tmp_path / "two.ssp", nested(linear, linear)))


def parameters(body: str, mapping: str = "", prefix: str = "") -> str:
    given = (
        f'<ssv:ParameterSet version="1.0" name="p"><ssv:Parameters>{body}</ssv:Parameters></ssv:ParameterSet>'
    )
    return (
        f'<ssd:ParameterBindings><ssd:ParameterBinding prefix="{prefix}"><ssd:ParameterValues>{given}'
        f"</ssd:ParameterValues>{mapping}</ssd:ParameterBinding></ssd:ParameterBindings>"
    )


def real(name: str, value: float, unit: str = "") -> str:
    measured = f' unit="{unit}"' if unit else ""
    return f'<ssv:Parameter name="{name}"><ssv:Real value="{value}"{measured}/></ssv:Parameter>'


MAPPED = (
    '<ssm:MappingEntry source="car.load" target="body.body.m">'
    '<ssc:LinearTransformation factor="0.5" offset="10"/></ssm:MappingEntry>'
    '<ssm:MappingEntry source="car.c" target="chassis.axle.wheel.tyre.k"/>'
)


def test_parameters_go_by_other_names(flat: SystemStructure, tmp_path: Path) -> None:
    entries = f'<ssm:ParameterMapping version="1.0">{MAPPED}</ssm:ParameterMapping>'
    inline = f"<ssd:ParameterMapping>{entries}</ssd:ParameterMapping>"
    text = real("load", 0.4, "t") + real("c", 2e5) + real("unused", 1.0)
    read = read_ssp(packed(flat, tmp_path / "m.ssp", nested(values=parameters(text, inline, "car."))))
    assert read.parameters == {"body": {"body.m": 210.0}, "chassis_axle_wheel": {"tyre.k": 2e5}}


def test_a_mapping_may_be_a_file(flat: SystemStructure, tmp_path: Path) -> None:
    space = HEAD.partition("xmlns:ssc")[2].rpartition(">")[0]
    file = f'<?xml version="1.0"?><ssm:ParameterMapping version="1.0" xmlns:ssc{space}>{MAPPED}'
    file += "</ssm:ParameterMapping>"
    outer = parameters(real("load", 0.4, "t"), '<ssd:ParameterMapping source="names.ssm"/>', "car.")
    path = packed(flat, tmp_path / "f.ssp", nested(values=outer), **{"names.ssm": file})
    assert read_ssp(path).parameters == {"body": {"body.m": 210.0}}


def test_what_is_given_outside_goes_before_what_is_given_inside(
    flat: SystemStructure, tmp_path: Path
) -> None:
    inner = parameters(real("wheel.tyre.k", 1e5) + real("wheel.wheel.m", 30.0))
    outer = parameters(real("chassis.axle.wheel.tyre.k", 3e5))
    read = read_ssp(packed(flat, tmp_path / "o.ssp", nested(values=outer, inside=inner)))
    assert read.parameters == {"chassis_axle_wheel": {"tyre.k": 3e5, "wheel.m": 30.0}}
    lost = parameters(real("chassis.wheel.tyre.k", 3e5))
    with pytest.raises(FMUError, match=r"'chassis\.wheel\.tyre\.k', where there is no component"):
        read_ssp(packed(flat, tmp_path / "l.ssp", nested(values=lost)))


def renamed(flat: SystemStructure, names: dict[str, str]) -> SystemStructure:
    """Return the same system with other names of components."""

    def told(path: str) -> str:
        component, _, variable = path.partition(".")
        return f"{names[component]}.{variable}"

    connections = [replace(c, start=told(c.start), end=told(c.end)) for c in flat.connections]
    components = {names[n]: fmu for n, fmu in flat.components.items()}
    return replace(flat, components=components, connections=connections)


def test_a_system_is_written_with_systems_inside(flat: SystemStructure, tmp_path: Path) -> None:
    deep = renamed(flat, {"body": "cab_body", "wheel": "chassis_axle_wheel"})
    deep.connections[0] = replace(deep.connections[0], factor=-2.0, offset=0.5)
    deep.connections[1] = replace(deep.connections[1], convert=False)
    deep.parameters = {"chassis_axle_wheel": {"tyre.k": 2e5}}
    groups = {"cab": ["cab_body"], "chassis.axle": ["chassis_axle_wheel"]}
    path = deep.write(tmp_path / "deep.ssp", groups=groups)
    with zipfile.ZipFile(path) as archive:
        text = archive.read("SystemStructure.ssd").decode()
    for name in ("cab", "chassis", "axle"):
        assert text.count(f'<ssd:System name="{name}">') == 1
    assert '<ssd:Component name="wheel"' in text
    read = read_ssp(path)
    assert set(read.components) == set(deep.components)
    assert {c.end: c for c in read.connections} == {c.end: c for c in deep.connections}
    assert read.parameters["chassis_axle_wheel"] == {"tyre.k": (2e5, "N/m")}


def test_an_input_is_led_through_the_walls(flat: SystemStructure, tmp_path: Path) -> None:
    alone = replace(flat, components={"chassis_wheel": flat.components["wheel"]}, connections=[])
    path = alone.write(tmp_path / "alone.ssp", groups={"chassis": ["chassis_wheel"]})
    assert read_ssp(path).free_inputs() == alone.free_inputs() == [f"chassis_wheel.{n}" for n in (REF, RATE)]


@pytest.mark.parametrize(
    ("groups", "told"),
    [
        ({"axle": ["whee"]}, "no component 'whee'; did you mean 'wheel'"),
        ({"axle": ["wheel"], "rear": ["wheel"]}, "'wheel' is in two systems"),
        ({"wheel": ["body"]}, "'wheel' would be two elements"),
        ({"body": ["wheel"]}, "'body' would be two elements"),
        ({"a..b": ["body"]}, "is no path of names"),
    ],
)
def test_systems_that_cannot_be_are_told(
    flat: SystemStructure, tmp_path: Path, groups: dict[str, list[str]], told: str
) -> None:
    with pytest.raises(FMUError, match=told):
        flat.write(tmp_path / "bad.ssp", groups=groups)
