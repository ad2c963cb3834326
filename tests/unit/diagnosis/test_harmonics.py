"""A ripple of few periods whose overtones are as strong: the strongest alone tells another period."""

from __future__ import annotations

import inertance as ia
import numpy as np
import pytest
from inertance.diagnosis import diagnose
from inertance.identification import Campaign, Multisine, Record, sampled

RATE, DURATION, NOISE, PERIOD = 250.0, 8.0, 0.02, 0.026
CHANNELS = {"x": {"input": "actuator.s_ref", "unit": "m"}, "F": {"output": "cell.f", "unit": "N"}}


def bench(**waves: float) -> ia.Network:
    net = ia.Network(
        "bench",
        frame=ia.Fixed(),
        specimen=ia.SpringDamper(k=2.0e3, d=50.0),
        slider=ia.Mass(m=0.5),
        cell=ia.ForceSensor(),
        actuator=ia.Position(),
    )
    net.connect(net.actuator.flange, net.cell.flange_a)
    net.connect(net.cell.flange_b, net.slider.flange, net.specimen.flange_b)
    net.connect(net.frame.flange, net.specimen.flange_a)
    if waves:
        net.add(ripple=ia.HarmonicRipple(period=PERIOD, **waves))
        net.connect(net.frame.flange, net.ripple.flange_a)
        net.connect(net.slider.flange, net.ripple.flange_b)
    return net


def record(net: ia.Network, seed: int) -> Record:
    motion = Multisine(rms=0.02, low=0.1, high=1.5, period=DURATION, seed=seed)
    drive = sampled(motion, DURATION, RATE, fade=0.5)
    run = net.simulate(DURATION, inputs={"actuator.s_ref": drive}, step=1 / RATE)
    noise = NOISE * np.random.default_rng(seed).standard_normal(len(drive.time))
    return Record(f"run {seed}", drive.time, {"x": drive.values, "F": run["cell.f"] + noise})


@pytest.mark.parametrize(
    "waves",
    [
        {"f_sin": 0.9, "f_cos": -1.0, "f_sin_2": -1.2, "f_cos_2": -0.9, "f_cos_3": 1.0},
        {"f_sin": 0.8, "f_sin_2": 0.3, "f_cos_3": -1.3},
        {"f_sin": 0.09, "f_sin_2": 1.2},
    ],
    ids=["second", "third", "weak first"],
)
def test_the_period_of_the_first_wave_is_found_though_another_is_stronger(waves: dict[str, float]) -> None:
    records = [{"record": record(bench(**waves), seed)} for seed in (1, 2, 3)]
    priors = {"specimen.k": {"rel": 0.05}, "specimen.d": {"rel": 0.2}}
    found = diagnose(Campaign(bench(), CHANNELS, priors, records[:2], records[2:], noise={"F": NOISE}))
    assert [placed.label for placed in found.effects] == ["harmonic_ripple at specimen"]
    values = found.effects[0].values
    assert values["period"] == pytest.approx(PERIOD, rel=1e-3)
    assert {name: values[name] for name in waves} == pytest.approx(waves, abs=0.05)
    assert found.closed == pytest.approx(1.0, abs=0.01)
