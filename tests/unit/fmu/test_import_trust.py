"""What an import would get wrong without a word: it is right, refused, or told."""

from __future__ import annotations

import zipfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any, Protocol

import numpy as np
import pytest
from inertance import FMU, FMUError, Force, InertanceError, Mass, Network, PositionSensor, Sampled
from inertance.fmu import Connection, FMUBlock, SystemStructure, cosimulate

Edit = tuple[str, str]
UNITS = "</UnitDefinitions>"
KELVIN = '<Unit name="K"><BaseUnit K="1"/><DisplayUnit name="degC" offset="-273.15"/></Unit>' + UNITS
TYPES = (
    '</UnitDefinitions><TypeDefinitions><SimpleType name="Gear"><Enumeration><Item name="low" value="1"/>'
    '<Item name="high" value="4"/></Enumeration></SimpleType></TypeDefinitions>'
)


class Make(Protocol):
    def __call__(self, model: str, *defines: str) -> Path: ...


Variant = Callable[..., FMU]


@pytest.fixture
def variant(make_fmu: Make, tmp_path: Path) -> Variant:
    """Return a function that gives one of the models another description."""

    def edit(model: str, *edits: Edit, **options: Any) -> FMU:
        path = tmp_path / f"{model}.fmu"
        with zipfile.ZipFile(make_fmu(model)) as archive, zipfile.ZipFile(path, "w") as copy:
            for name in archive.namelist():
                content = archive.read(name)
                if name == "modelDescription.xml":
                    text = content.decode()
                    for old, new in edits:
                        assert old in text, old
                        text = text.replace(old, new)
                    content = text.encode()
                copy.writestr(name, content)
        return FMU(path, **options)

    return edit


def unit_of(variable: str, unit: str) -> Edit:
    """Return the edit that gives the spring's parameter another unit."""
    return f'<Real unit="N/m" start="{variable}"/>', f'<Real {unit} start="{variable}"/>'


def test_temperatures_have_an_offset_and_their_differences_none(variant: Variant) -> None:
    celsius = variant("spring", (UNITS, KELVIN), unit_of("100", 'unit="K"'))
    run = celsius.simulate(0.1, inputs={"s": 1.0}, parameters={"k": (20.0, "degC")})
    assert run["F"][-1] == pytest.approx(293.15)
    rise = variant("spring", (UNITS, KELVIN), unit_of("100", 'unit="K" relativeQuantity="true"'))
    run = rise.simulate(0.1, inputs={"s": 1.0}, parameters={"k": (20.0, "degC")})
    assert run["F"][-1] == pytest.approx(20.0)


def test_a_type_says_that_a_quantity_is_relative(variant: Variant) -> None:
    types = KELVIN + (
        '<TypeDefinitions><SimpleType name="Rise"><Real unit="K" relativeQuantity="true"/></SimpleType>'
        "</TypeDefinitions>"
    )
    rise = variant("spring", (UNITS, types), unit_of("100", 'declaredType="Rise"'))
    run = rise.simulate(0.1, inputs={"s": 1.0}, parameters={"k": (20.0, "degC")})
    assert run["F"][-1] == pytest.approx(20.0)


def test_signals_with_an_offset_pass_in_si(variant: Variant) -> None:
    """A mass at 0 m: its sensor is read in a unit that begins at -273.15 m, and so is the force."""
    shifted = '<Unit name="depth"><BaseUnit m="1" offset="10"/></Unit>' + UNITS
    fmu = variant("relay", (UNITS, shifted), ('"input"><Real', '"input"><Real unit="depth"'))
    net = Network("deep", body=Mass(m=1.0, s=9.0), sensor=PositionSensor(), relay=FMUBlock(fmu))
    net.connect(net.body.flange, net.sensor.flange)
    net.connect(net.sensor.s, net.relay.u)
    run = cosimulate(net, 0.5, communication_step=0.1, halving=False, start={"body.v": 0.0})
    assert run["relay.y"][-1] == pytest.approx(-0.5)  # 9 m are -1 depth


@pytest.mark.parametrize(
    ("unit", "given", "told"),
    [
        ('unit="rad/s"', (50.0, "Hz"), "in rad/s, not convertible from Hz"),
        ('unit="Hz"', (50.0, "rad/s"), "in Hz, not convertible from rad/s"),
        ('unit="rpm"', (50.0, "Hz"), "in rpm, not convertible from Hz"),
        ("", (50.0, "N/m"), "declares no unit, so that N/m cannot be converted"),
        (
            'unit="l/100km"',
            (50.0, "m"),
            "FMU 'spring': 'k': there is no unit 'l/100km'; '100km' is not understood",
        ),
        ('unit="N"', (50.0, "g"), "in N, not convertible from g"),
    ],
)
def test_units_that_do_not_convert(variant: Variant, unit: str, given: Any, told: str) -> None:
    with pytest.raises(FMUError, match=told):
        variant("spring", unit_of("100", unit)).simulate(0.1, parameters={"k": given})


@pytest.mark.parametrize(("unit", "factor"), [("m/s2", 9.80665), ("kg", 1e-3)])
def test_g_is_gravity_for_an_acceleration_though_the_fmu_defines_the_gram(
    variant: Variant, unit: str, factor: float
) -> None:
    gram = (
        '<Unit name="kg"><BaseUnit kg="1"/>',
        '<Unit name="kg"><BaseUnit kg="1"/><DisplayUnit name="g" factor="1000"/>',
    )
    fmu = variant("spring", gram, unit_of("100", f'unit="{unit}"'))
    assert fmu.converted(fmu.variables["k"], (2.0, "g")) == pytest.approx(2.0 * factor)


@pytest.mark.parametrize(
    ("unit", "si"), [("Hz", "Hz"), ("rpm", "rad/s"), ("N/(m/s)", "N.s/m"), ("kN.mm", "N.m"), ("J", "J")]
)
def test_the_si_unit_of_a_variable_goes_by_its_usual_name(variant: Variant, unit: str, si: str) -> None:
    fmu = variant("spring", unit_of("100", f'unit="{unit}"'))
    assert fmu.measure(fmu.variables["k"]).si_name == si


def test_radians_that_a_declaration_leaves_out_are_those_of_the_name(variant: Variant) -> None:
    bare = '<Unit name="rpm"><BaseUnit s="-1" factor="0.10471975511965977"/></Unit>' + UNITS
    fmu = variant("spring", (UNITS, bare), unit_of("100", 'unit="rpm"'))
    assert fmu.measure(fmu.variables["k"]).si_name == "rad/s"
    with pytest.raises(FMUError, match="in rpm, not convertible from Hz"):
        fmu.converted(fmu.variables["k"], (50.0, "Hz"))


def test_a_display_unit_that_shows_the_reciprocal_is_no_unit(variant: Variant) -> None:
    inverse = '<Unit name="m3/m"><BaseUnit m="2"/><DisplayUnit name="m/m3" factor="2" inverse="true"/></Unit>'
    fmu = variant("spring", (UNITS, inverse + UNITS), unit_of("100", 'unit="m3/m"'), validate=False)
    with pytest.raises(FMUError, match="not convertible from m/m3"):
        fmu.simulate(0.1, parameters={"k": (50.0, "m/m3")})


def test_a_unit_declared_without_its_factor(variant: Variant) -> None:
    """Some tools write every unit with the factor 1; a millimetre would be a metre."""
    bare = ('<BaseUnit m="1" factor="0.001"/>', '<BaseUnit m="1"/>')
    fmu = variant("spring", bare)
    with pytest.raises(FMUError, match=r"unit mm of 's' is declared without the factor .* as if it were m"):
        fmu.simulate(0.1, inputs={"s": (2.0, "m")})
    assert fmu.simulate(0.1, inputs={"s": 2000.0})["F"][-1] == 200_000
    believing = variant("spring", bare, validate=False)
    assert believing.simulate(0.1, inputs={"s": (2.0, "m")})["F"][-1] == 200.0


@pytest.mark.parametrize(
    ("kind", "value", "told"),
    [
        ("Integer", 1.7, "is Integer, a whole number from -2147483648 to 2147483647, got 1.7"),
        ("Integer", 2**31, "a whole number"),
        ("Boolean", 0.3, "is true or false, got 0.3"),
        ("Boolean", 2, "is true or false, got 2"),
        ('Enumeration declaredType="Gear"', 2, r"takes one of low \(1\), high \(4\), got 2"),
        ('Enumeration declaredType="Gear"', "hihg", "has no choice 'hihg'; did you mean 'high'"),
        ("Real", float("nan"), "must be between -inf and inf, got nan"),
        ("Real", "2", "takes a number"),
    ],
)
def test_values_that_would_be_rounded_or_cut(variant: Variant, kind: str, value: Any, told: str) -> None:
    fmu = variant("spring", (UNITS, TYPES), ('<Real unit="N/m" start="100"/>', f'<{kind} start="1"/>'))
    with pytest.raises(FMUError, match=told):
        fmu.simulate(0.1, parameters={"k": value})


def test_a_choice_by_its_name(variant: Variant) -> None:
    gear = ('<Real unit="N/m" start="100"/>', '<Enumeration declaredType="Gear" start="1"/>')
    fmu = variant("spring", (UNITS, TYPES), gear)
    from inertance.fmu.foreign.initialization import checked

    assert checked(fmu, fmu.variables["k"], "high") == [4]
    small = replace(fmu.variables["k"], type="UInt8", choices={}, size=2)
    with pytest.raises(FMUError, match="a whole number from 0 to 255, got -1"):
        checked(fmu, small, [1, -1])


SHORT = np.linspace(0.0, 0.5, 51)


@pytest.mark.parametrize("signal", [(SHORT, SHORT**3), Sampled(SHORT, SHORT**3), (SHORT + 0.6, SHORT)])
@pytest.mark.parametrize("kind", ["ME", "CS"])
def test_data_that_end_early_or_begin_late(make_fmu: Make, signal: Any, kind: str) -> None:
    with pytest.raises(InertanceError, match=r"input 'F'.* data"):
        FMU(make_fmu("body")).simulate(1.0, kind=kind, inputs={"F": signal}, step=0.01)


def test_data_in_a_long_quiet_record_are_not_stepped_over(make_fmu: Make) -> None:
    t = np.linspace(0.0, 100.0, 20_001)
    force = np.where((t > 71.3) & (t < 71.36), 100.0 * np.sin((t - 71.3) * np.pi / 0.06) ** 2, 0.0)
    run = FMU(make_fmu("body")).simulate(100.0, inputs={"F": (t, force)}, step=10.0)
    assert run["v"][-1] == pytest.approx(100.0 * 0.03 / 2.0, rel=1e-4)


def test_inputs_of_a_slave_are_their_mean_over_a_step(make_fmu: Make) -> None:
    runs = [
        FMU(make_fmu("body")).simulate(1.0, kind="CS", inputs={"F": np.cos}, step=step)
        for step in (0.1, 0.05)
    ]
    errors = [abs(run["v"][-1] - np.sin(1.0) / 2) for run in runs]
    assert errors[0] < 1e-6  # 0.012 when the value at the beginning was held


def test_held_inputs_jump_where_they_should(variant: Variant) -> None:
    edits = (
        'valueReference="2" causality="input"',
        'valueReference="2" causality="input" variability="discrete"',
    )
    fmu = variant("body", edits)
    inputs = {"F": ([0.0, 0.055], [0.0, 2.0])}
    assert fmu.simulate(0.1, kind="CS", inputs=inputs, step=0.01)["v"][-1] == pytest.approx(0.045)
    rigid = variant(
        "body", edits, ('canHandleVariableCommunicationStepSize="true"', "")
    ).simulate(0.1, kind="CS", inputs=inputs, step=0.01)  # fmt: skip
    assert rigid["v"][-1] == pytest.approx(0.04)
    assert "jump at 0.055 s do so at the communication point after" in rigid.notes[0]


def test_steps_that_are_others_than_asked_are_told(make_fmu: Make) -> None:
    run = FMU(make_fmu("body")).simulate(1.0, kind="CS", step=0.3)
    assert run.notes == ["communication steps are 0.333333333 s, as 0.3 s do not divide the run"]
    assert FMU(make_fmu("body")).simulate(1.0, kind="CS", step=0.1).notes == []


def test_steps_that_an_fmu_cannot_take(variant: Variant) -> None:
    own = 'canHandleVariableCommunicationStepSize="true"'
    fmu = variant("body", (own, 'fixedInternalStepSize="0.004"'), validate=False)
    assert fmu.simulate(1.0, kind="CS", step=0.02).time[-1] == 1.0
    with pytest.raises(FMUError, match=r"multiples of its own step of 0\.004 s, got 0\.01 s"):
        fmu.simulate(1.0, kind="CS", step=0.01)


def test_the_author_s_step_and_begin_are_used(variant: Variant) -> None:
    experiment = UNITS + '<DefaultExperiment startTime="5" stopTime="6" stepSize="0.25"/>'
    run = variant("body", (UNITS, experiment)).simulate(kind="CS", inputs={"F": lambda t: t})
    assert run.time.tolist() == [5.0, 5.25, 5.5, 5.75, 6.0]
    assert run["v"][-1] == pytest.approx((6**2 - 5**2) / 4)


def test_a_value_that_an_fmu_does_not_take_is_told(variant: Variant) -> None:
    """The ball's own instantiation is the only place that sets reference 7; it reads 0 whatever is given."""
    extra = (
        '<ScalarVariable name="x" valueReference="4" causality="parameter" variability="fixed">'
        '<Real start="0"/></ScalarVariable><ScalarVariable name="F"'
    )
    fmu = variant("spring", ('<ScalarVariable name="F"', extra))
    run = fmu.simulate(0.1, parameters={"x": 3.0, "k": 50.0})
    assert run.notes == ["'x' was set to 3.0, but the FMU says that it is 0.0"]


def test_an_end_that_an_fmu_asks_for_is_told_in_networks(make_fmu: Make) -> None:
    clock = FMU(make_fmu("clock"))
    net = Network("timed", mass=Mass(m=1.0), push=Force(), clock=FMUBlock(clock, inputs=[], outputs=["x"]))
    net.connect(net.clock.x, net.push.f)
    net.connect(net.push.flange, net.mass.flange)
    run = cosimulate(net, 2.0, communication_step=0.1, halving=False)
    assert run.time[-1] == 1.0
    assert run.notes == ["FMU 'clock': the FMU asked to end at t = 1 s, and so the run did"]
    system = SystemStructure(
        "pair", {"clock": clock, "relay": FMU(make_fmu("relay"))}, [Connection("clock.x", "relay.u")]
    )
    both = system.simulate(2.0, communication_step=0.1, halving=False, kind="ME")
    assert both.notes == run.notes


def test_numbers_that_are_none_are_refused_in_outputs(variant: Variant) -> None:
    fmu = variant("spring", ('<Real unit="N/m" start="100"/>', '<Real unit="N/m" start="100" max="1e309"/>'))
    with pytest.raises(FMUError, match="returned inf as a variable at t = 0 s"):
        fmu.simulate(0.1, inputs={"s": 1e200}, parameters={"k": 1e200})
