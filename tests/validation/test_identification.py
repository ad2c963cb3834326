"""Fits where they are hard: chaos, local minima, a closed loop, foreign vibration; honest standard errors."""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.identification import Campaign, Chirp, Fit, Multisine, Record
from inertance.machines import RandomDisplacement, Sinusoid
from scipy.signal import lfilter, welch


def recorded(
    net: ia.Network,
    truth: dict[str, float],
    drive: ia.Sampled,
    driven: str,
    seen: dict[str, tuple[str, float]],
) -> Record:
    """Return what a network with other parameters shows: channel -> (path, noise)."""
    step = float(drive.time[1])
    run = net.simulate(
        float(drive.time[-1]), step=step, inputs={driven: drive}, parameters=truth, rtol=1e-9, atol=1e-11
    )
    at = np.searchsorted(run.time, drive.time + 1e-3 * step, side="right") - 1
    rng = np.random.default_rng(0)
    values = {name: run[path][at] + rng.normal(0, noise, len(at)) for name, (path, noise) in seen.items()}
    return Record("run", drive.time, {"u": drive.values, **values})


def duffing() -> ia.Network:
    """Return Ueda's oscillator, x'' + d x' + k3 x^3 = f, chaotic for f = 7.5 cos t."""
    net = ia.Network("ueda", wall=ia.Fixed(), mass=ia.Mass(m=1.0), push=ia.Force())
    net.add(spring=ia.CubicSpring(k=0.0, k3=1.0), damper=ia.Damper(d=0.05))
    net.connect(net.wall.flange, net.spring.flange_a, net.damper.flange_a)
    return net.connect(net.spring.flange_b, net.damper.flange_b, net.mass.flange, net.push.flange)


TRUE_DUFFING = {"spring.k3": 1.08, "damper.d": 0.06}


@pytest.fixture(scope="module")
def chaos() -> Callable[..., Fit]:
    drive = ia.identification.sampled(Sinusoid(7.5, 1 / (2 * np.pi)), stop=45.0, rate=10.0)
    record = recorded(duffing(), TRUE_DUFFING, drive, "push.f", {"x": ("mass.s", 0.02)})

    def fitted(**entry: Any) -> Fit:
        campaign = Campaign(
            duffing(),
            channels={"u": {"input": "push.f", "unit": "N"}, "x": {"output": "mass.s", "unit": "m"}},
            parameters={"spring.k3": {"rel": 0.2}, "damper.d": {"rel": 0.5}},
            train=[{"record": record, **entry}],
            noise={"x": 0.02},
        )
        return ia.fit(campaign)

    return fitted


def test_multiple_shooting_follows_chaos_that_a_free_run_loses(chaos: Callable[..., Fit]) -> None:
    lost, found = chaos(), chaos(shooting=3.0)
    assert abs(lost.values["spring.k3"] - 1.08) > 0.02
    for name, true in TRUE_DUFFING.items():
        assert abs(found.values[name] - true) < 4 * found.errors[name]
        assert found.errors[name] < 0.03 * true


def resonator(k: float = 400.0) -> ia.Network:
    net = ia.Network("resonator", wall=ia.Fixed(), mass=ia.Mass(m=1.0), push=ia.Force())
    net.add(spring=ia.SpringDamper(k=k, d=0.4))
    net.connect(net.wall.flange, net.spring.flange_a)
    return net.connect(net.spring.flange_b, net.mass.flange, net.push.flange)


def test_a_multi_start_leaves_a_local_minimum() -> None:
    drive = ia.identification.sampled(Chirp(1.0, 1.0, 8.0, 3.0), stop=3.0, rate=100.0)
    record = recorded(resonator(), {"spring.k": 1300.0}, drive, "push.f", {"x": ("mass.s", 1e-5)})
    campaign = Campaign(
        resonator(),
        channels={"u": {"input": "push.f", "unit": "N"}, "x": {"output": "mass.s", "unit": "m"}},
        parameters={"spring.k": {"min": 100.0, "max": 2500.0}},
        train=[{"record": record, "initial": "rest"}],
        noise={"x": 1e-5},
    )
    assert abs(ia.fit(campaign).values["spring.k"] - 1300.0) > 100.0
    with ThreadPoolExecutor(1) as executor:
        found = ia.fit(campaign, starts=8, executor=executor)
    assert len(found.starts) == 8
    assert abs(found.values["spring.k"] - 1300.0) < 4 * found.errors["spring.k"]


def servo() -> ia.Network:
    """Return a mass that a PD loop holds to a reference: force = kp (reference - s) - kd v."""
    net = ia.Network("servo", bed=ia.Fixed(), mass=ia.Mass(m=2.0), motor=ia.Force(), viscous=ia.Damper(d=5.0))
    net.add(position=ia.PositionSensor(), speed=ia.SpeedSensor())
    net.add(error=ia.signals.Add(k1=900.0, k2=-900.0), law=ia.signals.Add(k2=-40.0))
    net.connect(net.bed.flange, net.viscous.flange_a)
    net.connect(
        net.viscous.flange_b, net.mass.flange, net.motor.flange, net.position.flange, net.speed.flange
    )
    net.connect(net.position.s, net.error.u2).connect(net.error.y, net.law.u1).connect(
        net.speed.v, net.law.u2
    )
    return net.connect(net.law.y, net.motor.f)


def test_a_machine_in_a_closed_loop_is_fitted_with_its_controller() -> None:
    truth = {"mass.m": 2.3, "viscous.d": 8.0}
    drive = ia.identification.sampled(
        Multisine(rms=0.01, low=0.5, high=8.0, period=3.0), stop=3.0, rate=200.0, fade=0.5
    )
    record = recorded(servo(), truth, drive, "error.u1", {"x": ("mass.s", 1e-5), "F": ("law.y", 0.02)})
    campaign = Campaign(
        servo(),
        channels={"u": {"input": "error.u1"}, "x": {"output": "mass.s"}, "F": {"output": "law.y"}},
        parameters={"mass.m": {"rel": 0.3}, "viscous.d": {"rel": 0.6}},
        train=[{"record": record, "initial": "rest"}],
        noise={"x": 1e-5, "F": 0.02},
    )
    found = ia.fit(campaign)
    for name, true in truth.items():
        assert abs(found.values[name] - true) < 4 * found.errors[name]
        assert found.errors[name] < 0.01 * true


def test_a_filter_on_both_sides_keeps_out_what_the_model_does_not_hold() -> None:
    drive = ia.identification.sampled(
        Multisine(rms=2.0, low=0.5, high=6.0, period=4.0), stop=4.0, rate=200.0, fade=0.5
    )
    record = recorded(resonator(), {"spring.k": 430.0}, drive, "push.f", {"x": ("mass.s", 1e-5)})
    record.values["x"] += 2e-3 * np.sin(2 * np.pi * 50.0 * drive.time)
    entries: dict[str, Any] = {
        "channels": {"u": {"input": "push.f"}, "x": {"output": "mass.s"}},
        "parameters": {"spring.k": {"rel": 0.2}, "spring.d": {"rel": 0.5}},
        "train": [{"record": record, "initial": "rest"}],
        "noise": {"x": 1e-5},
    }
    raw = ia.fit(Campaign(resonator(), **entries))
    clean = ia.fit(Campaign(resonator(), **entries, stage=[{"filter": {"cutoff": 10.0, "order": 6}}]))
    assert clean.stages[0].optimum.cost < 1e-3 * raw.stages[0].optimum.cost
    assert abs(clean.values["spring.k"] - 430.0) < 4 * clean.errors["spring.k"] < 0.1


NOISES = {
    "white noise": lambda draw, count: draw.normal(0, 2e-4, count),
    "coloured noise": lambda draw, count: lfilter([6e-5], [1.0, -0.95], draw.normal(size=count + 200))[200:],
}


@pytest.mark.parametrize("kind", NOISES)
def test_standard_errors_are_as_large_as_the_scatter(kind: str) -> None:
    truth = {"spring.k": 430.0, "spring.d": 0.5}
    drive = ia.identification.sampled(
        Multisine(rms=2.0, low=0.5, high=6.0, period=4.0), stop=4.0, rate=100.0, fade=0.5
    )
    exact = recorded(resonator(), truth, drive, "push.f", {"x": ("mass.s", 0.0)})
    scores = []
    for seed in range(12):
        noise = NOISES[kind](np.random.default_rng(seed), len(drive.time))
        record = Record("run", drive.time, {"u": drive.values, "x": exact.values["x"] + noise})
        campaign = Campaign(
            resonator(),
            channels={"u": {"input": "push.f"}, "x": {"output": "mass.s"}},
            parameters={"spring.k": {"rel": 1.0}, "spring.d": {"rel": 3.0}},
            train=[{"record": record, "initial": "rest"}],
            noise={"x": 2e-4},
        )
        found = ia.fit(campaign)
        scores.append([(found.values[name] - true) / found.errors[name] for name, true in truth.items()])
    spread = np.sqrt(np.mean(np.square(scores), axis=0))
    assert (spread > 0.6).all()
    assert (spread < 1.5).all()


def hardening() -> ia.Network:
    net = ia.Network("hardening", wall=ia.Fixed(), mass=ia.Mass(m=2.0), push=ia.Force())
    net.add(spring=ia.CubicSpring(k=1000.0, k3=4e5), damper=ia.Damper(d=6.0))
    net.connect(net.wall.flange, net.spring.flange_a, net.damper.flange_a)
    return net.connect(net.spring.flange_b, net.damper.flange_b, net.mass.flange, net.push.flange)


def test_standard_errors_know_of_a_force_that_nobody_measured() -> None:
    """It rings where the machine is far out and soft or stiff: what is left goes with the slopes."""
    truth = {"spring.k": 1080.0, "spring.k3": 4.4e5, "damper.d": 5.4}
    scores = []
    for seed in range(8):
        draw, records = np.random.default_rng(seed), list[dict[str, Record]]()
        for _ in range(3):
            motion = Multisine(rms=12.0, low=0.5, high=8.0, period=12.0, seed=int(draw.integers(1000)))
            drive = ia.identification.sampled(motion, stop=12.0, rate=100.0, fade=0.5)
            forgetting = lfilter([0.7], [1.0, -0.7], draw.normal(size=len(drive.time)))
            unknown = 0.15 * np.asarray(forgetting, dtype=float)
            shaken = ia.Sampled(drive.time, drive.values + unknown)
            x = recorded(hardening(), truth, shaken, "push.f", {"x": ("mass.s", 1e-5)}).values["x"]
            records.append({"record": Record(f"run {len(records)}", drive.time, {"u": drive.values, "x": x})})
        channels = {"u": {"input": "push.f"}, "x": {"output": "mass.s"}}
        asked = {path: {"min": 0.2 * value, "max": 5.0 * value} for path, value in truth.items()}
        found = ia.fit(Campaign(hardening(), channels, asked, records, noise={"x": 1e-4}))
        scores.append([(found.values[name] - true) / found.errors[name] for name, true in truth.items()])
    spread = np.sqrt(np.mean(np.square(scores), axis=0))
    assert (spread > 0.5).all()
    assert (spread < 1.7).all()


def test_the_random_displacement_has_the_spectrum_of_the_source() -> None:
    drive = ia.identification.sampled(RandomDisplacement(seed=3, period=40.0), stop=40.0, rate=200.0)
    f, density = (np.asarray(v, dtype=float) for v in welch(drive.values[:-1], 200.0, nperseg=1600))
    inside = (f > 0.8) & (f < 14.5)
    assert np.mean(density[inside] * f[inside] ** 2) == pytest.approx(6.4e-6, rel=0.15)
    assert (density[f > 17] * f[f > 17] ** 2).max() < 1e-3 * 6.4e-6


def test_a_chirp_sweeps_evenly_from_low_to_high() -> None:
    values = ia.identification.sampled(Chirp(2.0, 1.0, 9.0, 8.0), stop=8.0, rate=1000.0).values
    rises = np.flatnonzero((values[:-1] < 0) & (values[1:] >= 0)) / 1000.0
    middles, rates = 0.5 * (rises[1:] + rises[:-1]), 1 / np.diff(rises)
    assert rates == pytest.approx(1.0 + middles, rel=0.03)
    assert np.abs(values).max() == pytest.approx(2.0, rel=1e-3)
