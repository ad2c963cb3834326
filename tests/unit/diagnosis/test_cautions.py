"""What a verdict warns of, and what the command line prints of it: units, priors, parameters, like sites."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from inertance.cli.diagnose import show
from inertance.diagnosis import Verdict, diagnose
from inertance.diagnosis.effects.effect import effect_of
from inertance.diagnosis.effects.hypothesis import Hypothesis
from inertance.diagnosis.effects.sites import Site
from inertance.diagnosis.verdict.cautions import cautions
from inertance.identification import Campaign, Record

RIGS: dict[str, tuple[float, float]] = {"mm": (1e3, 1.0), "prior": (1.0, 0.05)}


@pytest.fixture(scope="module")
def verdicts(carriage: Callable[..., Any]) -> dict[str, Verdict]:
    """Return verdicts on a carriage with a position in mm, and one with a prior too narrow."""
    rig = carriage(rate=100.0, duration=4.0, noise=2e-5)
    found = {}
    for name, (factor, share) in RIGS.items():
        truth = rig.rig(k=950.0)
        runs = [rig.measured(truth, seed) for seed in (1, 2)]
        records = [Record(r.name, r.time, {**r.values, "x": factor * r.values["x"]}) for r in runs]
        campaign = Campaign(
            rig.rig(),
            channels={"F": {"input": "push.f", "unit": "N"}, "x": {"output": "carriage.s", "unit": "m"}},
            parameters={"spring.k": {"rel": 0.2 * share}, "guide.d": {"rel": 0.3}},
            train=[{"record": records[0]}],
            test=[{"record": records[1]}],
        )
        found[name] = diagnose(campaign)
    return found


def printed(verdict: Verdict, capsys: pytest.CaptureFixture[str]) -> str:
    show(verdict)
    return " ".join(capsys.readouterr().out.split())


def test_a_column_in_another_unit_is_named(verdicts: dict[str, Verdict]) -> None:
    assert any("likely in mm, not in m" in note for note in verdicts["mm"].notes)


@pytest.mark.parametrize(
    ("gain", "words"),
    [(-2.0, "wrong sign"), (999.0, "likely in mm, not in m"), (0.02, None), (-0.999, None)],
)
def test_a_gain_that_is_a_sign_or_a_unit_is_called_so(
    verdicts: dict[str, Verdict], gain: float, words: str | None
) -> None:
    evidence = verdicts["prior"].evidence
    faulty = Hypothesis(
        effect_of("sensor_gain"),
        Site("x", "channel", "carriage.s", "", frozenset({"channel"})),
        "gain_1",
        {"gain": gain},
    )
    told = list(cautions(evidence.campaign, replace(evidence.refit, effects=(faulty,))))
    about = [line for line in told if line.startswith("x: a gain of")]
    assert len(about) == (words is not None)
    assert all(str(words) in line for line in about)


def test_a_parameter_that_leaves_its_prior_is_noted(verdicts: dict[str, Verdict]) -> None:
    found = verdicts["prior"]
    assert found.verdict == "parameters"
    assert any(note.startswith("spring.k: 9") and "standard deviations" in note for note in found.notes)


def test_the_fitted_parameters_and_sites_of_one_motion_are_printed(
    verdicts: dict[str, Verdict], capsys: pytest.CaptureFixture[str], carriage: Callable[..., Any]
) -> None:
    told = printed(verdicts["prior"], capsys)
    value = verdicts["prior"].parameters["spring.k"]
    assert value == pytest.approx(950.0, rel=1e-2)
    assert "parameters" in told
    error = verdicts["prior"].standard_errors["spring.k"]
    assert f"spring.k │ 800 │ {value:.5g} │ {value:.5g} │ {error:.2g} │ N/m" in told
    rig = carriage(rate=100.0, duration=4.0, noise=2e-5)
    rubbing = Campaign(
        rig.rig(),
        channels={"F": {"input": "push.f", "unit": "N"}, "x": {"output": "carriage.s", "unit": "m"}},
        parameters={"spring.k": {"rel": 0.2}},
        train=[{"record": rig.measured(rig.rubbing(), 1)}],
        test=[{"record": rig.measured(rig.rubbing(), 2)}],
    )
    found = diagnose(rubbing)
    told = printed(found, capsys)
    assert found.effects[0].site.same
    for other in found.effects[0].site.same:
        assert other in told.partition("the same motion as at ")[2].partition(", which")[0]
    friction = next(iter(found.effects[0].values.values()))
    assert f"{friction:.5g} │ {found.standard_errors['coulomb_friction_1.f_c']:.2g} │ N " in told
    assert np.isclose(friction, 0.8, rtol=0.05)
