"""What a fit says of itself: misfit, priors, units, signs, noise and records that make it doubtful."""

import json
from functools import cache
from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.identification import (
    Campaign,
    CampaignModel,
    Fit,
    Multisine,
    Optimum,
    Prior,
    Record,
    uncertainty,
)
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline

Array = NDArray[np.float64]
RATE, LENGTH, NOISE = 100.0, 5.0, 2e-5
TRUTH = {"spring.k": 440.0, "spring.d": 6.0}
CHANNELS = {"F": {"input": "push.f", "unit": "N"}, "x": {"output": "mass.s", "unit": "m"}}
PRIORS = {"spring.k": {"rel": 0.2}, "spring.d": {"rel": 0.5}}


def model() -> ia.Network:
    net = ia.Network("rig", push=ia.Force(), mass=ia.Mass(m=2.0), wall=ia.Fixed())
    net.add(spring=ia.SpringDamper(k=350.0, d=4.0)).connect(net.wall.flange, net.spring.flange_a)
    return net.connect(net.spring.flange_b, net.mass.flange, net.push.flange)


@cache
def moved(seed: int, k: float, k3: float) -> tuple[Array, Array, Array]:
    """Return time, force and motion of the rig, computed by SciPy."""
    rng = np.random.default_rng(seed)
    t = np.arange(int(RATE * LENGTH) + 1) / RATE
    lines = np.arange(0.4, 5.0, 0.2)
    phases = rng.uniform(0, 2 * np.pi, len(lines))
    force = np.sum([np.cos(2 * np.pi * f * t + p) for f, p in zip(lines, phases, strict=True)], axis=0)
    force *= 8.0 / force.std()
    given = CubicSpline(t, force)

    def rates(at: float, y: Array) -> list[float]:
        return [y[1], (float(given(at)) - k * y[0] - 6.0 * y[1] - k3 * y[0] ** 3) / 2.0]

    run = solve_ivp(rates, (0, t[-1]), [0.01, 0.1], t_eval=t, rtol=1e-8, atol=1e-10, max_step=1e-2)
    return t, force, run.y[0] + NOISE * rng.normal(size=len(t))


def measured(
    seed: int, *, k: float = 440.0, k3: float = 0.0, times: dict[str, float] | None = None
) -> Record:
    """Return a record of the rig; `times` multiplies columns."""
    t, force, motion = moved(seed, k, k3)
    columns = {"F": force, "x": motion}
    return Record(f"run {seed}", t, {n: v * (times or {}).get(n, 1.0) for n, v in columns.items()})


def fitted(*, priors: Any = None, channels: Any = None, entries: Any = None, **how: Any) -> Fit:
    campaign = Campaign(
        model(), channels or CHANNELS, priors or PRIORS,
        train=[{"record": measured(1, **how)}], test=[{"record": measured(2, **how)}], **(entries or {}),
    )  # fmt: skip
    return ia.fit(campaign)


def told(fit: Fit, *words: str) -> bool:
    return any(all(word in warning for word in words) for warning in fit.warnings)


def test_a_sound_fit_is_doubted_in_nothing() -> None:
    found = fitted()
    assert not found.warnings
    assert not found.suspects
    for name, true in TRUTH.items():
        assert found.values[name] == pytest.approx(true, abs=4 * found.errors[name])


def test_a_residual_far_above_noise_is_told_and_points_to_the_diagnosis() -> None:
    found = fitted(k3=2e6)
    left = found.comparisons[1].rms("x", found.comparisons[1].after) / found.campaign.sigma["x"]
    assert left > 30
    assert told(found, "x: the fit leaves", "times the noise", f"{left:.3g} times on the test records")
    assert told(found, "standard errors are those of scatter", "inertance diagnose")
    assert "warning: x: the fit leaves" in found.table()
    assert not found.suspects


@pytest.mark.parametrize(
    ("times", "said"),
    [
        ({"x": 1e3}, "x is likely in mm, not in m"),
        ({"F": 1e-3}, "F is likely in kN, not in N"),
        ({"F": 1 / 9.80665}, "F is likely in kgf, not in N"),
        ({"F": -1.0}, "the sign of F is likely wrong"),
    ],
)
def test_a_channel_in_another_unit_or_of_another_sign_is_named(times: dict[str, float], said: str) -> None:
    assert told(fitted(times=times), said, "then the same model would leave")


def test_a_wrong_unit_that_parameters_have_swallowed_is_named_too() -> None:
    wide = {name: {"rel": 0.5} for name in ("spring.k", "spring.d", "mass.m")}
    found = fitted(times={"F": 1e3}, priors=wide)
    assert found.values["spring.k"] > 100 * TRUTH["spring.k"]
    assert told(found, "F is likely in mN, not in N")
    assert told(found, "spring.k", "times what was assumed")


def test_a_unit_is_named_as_the_campaign_of_files_has_it(tmp_path: Path) -> None:
    for number in (1, 2):
        run = measured(number)
        table = np.column_stack([run.time, run.values["F"], run.values["x"]])
        np.savetxt(tmp_path / f"{number}.csv", table, delimiter=",", header="time,F,x", comments="")
    (tmp_path / "rig.py").write_text(
        "from inertance import Fixed, Force, Mass, Network, SpringDamper\n"
        "def build():\n"
        "    net = Network('rig', push=Force(), mass=Mass(m=2.0), wall=Fixed())\n"
        "    net.add(spring=SpringDamper(k=350.0, d=4.0)).connect(net.wall.flange, net.spring.flange_a)\n"
        "    return net.connect(net.spring.flange_b, net.mass.flange, net.push.flange)\n"
    )
    (tmp_path / "c.toml").write_text(
        'model = "rig.py:build"\n[channels]\nF = { input = "push.f", unit = "N" }\n'
        'x = { output = "mass.s", unit = "mm" }\n[parameters]\n"spring.k" = { rel = 0.2 }\n'
        '"spring.d" = { rel = 0.5 }\n[[train]]\nfile = "1.csv"\n[[test]]\nfile = "2.csv"\n'
    )
    found = ia.fit(Campaign.load(tmp_path / "c.toml"))
    assert told(found, "x is likely in m, not in mm")
    stored = json.loads(found.to_json(tmp_path / "fit.json").read_text())
    assert stored["suspects"][0]["told"]
    assert stored["records"][0]["over_noise"] > 100
    assert stored["parameters"]["spring.k"]["prior_deviations"] > 3


def test_outputs_that_are_exchanged_are_named() -> None:
    net = ia.Network("chain", push=ia.Force(), one=ia.Mass(m=2.0), two=ia.Mass(m=1.0), wall=ia.Fixed())
    net.add(a=ia.SpringDamper(k=300.0, d=4.0), b=ia.SpringDamper(k=100.0, d=2.0))
    net.connect(net.wall.flange, net.a.flange_a).connect(net.a.flange_b, net.one.flange, net.b.flange_a)
    net.connect(net.b.flange_b, net.two.flange, net.push.flange)
    drive = ia.identification.sampled(
        Multisine(rms=5.0, low=0.5, high=4.0, period=5.0), stop=5.0, rate=100.0, fade=0.5
    )
    run = net.simulate(5.0, step=0.01, inputs={"push.f": drive})
    scatter = np.random.default_rng(0).normal(0, 1e-5, (2, len(run.time)))
    columns = {"F": drive.values, "x1": run["two.s"] + scatter[0], "x2": run["one.s"] + scatter[1]}
    channels = {
        "F": {"input": "push.f", "unit": "N"},
        "x1": {"output": "one.s", "unit": "m"},
        "x2": {"output": "two.s", "unit": "m"},
    }
    priors = {"a.k": {"rel": 0.1}, "b.k": {"rel": 0.1}}
    found = ia.fit(Campaign(net, channels, priors, [{"record": Record("run", drive.time, columns)}]))
    assert told(found, "x1 and x2 are likely exchanged")


def test_a_parameter_that_leaves_its_prior_is_told() -> None:
    found = fitted(priors={**PRIORS, "spring.k": {"rel": 0.02}})
    assert found.values["spring.k"] == pytest.approx(440.0, rel=1e-3)
    assert told(
        found, "spring.k: 44", "1.26 times what was assumed", "12.9 standard deviations", "rel = 0.02"
    )
    assert not told(found, "next to nothing")


def test_a_parameter_that_runs_away_is_not_said_to_stand_where_it_was_assumed() -> None:
    """At an optimum where only the prior has a slope, the parameter is at 4 as assumed, or far from it."""
    prior = Prior(center=4.0, sd=2.0, min=0.0, max=np.inf)
    expected = {4.5: "it stays near the 4 that was assumed", 5072.0: "it went from 4 to 5072 all the same"}
    for value, words in expected.items():
        at = Optimum(
            {"d": value}, [], 1.0, np.zeros(1), np.eye(1), np.array([2.0]), np.zeros(1), 5, "converged"
        )
        (warning,) = uncertainty(at, [], {"d": prior}).warnings
        assert f"the records say next to nothing about it; {words}" in warning


@pytest.mark.parametrize(
    ("stated", "words"), [(2e-6, "is white noise, but"), (2e-4, "times the noise, 0.0002 m")]
)
def test_noise_that_was_stated_ten_times_wrong_is_told(stated: float, words: str) -> None:
    found = fitted(entries={"noise": {"x": stated}})
    assert told(found, words, "correct [noise]")
    assert not told(found, "the model lacks something")


def test_a_test_record_of_another_machine_is_told() -> None:
    train, test = [{"record": measured(1)}], [{"record": measured(2, k=600.0)}]
    found = ia.fit(Campaign(model(), CHANNELS, PRIORS, train, test))
    assert told(found, "run 2: x: this test record is missed by", "what was fitted does not hold there")
    assert not told(found, "the model lacks something")


def test_the_record_that_spoils_a_fit_is_named() -> None:
    train = [{"record": measured(n, k=520.0 if n == 3 else 440.0)} for n in range(1, 8)]
    stiff = {"spring.k": {"min": 430.0, "max": 450.0}, "spring.d": {"rel": 0.5}}
    net = model().with_values(spring=ia.SpringDamper(k=440.0, d=4.0))
    found = ia.fit(Campaign(net, CHANNELS, stiff, train))
    assert told(found, "x: the fit leaves", "most of it in run 3")


def test_a_record_that_is_fitted_twice_is_refused() -> None:
    one = measured(1)
    twin = Record("its twin", one.time, dict(one.values))
    with pytest.raises(ia.ModelError, match=r"\[\[train\]\] 2: 'its twin' is also \[\[train\]\] 1"):
        Campaign(model(), CHANNELS, PRIORS, [{"record": one}, {"record": twin}])
    halves = [{"record": one, "window": [0.0, 2.5]}, {"record": one, "window": [2.5, 5.0]}]
    assert len(Campaign(model(), CHANNELS, PRIORS, halves).training) == 2
    whole: list[dict[str, Any]] = [{"record": one}, {"record": one, "window": [2.5, 5.0]}]
    apart = [{"train": [1], "parameters": ["spring.k"]}, {"train": [2], "parameters": ["spring.d"]}]
    assert len(Campaign(model(), CHANNELS, PRIORS, whole, stage=apart).stages) == 2


def test_a_sensor_that_sticks_on_the_way_is_told_and_one_that_is_dead_refused() -> None:
    run = measured(1)
    late = run.time > 3.0
    stuck = Record(
        "run", run.time, {**run.values, "x": np.where(late, run.values["x"][300], run.values["x"])}
    )
    notes = Campaign(model(), CHANNELS, PRIORS, [{"record": stuck}]).notes
    assert any("'x' repeats one value from 3 to 5 s" in note for note in notes)
    coarse = Record("run", run.time, {**run.values, "x": np.round(run.values["x"], 2)})
    assert not Campaign(model(), CHANNELS, PRIORS, [{"record": coarse}]).notes
    dead = Record("run", run.time, {**run.values, "x": np.full(len(run.time), 0.2)})
    with pytest.raises(
        ia.ModelError, match=r"x: it is 0\.2 m throughout all training .*; is the sensor connected"
    ):
        Campaign(model(), CHANNELS, PRIORS, [{"record": dead}])


def test_an_input_that_jumps_between_samples_is_told_and_may_be_taken_as_linear() -> None:
    run = measured(1)
    jumps = Record("run", run.time, {**run.values, "F": np.sign(np.sin(9 * run.time))})
    notes = Campaign(model(), CHANNELS, PRIORS, [{"record": jumps}]).notes
    assert any(
        "'F': it jumps within one sample" in note and "interpolation='linear'" in note for note in notes
    )
    linear = {**CHANNELS, "F": {**CHANNELS["F"], "interpolation": "linear"}}
    campaign = Campaign(model(), linear, PRIORS, [{"record": jumps}])
    assert not campaign.notes
    stand = CampaignModel(campaign.dae, campaign.measured, campaign.training).stands[0]
    assert stand.inputs["push.f"].interpolation == "linear"
    with pytest.raises(ia.ModelError, match="interpolation is 'cubic' or 'linear' or 'hold', got 'spline'"):
        Campaign(
            model(), {**linear, "F": {**CHANNELS["F"], "interpolation": "spline"}}, PRIORS, [{"record": run}]
        )


def test_two_parameters_that_act_as_one_are_told() -> None:
    net = ia.Network("rig", push=ia.Force(), mass=ia.Mass(m=2.0), wall=ia.Fixed(), a=ia.Spring(k=200.0))
    net.add(b=ia.Spring(k=200.0), damper=ia.Damper(d=6.0)).connect(net.wall.flange, net.a.flange_a)
    net.connect(net.a.flange_a, net.b.flange_a, net.damper.flange_a)
    net.connect(net.a.flange_b, net.b.flange_b, net.damper.flange_b, net.mass.flange, net.push.flange)
    priors = {"a.k": {"rel": 0.2}, "b.k": {"rel": 0.2}}
    found = ia.fit(Campaign(net, CHANNELS, priors, [{"record": measured(1)}]))
    assert told(found, "a.k and b.k move against each other")
    assert sum(found.values[name] for name in priors) == pytest.approx(440.0, rel=1e-3)


def test_a_fit_with_parameters_far_off_comes_to_an_end() -> None:
    wide = {name: {"rel": 0.5} for name in ("spring.k", "spring.d", "mass.m")}
    found = fitted(times={"x": 1e3}, priors=wide)  # a mass of next to nothing rings for ever
    assert told(found, "x is likely in mm, not in m")
