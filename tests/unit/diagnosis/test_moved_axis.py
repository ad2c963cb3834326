"""An axis that is moved, whose force is measured: what laws of its own, not the library's, make of it."""

from collections.abc import Callable

import inertance as ia
import numpy as np
import pytest
from inertance.diagnosis import Verdict
from inertance.identification import Campaign, Multisine, Record, sampled
from numpy.typing import NDArray

Array = NDArray[np.float64]
Law = Callable[[Array, Array], Array]
PARAMETERS = {"table.m": {"rel": 0.1}, "oil.d": {"rel": 0.5}}


def axis() -> ia.Network:
    net = ia.Network(
        "axis",
        drive=ia.Position(),
        cell=ia.ForceSensor(),
        table=ia.Mass(m=20.0),
        oil=ia.Damper(d=150.0),
        bed=ia.Fixed(),
    )
    net.connect(net.drive.flange, net.cell.flange_a)
    net.connect(net.cell.flange_b, net.table.flange, net.oil.flange_b)
    return net.connect(net.oil.flange_a, net.bed.flange)


def recorded(seed: int, law: Law, highest: float) -> Record:
    """Return a record whose force also has that of a law of distance and speed, and noise of 0.1 N."""
    moved = sampled(Multisine(rms=0.04, low=0.1, high=highest, period=6.0, seed=seed), stop=6.0, rate=125.0)
    t, s = moved.time, moved.values
    v = np.gradient(s, t)
    force = 20 * np.gradient(v, t) + 150 * v + law(s + 0.3, v)
    noise = 0.1 * np.random.default_rng(seed).standard_normal(len(t))
    inside = slice(12, -12)
    return Record(f"run {seed}", t[inside], {"s": (s + 0.3)[inside], "F": (force + noise)[inside]})


def verdict_on(law: Law, highest: float = 2.0, known: tuple[str, ...] = ()) -> Verdict:
    return ia.diagnose(
        Campaign(
            axis(),
            channels={"s": {"input": "drive.s_ref", "unit": "m"}, "F": {"output": "cell.f", "unit": "N"}},
            parameters={n: p for n, p in PARAMETERS.items() if n not in known},
            train=[{"record": recorded(1, law, highest)}],
            test=[{"record": recorded(2, law, highest)}],
            noise={"F": 0.1},
        )
    )


def test_oil_that_thins_is_named() -> None:
    verdict = verdict_on(lambda s, v: 2.0 * np.log(v / 0.03 + np.sqrt(1 + (v / 0.03) ** 2)))
    (placed,) = verdict.effects
    assert (verdict.verdict, placed.effect.kind) == ("effect", "shear_thinning_damping")
    assert abs(placed.values["v_e"] / 0.03 - 1) < 0.1
    assert abs(placed.values["d"] * 0.03 / 2.0 - 1) < 0.1


@pytest.mark.parametrize("law", [lambda s, v: 20 * v, lambda s, v: 2.0 * np.sign(v)])
def test_what_is_simpler_is_not_taken_for_oil_that_thins(law: Law) -> None:
    verdict = verdict_on(law, known=("oil.d",))
    named = {placed.effect.kind for placed in verdict.effects} | {kind for kind, _ in verdict.equivalent}
    assert verdict.verdict in ("effect", "ambiguous")
    assert "shear_thinning_damping" not in named


def test_a_ripple_of_many_periods_is_named() -> None:
    verdict = verdict_on(lambda s, v: 0.5 * np.sin(2 * np.pi * s / 0.0019 + 1.0), highest=0.3)
    (placed,) = verdict.effects
    assert (verdict.verdict, placed.effect.kind) == ("effect", "position_ripple")
    assert abs(placed.values["period"] / 0.0019 - 1) < 1e-3
    assert abs(np.hypot(placed.values["f_sin"], placed.values["f_cos"]) / 0.5 - 1) < 0.1
