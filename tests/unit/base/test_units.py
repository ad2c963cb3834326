"""Units: what is read, what `g` means, what fits what, names and rates."""

from pathlib import Path

import inertance as ia
import pytest
from inertance.base import ModelError, rate_unit, unit_for, unit_of, units_like


@pytest.mark.parametrize(
    ("text", "si", "factor"),
    [
        ("kN/m", "N/m", 1e3),
        ("N/mm", "N/m", 1e3),
        ("km/h", "m/s", 1 / 3.6),
        ("rev/min", "rad/s", 0.10471975511965977),
        ("N/(m/s)", "N.s/m", 1.0),
        ("1/(m.s)", "1/(m.s)", 1.0),
        ("lbf.ft", "N.m", 4.4482216152605 * 0.3048),
        ("kNm", "N.m", 1e3),
        ("N m", "N.m", 1.0),
        ("N*m / rad", "N.m/rad", 1.0),
        ("kg·m²", "kg.m2", 1.0),
        ("m·s⁻²", "m/s2", 1.0),
        ("m/s**2", "m/s2", 1.0),
        ("m/s^2", "m/s2", 1.0),
        ("µm", "m", 1e-6),
        ("°/s", "rad/s", 0.017453292519943295),
        ("kg.m2.s-3.A-1", "V", 1.0),
        ("kJ", "J", 1e3),
        ("kHz", "Hz", 1e3),
        ("%", "1", 1e-2),
        ("", "1", 1.0),
    ],
)
def test_units_by_their_text(text: str, si: str, factor: float) -> None:
    unit = unit_of(text)
    assert (unit.si_name, unit.offset) == (si, 0.0)
    assert unit.factor == pytest.approx(factor, rel=1e-15)


@pytest.mark.parametrize(
    ("text", "wanted", "factor"),
    [
        ("g", "m/s2", 9.80665),
        ("g", "kg", 1e-3),
        ("mg", "m/s2", 9.80665e-3),
        ("mg", "kg", 1e-6),
        ("g.cm2", "kg.m2", 1e-7),
        ("g/s", "m/s3", 9.80665),
        ("g2/Hz", "m2/s3", 9.80665**2),
        ("kg", "kg", 1.0),
    ],
)
def test_the_dimension_that_is_wanted_decides_what_g_means(text: str, wanted: str, factor: float) -> None:
    assert unit_for(text, wanted).factor == pytest.approx(factor, rel=1e-12)


@pytest.mark.parametrize(
    ("text", "wanted", "told"),
    [
        ("g", "N", "'g' measures kg or m/s2, the quantity of the model is in N; give one of N, kN"),
        ("kg", "m/s2", "'kg' measures kg, the quantity of the model is in m/s2; give one of m/s2, mm/s2, g"),
        ("Hz", "rad/s", "'Hz' measures Hz, the quantity of the model is in rad/s"),
        ("rpm", "Hz", "'rpm' measures rad/s, the quantity of the model is in Hz"),
        ("mn", "m", "there is no unit 'mn'; did you mean 'mN'"),
        ("N/(m", "N/m", r"there is no unit 'N/\(m'; did you mean 'N/m'"),
        ("N)", "N", r"there is no unit 'N\)'"),
        ("m2s", "m", "there is no unit 'm2s'"),
        ("l/100km", "m", "there is no unit 'l/100km'; '100km' is not understood, write it by units such as"),
        ("//", "m", "there is no unit '//'"),
        ("mkg", "kg", "there is no unit 'mkg'"),
    ],
)
def test_what_is_no_unit_or_another_is_told(text: str, wanted: str, told: str) -> None:
    with pytest.raises(ModelError, match=told):
        unit_for(text, wanted)


def test_an_offset_counts_for_a_temperature_and_not_for_what_is_divided_by_one() -> None:
    assert unit_for("degC", "K").to_si(20.0) == pytest.approx(293.15)
    assert unit_for("°C", "K").from_si(293.15) == pytest.approx(20.0)
    assert unit_of("W/degC").offset == 0.0


def test_a_quantity_without_unit_takes_any() -> None:
    assert [unit_for(text, "").factor for text in ("mm", "%", "")] == [1.0, 1e-2, 1.0]


def test_units_that_measure_the_same() -> None:
    assert list(units_like(unit_of("min"))) == ["s", "ms", "us", "min"]
    assert units_like(unit_for("g", "m/s2"))["g"] == 9.80665
    assert units_like(unit_of("g"))["g"] == 1e-3


@pytest.mark.parametrize(
    ("unit", "rates"),
    [
        ("m", ["m/s", "m/s2", "m/s3"]),
        ("N.s/m", ["N/m", "N/(m.s)"]),
        ("kg.m2", ["kg.m2/s"]),
        ("N.m.s/rad", ["N.m/rad"]),
        ("s", ["1", "1/s"]),
        ("kg.m11/s10", ["kg.m11/s11"]),
        ("1", ["1/s"]),
        ("", ["", ""]),
        ("1/m^n", ["1/m^n/s", "1/m^n/s2"]),
    ],
)
def test_units_of_rates(unit: str, rates: list[str]) -> None:
    assert [rate_unit(unit, order) for order in range(1, len(rates) + 1)] == rates


def test_the_rate_of_a_speed_is_an_acceleration() -> None:
    net = ia.Network("free", mass=ia.Mass(m=1.0), push=ia.Force(f=1.0))
    run = net.connect(net.push.flange, net.mass.flange).simulate(0.1)
    assert (run.unit("der(mass.s)"), run.unit("der(mass.v)")) == ("m/s", "m/s2")
    assert ia.analysis.weighted_rms(run, "der(mass.v)") == ia.analysis.weighted_rms(run, "mass.a")


def test_the_comfort_of_a_table_in_g_is_that_in_si(tmp_path: Path) -> None:
    found = []
    for unit, size in (("g", 1.0), ("m/s2", 9.80665)):
        rows = "\n".join(f"{0.01 * k},{size * (k % 7)}" for k in range(200))
        (tmp_path / "run.csv").write_text(f"time,a [{unit}]\n{rows}\n")
        found.append(ia.analysis.weighted_rms(ia.Recorded(ia.load_table(tmp_path / "run.csv")), "a"))
    assert found[0] == pytest.approx(found[1])
