"""Figures in the sentences and tables of README and docs/ are what the functions they speak of return."""

from __future__ import annotations

import importlib.util
import re
from collections import Counter
from functools import cache
from math import pi, sqrt
from pathlib import Path
from types import ModuleType
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.cli import demo_runs
from inertance.machines import ge_wang
from matplotlib import pyplot

ROOT = Path(__file__).parents[2]
ROW = re.compile(r"^\| (none|ideal|disk|planetary)[^|]*\|(.*)\|$", re.MULTILINE)
BLOCK = re.compile(r"^```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def page(name: str) -> str:
    return (ROOT / name).read_text(encoding="utf-8")


@cache
def gallery() -> ModuleType:
    pyplot.switch_backend("Agg")
    spec = importlib.util.spec_from_file_location("make_gallery", ROOT / "docs" / "make_gallery.py")
    assert spec
    assert spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def table() -> dict[str, list[str]]:
    """Return the cells of each row of the gallery's table of inerters."""
    return {
        found[1]: [cell.strip() for cell in found[2].split("|")]
        for found in ROW.finditer(page("docs/gallery.md"))
    }


def told(name: str, sentence: str) -> list[float]:
    """Return the numbers of a sentence, each written as # here; words are apart by any white space."""
    pattern = re.escape(sentence).replace(r"\#", r"([0-9][0-9.e+-]*[0-9]|[0-9])").replace(r"\ ", r"\s+")
    found = re.findall(pattern, page(name))
    assert len(found) == 1, f"{name}: {sentence!r} stands there {len(found)} times"
    return [float(number) for number in ([found[0]] if isinstance(found[0], str) else found[0])]


def test_real_inerters_keep_what_the_gallery_says() -> None:
    """Columns A and D of the table, and the shares in the sentence above it."""
    g, rows = gallery(), table()
    bare = [g.bare_car(road) for road in "AD"]
    cars = {name: [g.inerter_car(name, road) for road in "AD"] for name in g.INERTERS}
    for name, found in {"none": bare, **cars}.items():
        assert [rows[name][0], rows[name][3]] == [f"{value:.3f}" for value in found]
    assert g.KEPT.search(page("docs/gallery.md"))[0] == g.shares_kept(bare, cars)
    assert cars["ideal"] < cars["disk"] < cars["planetary"]


def test_a_real_tid_keeps_what_the_gallery_says() -> None:
    g, rows = gallery(), table()
    for name, force, column in (("disk", 30e3, -1), ("ideal", 300.0, -3), ("disk", 300.0, -3)):
        ratio = g.real_tid(g.INERTERS[name](), force) / g.real_tid(None, force)
        assert rows[name][column] == f"{ratio:.3f}"


def test_the_smallest_inertance_of_the_ranking_costs_a_thousandth() -> None:
    (kg, percent) = told("docs/gallery.md", "are searched from # kg, which costs S3 # % of J3")
    assert kg == gallery().RANGES["b"][0]
    least = {}
    for layout in ("S1", "S3"):
        car = ia.machines.quarter_car(ia.machines.suspension(layout, 10e3, d=2e3, b=kg)).dae()
        (damper,) = (n for n in car.parameter_values if n.startswith("strut.rest") and n.endswith(".d"))
        least[layout] = ia.analysis.tune(car, ia.analysis.tyre_j3, {damper: (50.0, 30e3)}, starts=1).value
    assert 100 * (least["S3"] / least["S1"] - 1) == pytest.approx(percent, abs=0.05)


def test_the_gains_of_both_inerters() -> None:
    responses = demo_runs.random_tests()
    (more,) = told("docs/machines.md", "the planetary one has some # % more gain below 1 Hz")
    (within,) = told("docs/machines.md", "above 5 Hz both agree within # %")
    assert round(100 * (responses.ratio[responses.f < 1].mean() - 1)) == more
    assert 0.5 * within < 100 * abs(responses.ratio[responses.f > 5] - 1).max() < within


def test_the_struts_of_the_readme() -> None:
    names: dict[str, Any] = {}
    exec(BLOCK.findall(page("README.md"))[0], names)
    (k, d) = told("README.md", "With `SpringDamper(k=#e3, d=#)` instead, the damper that is best for ride")
    assert d == round(ia.analysis.quarter_car_damping(1e3 * k, 250.0, 35.0, 150e3))
    strut = ia.SpringDamper(k=1e3 * k, d=d)
    car = ia.Network(
        "car", road=ia.Position(), tyre=ia.Spring(k=150e3), wheel=ia.Mass(m=35.0), strut=strut,
        body=ia.Mass(m=250.0),
    )  # fmt: skip
    car.connect(car.road.flange, car.tyre.flange_a)
    car.connect(car.tyre.flange_b, car.wheel.flange, car.strut.flange_a)
    car.connect(car.strut.flange_b, car.body.flange)
    run = car.simulate(3.0, inputs={"road.s_ref": names["bump"]})
    found = [round(run.peak("body.a"), 2), round(run.peak("tyre.f"))]
    assert told("README.md", "[# m/s2 and # N]") == found


def test_the_prototype() -> None:
    """Its masses, gains and resonance in README.md and machines.md."""
    assert told("README.md", "two inerters of # kg") == [round(ge_wang.B)]
    assert told("README.md", "stiffness, at # Hz") == [round(sqrt(ge_wang.SCREW["k"] / ge_wang.B) / (2 * pi))]
    mass = ge_wang.M_BRACKET + 4 * ge_wang.M_PLANET
    masses = told("docs/machines.md", "The paper compares the prototype's # kg with a disk")
    assert masses == [round(mass, 3)]
    assert told("docs/machines.md", "that weighs # kg: # % saved") == [
        ge_wang.M_DISK, round(100 * (1 - mass / ge_wang.M_DISK), 1)
    ]  # fmt: skip
    assert told("docs/machines.md", "with that inertia weighs # kg") == [
        round(ia.machines.disk_mass(ge_wang.J_E, R=0.050), 3)
    ]
    assert told("docs/machines.md", "`gain`, # for the prototype") == [round(float(ge_wang.GEOMETRY.gain), 2)]
    friction = ge_wang.FRICTION
    assert told("docs/machines.md", "from T_s = # N.m to T_c = # N.m") == [
        friction["tau_s"], friction["tau_c"]
    ]  # fmt: skip
    assert told("docs/machines.md", "prints a Stribeck speed of # rad/s") == [friction["w_s"]]
    (force,) = told("docs/gallery.md", "(# N hold the screw)")
    assert force == round(2 * pi * friction["tau_s"] / ge_wang.LEAD)


def test_the_networks_of_random_biquadratics() -> None:
    rng, count = np.random.default_rng(0), Counter[tuple[int, int]]()
    span = told("docs/synthesis.md", "with coefficients from # to #, uniform in their logarithms")
    assert span == pytest.approx([10**-1.2, 10**1.2], rel=5e-3)
    while count.total() < 500:
        b, c, e, f = 10 ** rng.uniform(-1.2, 1.2, 4)
        if sqrt(b * e) >= abs(sqrt(c) - sqrt(f)) and not regular(b, c, e, f) and not regular(e, f, b, c):
            parts = elements(ia.synthesis.synthesise(([1.0, b, c], [1.0, e, f])))
            count[len(parts), sum(not isinstance(part, ia.Damper) for part in parts)] += 1
    cells = re.findall(r"^\| (\d) \| (\d) \|.*\| (\d+) \|$", page("docs/synthesis.md"), re.MULTILINE)
    assert {(int(n), int(reactive)): int(found) for n, reactive, found in cells} == dict(count)


def regular(b: float, c: float, e: float, f: float) -> bool:
    """Tell whether Re Y is least at 0 or infinity, Y = (s^2 + b s + c)/(s^2 + e s + f)."""
    x = np.logspace(-6, 6, 4001)
    real = ((c - x) * (f - x) + b * e * x) / ((f - x) ** 2 + e**2 * x)
    return bool(real.min() >= min(1.0, c / f) * (1 - 1e-9))


def elements(component: Any) -> list[Any]:
    parts = component._parts.values()
    return [element for part in parts for element in elements(part)] if parts else [component]
