"""How well a verdict knows its parameters and effects: as a fit of the corrected network would."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.cli.diagnose import show
from inertance.diagnosis import Verdict, write_report
from inertance.identification import Campaign, Record

CHANNELS = {"F": {"input": "push.f", "unit": "N"}, "x": {"output": "carriage.s", "unit": "m"}}
PRIORS = {"spring.k": {"rel": 0.2}, "guide.d": {"rel": 0.4}}
FRICTION = "coulomb_friction_1.f_c"


class Told:
    """A verdict on a carriage that rubs, and the campaign that it is of."""

    def __init__(self, carriage: Any, coloured: bool = False) -> None:
        machine, draw = carriage(rate=100.0, duration=8.0, noise=2e-5), np.random.default_rng(1)

        def sensor(t: Any, x: Any) -> Any:
            lasting = np.exp(-1 / 20.0) ** np.arange(400)
            slow = np.convolve(draw.standard_normal(len(x) + 400), lasting, "same")[200:-200]
            return x + 1e-4 * slow / slow.std() if coloured else x

        records = [machine.measured(machine.rubbing(), seed, sensor) for seed in (1, 2, 3)]
        self.given: dict[str, Any] = {
            "train": [{"record": r, "initial": "rest"} for r in records[:2]],
            "test": [{"record": records[2], "initial": "rest"}],
            "noise": {"x": 1e-4 if coloured else 2e-5},
        }
        self.machine = machine
        self.verdict: Verdict = ia.diagnose(Campaign(machine.rig(), CHANNELS, PRIORS, **self.given))

    def fit(self, **how: Any) -> Any:
        """Return a fit of the corrected network with the size of the effect."""
        network = self.verdict.corrected()
        priors = {**PRIORS, FRICTION: {"min": 0.0, "max": 10.0}}
        campaign = Campaign(network, CHANNELS, priors, **self.given)
        return ia.fit(campaign, **how)


@pytest.fixture(scope="module")
def rubbing(carriage: Callable[..., Any]) -> Told:
    return Told(carriage)


def test_errors_and_intervals_are_those_of_a_fit_of_the_corrected_network(rubbing: Told) -> None:
    verdict = rubbing.verdict
    assert [placed.effect.kind for placed in verdict.effects] == ["coulomb_friction"]
    found = rubbing.fit(intervals=0.95)
    known = verdict.intervals()
    assert set(known) == set(verdict.standard_errors) == {*PRIORS, FRICTION}
    for name, error in verdict.standard_errors.items():
        assert error == pytest.approx(found.errors[name], rel=0.1)
        assert known[name].low == pytest.approx(found.intervals[name].low, abs=0.15 * error)
        assert known[name].high == pytest.approx(found.intervals[name].high, abs=0.15 * error)
    for name, truth in {"spring.k": 820.0, "guide.d": 6.0, FRICTION: 0.8}.items():
        assert known[name].low < truth < known[name].high


def test_coloured_noise_makes_errors_larger_as_in_a_fit(rubbing: Told, carriage: Callable[..., Any]) -> None:
    slow = Told(carriage, coloured=True)
    found, errors = slow.fit(), slow.verdict.standard_errors
    for name in {*PRIORS} & {*errors}:
        assert errors[name] == pytest.approx(found.errors[name], rel=0.35)
        assert errors[name] > 2 * rubbing.verdict.standard_errors[name]


def test_the_json_file_and_the_report_tell_errors(rubbing: Told, tmp_path: Path) -> None:
    verdict = rubbing.verdict
    told = json.loads(verdict.save(tmp_path / "gap.json").read_text())
    assert told["standard_errors"]["spring.k"] == verdict.standard_errors["spring.k"]
    assert told["effects"][0]["standard_errors"] == {"f_c": verdict.standard_errors[FRICTION]}
    page = write_report(verdict, tmp_path / "gap.html").read_text()
    assert f"{verdict.standard_errors[FRICTION]:.2g}" in page


def test_errors_are_a_fits_where_records_begin_in_motion_with_zeros_and_values_of_their_own(
    carriage: Callable[..., Any],
) -> None:
    machine = carriage(rate=100.0, duration=10.0, noise=2e-5)

    def record(seed: int, k: float, zero: float) -> Record:
        rubbing = machine.rubbing().clone()
        rubbing.spring.k = k
        whole = machine.measured(rubbing, seed)
        kept = whole.time >= 2.0
        values = {"F": whole.values["F"][kept], "x": whole.values["x"][kept] + zero}
        return Record(whole.name, whole.time[kept], values)

    first, second, third = record(1, 815.0, 3e-4), record(2, 830.0, -5e-4), record(3, 820.0, 2e-4)
    channels = {"F": {"input": "push.f", "unit": "kN"}, "x": {"output": "carriage.s", "unit": "mm"}}
    priors: dict[str, Any] = {"guide.d": {"rel": 0.4}, "spring.k": {"rel": 0.05, "per": "record"}}
    given: dict[str, Any] = {
        "train": [{"record": first, "offset": ["x"]}, {"record": second, "offset": ["x"]}],
        "test": [{"record": third, "offset": ["x"]}],
        "noise": {"x": 2e-2},
    }
    verdict = ia.diagnose(Campaign(machine.rig(), channels, priors, **given))
    known = verdict.intervals()
    bounds = {FRICTION: {"min": 0.0, "max": 10.0}}
    found = ia.fit(Campaign(verdict.corrected(), channels, {**priors, **bounds}, **given))
    assert set(known) == {"guide.d", FRICTION}
    for name, truth in {"guide.d": 6.0, FRICTION: 0.8}.items():
        assert verdict.standard_errors[name] == pytest.approx(found.errors[name], rel=0.1)
        assert known[name].low < truth < known[name].high


def test_an_effect_of_a_sensor_has_errors_too(carriage: Callable[..., Any]) -> None:
    machine = carriage(rate=100.0, duration=8.0, noise=2e-5)
    records = [machine.measured(machine.rig(), seed, lambda t, x: 1.1 * x) for seed in (1, 2)]
    campaign = Campaign(
        machine.rig(), CHANNELS, {"spring.k": {"rel": 0.02}},
        [{"record": records[0], "initial": "rest"}], [{"record": records[1], "initial": "rest"}],
        noise={"x": 2e-5},
    )  # fmt: skip
    verdict = ia.diagnose(campaign)
    assert [placed.effect.kind for placed in verdict.effects] == ["sensor_gain"]
    (name,) = (n for n in verdict.standard_errors if n.endswith(".gain"))
    gain = verdict.effects[0].values["gain"]
    assert abs(gain - 0.1) < 4 * verdict.standard_errors[name] < 0.01
    assert verdict.intervals()[name].low < 0.1 < verdict.intervals()[name].high


def test_the_command_line_tells_errors_and_intervals(
    rubbing: Told, capsys: pytest.CaptureFixture[str]
) -> None:
    verdict = rubbing.verdict
    show(verdict, verdict.intervals())
    told = capsys.readouterr().out
    assert "95 % intervals" in told
    assert f"{verdict.standard_errors[FRICTION]:.2g}" in told
    assert f"{verdict.intervals()[FRICTION].low:.5g}" in told
