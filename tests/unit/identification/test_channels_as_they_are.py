"""Channels as instruments give them: commands that are held, inputs that act late, sensors that rest."""

from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.diagnosis.models.study import thinned
from inertance.identification import Campaign, Record
from inertance.networks import sampled_at
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline

Array = NDArray[np.float64]
DELAY, HELD, NOISE = 0.0137, 0.04, 1e-5
HOLD: dict[str, dict[str, Any]] = {
    "F": {"input": "push.f", "unit": "N", "interpolation": "hold", "delay": DELAY},
    "x": {"output": "mass.s", "unit": "m"},
}
PRIORS = {"spring.k": {"rel": 0.2}, "spring.d": {"rel": 0.5}}


def model() -> ia.Network:
    net = ia.Network("rig", push=ia.Force(), mass=ia.Mass(m=2.0), wall=ia.Fixed())
    net.add(spring=ia.SpringDamper(k=350.0, d=4.0)).connect(net.wall.flange, net.spring.flange_a)
    return net.connect(net.spring.flange_b, net.mass.flange, net.push.flange)


def commanded(seed: int, rate: float = 100.0, length: float = 4.0, begin: float = 7.0) -> Record:
    """Return a record that begins in motion: each command is held for 40 ms and acts 13.7 ms late."""
    rng = np.random.default_rng(seed)
    commands = 10 * rng.normal(size=round(length / HELD) + 3)

    def command(t: float) -> float:
        return float(commands[max(0, int((t - begin) / HELD + 1e-9))])

    state, t, states = np.array([0.01, -0.2]), begin, []
    instants = begin + np.arange(round(length * rate) + 1) / rate
    jumps = begin + HELD * np.arange(len(commands)) + DELAY
    for stop in np.unique(np.r_[instants, jumps[jumps < instants[-1]]]):
        if stop > t:
            force = command(0.5 * (t + stop) - DELAY)
            state = solve_ivp(
                lambda _, y, f=force: [y[1], (f - 440.0 * y[0] - 6.0 * y[1]) / 2.0],
                (t, stop), state, rtol=1e-9, atol=1e-12,
            ).y[:, -1]  # fmt: skip
        t = stop
        if stop in instants:
            states.append(state[0])
    sent = np.array([command(t) for t in instants])
    return Record(f"run {seed}", instants, {"F": sent, "x": states + NOISE * rng.normal(size=len(states))})


def test_a_held_command_that_acts_late_is_fitted_to_the_noise() -> None:
    records = [{"record": commanded(seed, length=2.4)} for seed in (1, 2)]
    found = ia.fit(Campaign(model(), HOLD, PRIORS, records[:1], records[1:], {"x": NOISE}))
    assert found.values["spring.k"] == pytest.approx(440.0, abs=4 * found.errors["spring.k"])
    assert found.errors["spring.k"] < 0.2
    assert all(c.rms("x", c.after) < 1.2 * NOISE for c in found.comparisons)
    for other in ({"delay": 0.0}, {"interpolation": "cubic"}, {"interpolation": "linear"}):
        channels = {**HOLD, "F": {**HOLD["F"], **other}}
        missed = ia.fit(Campaign(model(), channels, PRIORS, records[:1], noise={"x": NOISE}))
        assert missed.comparisons[0].rms("x", missed.comparisons[0].after) > 5 * NOISE


def test_a_diagnosis_takes_held_commands_as_they_are() -> None:
    fast = commanded(3, rate=1000.0, length=1.0)
    campaign = Campaign(model(), HOLD, PRIORS, [{"record": fast}])
    assert np.array_equal(thinned(campaign).training[0].record.values["F"], fast.values["F"])
    machine = [{"record": commanded(seed, length=3.0)} for seed in (4, 5)]
    verdict = ia.diagnose(Campaign(model(), HOLD, PRIORS, machine[:1], machine[1:], {"x": NOISE}))
    assert verdict.verdict == "parameters"
    assert verdict.parameters["spring.k"] == pytest.approx(440.0, abs=1.0)


@pytest.mark.parametrize("delay", [0.0137, -0.0137, 0.02])
def test_a_signal_is_shifted_and_goes_on_beyond_its_ends(delay: float) -> None:
    time = np.linspace(3.0, 5.0, 201)
    record = Record("run", time, {"F": np.sin(9 * time)})
    course = sampled_at(record.sampled("F", delay=delay), time)
    inside = (time - delay > 3.05) & (time - delay < 4.95)
    assert course[inside] == pytest.approx(
        CubicSpline(time, np.sin(9 * time))(time - delay)[inside], abs=1e-6
    )
    assert course == pytest.approx(np.sin(9 * (time - delay)), abs=0.05)
    steps = sampled_at(record.sampled("F", "hold", delay), time)
    assert set(steps) <= set(record.values["F"])


def test_what_cannot_be_shifted_or_held_is_told() -> None:
    run = commanded(1)

    def told(channels: dict[str, Any], network: ia.Network | None = None) -> str:
        with pytest.raises(ia.ModelError) as error:
            Campaign(network or model(), channels, {"mass.m": {"rel": 0.1}}, [{"record": run}])
        return str(error.value)

    force = HOLD["F"]
    assert "'F': delay = 5 s is longer than the record, 4 s" in told({**HOLD, "F": {**force, "delay": 5.0}})
    late = {**HOLD["x"], "delay": 0.1}
    assert "channels.x: delay is of an input, got 0.1 s for an output" in told({**HOLD, "x": late})
    assert "delay must be a finite number" in told({**HOLD, "F": {**force, "delay": "20 ms"}})
    shaken = ia.Network("shaken", table=ia.Position(), strut=ia.Damper(d=1.0), mass=ia.Mass(m=1.0))
    shaken.connect(shaken.table.flange, shaken.strut.flange_a)
    shaken.connect(shaken.strut.flange_b, shaken.mass.flange)
    moved = {**HOLD, "F": {**force, "input": "table.s_ref", "unit": "m"}}
    assert "needs the derivative of what jumps" in told(moved, shaken)
    filtered = shaken.with_values(table=ia.Position(exact=False))
    assert Campaign(filtered, moved, {"mass.m": {"rel": 0.1}}, [{"record": run}]).inputs == ["F"]


def test_a_channel_may_rest_in_one_record() -> None:
    swinging, pushed = commanded(1), commanded(2)
    free = {**swinging.values, "F": np.zeros(len(swinging.time))}
    still = {"F": np.zeros(len(pushed.time)), "x": np.zeros(len(pushed.time))}
    records = [
        {"record": pushed, "offset": ["x"]},
        {"record": Record("still", pushed.time, still), "offset": ["x"]},
    ]
    campaign = Campaign(model(), HOLD, PRIORS, records)
    assert not campaign.notes
    assert 0.5 * NOISE < campaign.sigma["x"] < 10 * NOISE
    found = ia.fit(campaign)
    assert found.values["spring.k"] == pytest.approx(440.0, rel=0.01)
    assert "-" in found.table()
    decay = Campaign(model(), HOLD, PRIORS, [{"record": Record("decay", swinging.time, free)}])
    assert decay.notes == ["'F' is 0 N throughout all training records; what it excites, they do not show"]


def test_a_sensor_of_a_machine_that_rests_is_neither_stuck_nor_saturated(tmp_path: Path) -> None:
    t = np.arange(801) / 100
    command = np.interp(t, [0, 1, 1.2, 3, 3.4, 5, 5.2, 8], [0, 0, 0.2, 0.2, -0.2, -0.2, 0.1, 0.1])
    load = np.round(np.abs(np.gradient(command, t)) * 4) / 8  # coarse, and 0 while it rests
    columns = {"t": t, "F": command, "x": np.round(command, 4), "load": load}
    lines = [
        ",".join(columns),
        *(",".join(map(repr, row)) for row in np.column_stack([*columns.values()]).tolist()),
    ]
    (tmp_path / "run.csv").write_text("\n".join(lines))
    channels = {
        "F": {"input": "push.f", "unit": "N"},
        "x": {"output": "mass.s", "unit": "m"},
        "load": {"output": "spring.f", "unit": "N"},
    }
    campaign = Campaign(model(), channels, PRIORS, [{"file": "run.csv"}], base=tmp_path)
    assert not any("stuck" in note for note in campaign.notes)


def test_jitter_leaves_held_values_alone_and_is_told_once(tmp_path: Path) -> None:
    rng = np.random.default_rng(0)
    sent = np.repeat(rng.normal(size=50), 4)
    for name in ("one", "two"):
        time = 0.02 * np.arange(200) + rng.uniform(-3e-4, 3e-4, 200)
        rows = zip(time.tolist(), sent.tolist(), np.cumsum(sent).tolist(), strict=True)
        text = "\n".join(["t,F,x", *(",".join(map(repr, row)) for row in rows)])
        (tmp_path / f"{name}.csv").write_text(text)
    files = [{"file": "one.csv", "window": [0.0, 2.0]}, {"file": "two.csv", "window": [2.0, 4.0]}]
    campaign = Campaign(model(), HOLD, PRIORS, files, base=tmp_path)
    assert np.array_equal(
        campaign.training[0].record.values["F"], sent[:101][: len(campaign.training[0].record.time)]
    )
    assert campaign.notes == [
        "one.csv, two.csv: instants jitter by less than 0.1 of a step; values are interpolated onto even ones"
    ]
