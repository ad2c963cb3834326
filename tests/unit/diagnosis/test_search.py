"""The verdict on a small rig whose cause is known: friction, wrong parameters, nothing, a slow sensor."""

import json
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.diagnosis import Verdict, diagnose
from inertance.identification import Campaign, Multisine, Record, sampled
from numpy.typing import NDArray

Array = NDArray[np.float64]

RATE, DURATION, NOISE = 250.0, 6.0, 2e-5


def rig(**changed: float) -> ia.Network:
    values = {"m": 2.0, "k": 800.0, "d": 6.0} | changed
    net = ia.Network(
        "rig",
        wall=ia.Fixed(),
        spring=ia.Spring(k=values["k"]),
        guide=ia.Damper(d=values["d"]),
        carriage=ia.Mass(m=values["m"]),
        push=ia.Force(),
    )
    net.connect(net.wall.flange, net.spring.flange_a, net.guide.flange_a)
    return net.connect(net.carriage.flange, net.spring.flange_b, net.guide.flange_b, net.push.flange)


def rubbing() -> ia.Network:
    net = rig(k=820.0)
    net.add(rail=ia.CoulombFriction(f_c=0.8)).connect(net.wall.flange, net.rail.flange_a)
    return net.connect(net.rail.flange_b, net.carriage.flange)


def measured(truth: ia.Network, seed: int, sensor: Callable[[Array], Array] | None = None) -> Record:
    """Return what an instrument with noise would record of a machine under a random force."""
    drive = sampled(
        Multisine(rms=5.0, low=0.5, high=8.0, period=DURATION, seed=seed), DURATION, RATE, fade=0.5
    )
    run = truth.simulate(DURATION, inputs={"push.f": drive}, step=1 / RATE, rtol=1e-8, atol=1e-11)
    s = run["carriage.s"][np.searchsorted(run.time, drive.time + 1e-6, side="right") - 1]
    noise = NOISE * np.random.default_rng(seed).standard_normal(len(s))
    return Record(f"run {seed}", drive.time, {"F": drive.values, "s": (sensor(s) if sensor else s) + noise})


def verdict_on(truth: ia.Network, sensor: Callable[[Array], Array] | None = None, **more: Any) -> Verdict:
    """Return the verdict on records of a truth, held against the nominal rig."""
    records = [measured(truth, seed, sensor) for seed in (1, 2, 3)]
    campaign = Campaign(
        rig(),
        channels={"F": {"input": "push.f", "unit": "N"}, "s": {"output": "carriage.s", "unit": "m"}},
        parameters={path: {"rel": 0.1} for path in ("spring.k", "guide.d")},
        train=[{"record": record, "initial": "rest"} for record in records[:2]],
        test=[{"record": records[2], "initial": "rest"}],
        noise={"s": NOISE},
    )
    return diagnose(campaign, **more)


def test_missing_friction_is_named_and_corrected(tmp_path: Path) -> None:
    told: list[str] = []
    found = verdict_on(rubbing(), report=told.append)
    assert found.verdict == "effect"
    (placed,) = found.effects
    assert (placed.effect.kind, placed.site.path) == ("coulomb_friction", "guide")
    assert placed.values["f_c"] == pytest.approx(0.8, rel=0.02)
    assert found.parameters["spring.k"] == pytest.approx(820.0, rel=5e-3)
    assert found.closed > 0.95
    assert found.confidence[0] > 0.9
    assert any("screening" in line for line in told)
    scope = {"net": rig(), **vars(ia)}
    exec("\n".join(found.lines), scope)
    push = {"push.f": lambda t: 5 * np.sin(9 * t)}
    same = scope["net"].simulate(1.0, inputs=push)
    assert found.corrected().simulate(1.0, inputs=push)["carriage.s"] == pytest.approx(same["carriage.s"])
    saved = json.loads(found.save(tmp_path / "gap.json").read_text())
    assert saved["effects"][0]["kind"] == "coulomb_friction"
    assert {"verdict", "equivalent", "next_experiment", "where", "ranking", "gap", "closed"} <= saved.keys()


MODEL = """
import inertance as ia

def build():
    net = ia.Network("rig", wall=ia.Fixed(), spring=ia.Spring(k=800.0), guide=ia.Damper(d=6.0),
                     carriage=ia.Mass(m=2.0), push=ia.Force())
    net.connect(net.wall.flange, net.spring.flange_a, net.guide.flange_a)
    return net.connect(net.carriage.flange, net.spring.flange_b, net.guide.flange_b, net.push.flange)
"""
CAMPAIGN = """
model = "rig.py:build"
channels = { F = { input = "push.f", unit = "N" }, s = { output = "carriage.s", unit = "m" } }
parameters = { "spring.k" = { rel = 0.1 }, "guide.d" = { rel = 0.1 } }
train = [{ file = "run_1.npz", initial = "rest" }]
test = [{ file = "run_2.npz", initial = "rest" }]
noise = { s = 2e-5 }
"""


def test_other_processes_see_the_same_records(tmp_path: Path) -> None:
    for seed in (1, 2):
        record = measured(rubbing(), seed)
        time = np.arange(4 * len(record.time) - 3) / (4 * RATE)
        F, x = (np.interp(time, record.time, record.values[name]) for name in ("F", "s"))
        np.savez(tmp_path / f"run_{seed}.npz", time=time, F=F, s=x)
    (tmp_path / "rig.py").write_text(MODEL)
    (tmp_path / "campaign.toml").write_text(CAMPAIGN)
    alone = diagnose(Campaign.load(tmp_path / "campaign.toml"))
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        together = diagnose(Campaign.load(tmp_path / "campaign.toml"), executor=pool)
    assert together.gap["s"].after == pytest.approx(alone.gap["s"].after)
    assert [r.test_gain for r in together.ranking] == pytest.approx([r.test_gain for r in alone.ranking])


def test_wrong_parameters_are_no_effect() -> None:
    found = verdict_on(rig(k=980.0, d=9.0))
    assert found.verdict == "parameters"
    assert found.effects == ()
    assert found.parameters["spring.k"] == pytest.approx(980.0, rel=5e-3)


def test_nothing_is_missing() -> None:
    assert verdict_on(rig()).verdict == "none"


def test_a_sensor_that_is_late() -> None:
    found = verdict_on(
        rig(), sensor=lambda s: np.interp(np.arange(len(s)) / RATE - 0.006, np.arange(len(s)) / RATE, s)
    )
    (placed,) = found.effects
    assert (placed.effect.kind, placed.site.path) == ("sensor_delay", "s")
    assert placed.values["delay"] == pytest.approx(0.006, rel=0.05)
