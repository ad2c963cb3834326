"""Play behind a stiff screw: a machine that rattles, which no free run follows for long."""

from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance import rotational
from inertance.diagnosis import Verdict
from inertance.diagnosis.law.likened import likened
from inertance.diagnosis.law.missing_force import force_of
from inertance.diagnosis.models.study import Study
from inertance.diagnosis.search.joint_fit import JointFit
from inertance.diagnosis.search.model_comparison import Refit
from inertance.diagnosis.verdict.beyond import beyond_the_list
from inertance.diagnosis.verdict.decide import decided
from inertance.identification import Accuracy, Campaign, Multisine, Record, sampled

RATE, SECONDS, EPS = 500.0, 4.0, 0.009
NOISE = {"w": 0.004, "angle": 0.001}


def screw(play: float = 0.0, bearing: float = 0.12) -> ia.Network:
    """Return a motor that turns a load through a stiff screw; with play its flanks press at once."""
    stiff = rotational.SpringDamper(c=6000.0, d=0.6)
    coupling = rotational.ElastoBacklash2(c=6000.0, d=0.6, b=2 * play) if play else stiff
    net = ia.Network("screw", frame=rotational.Fixed(), motor=rotational.Inertia(J=0.02), coupling=coupling)
    net.add(bearing=rotational.Damper(d=bearing), brake=rotational.Damper(d=0.1))
    net.add(load=rotational.Inertia(J=0.03), drive=rotational.Torque())
    net.connect(net.frame.flange, net.bearing.flange_a, net.brake.flange_a)
    net.connect(net.bearing.flange_b, net.motor.flange, net.coupling.flange_a, net.drive.flange)
    return net.connect(net.coupling.flange_b, net.load.flange, net.brake.flange_b)


def records() -> list[dict[str, Any]]:
    """Return records of the screw with play, begun in motion, by a clock that is late."""
    true, rng, found = screw(EPS, bearing=0.13), np.random.default_rng(5), []
    for number in range(4):
        shape = Multisine(rms=1.3 - 0.1 * number, low=0.4, high=7.0, period=SECONDS + 1, seed=number)
        torque = sampled(shape, stop=SECONDS + 1, rate=RATE, fade=0.3)
        t = np.asarray(torque.time)
        pushed = {"drive.tau": torque}
        run = true.simulate(SECONDS + 1, step=1 / RATE, inputs=pushed, rtol=1e-9, atol=1e-12)
        kept, seen = t >= 1.0, {"w": run.at("motor.w", t), "angle": run.at("load.phi", t)}
        noisy = {name: y + NOISE[name] * rng.standard_normal(len(t)) for name, y in seen.items()}
        values = {"u": np.asarray(torque.values), **noisy}
        found.append(
            {"record": Record(f"run {number}", t[kept] + 40.0, {n: v[kept] for n, v in values.items()})}
        )
    return found


@pytest.fixture(scope="module")
def study() -> Study:
    """Return the records, whose noise nobody states, beside a model without play."""
    known = records()
    channels = {
        "u": {"input": "drive.tau", "unit": "N.m"},
        "w": {"output": "motor.w", "unit": "rad/s"},
        "angle": {"output": "load.phi", "unit": "rad"},
    }
    priors = {"bearing.d": {"rel": 0.2}, "brake.d": {"rel": 0.2}}
    return Study(Campaign(screw(), channels, priors, known[:2], known[2:]), Accuracy(foreseen=10**6))


@pytest.fixture(scope="module")
def base(study: Study) -> Refit:
    return JointFit(study, study.campaign.start).fitted()


@pytest.fixture(scope="module")
def verdict(study: Study, base: Refit) -> Verdict:
    """Return the verdict where free runs with anything of the list came to nothing."""
    start = JointFit(study, study.campaign.start)
    unknown = decided(study, start.seen(start.start), base, base, [], [], {})
    assert unknown.verdict == "unknown"
    return beyond_the_list(study, unknown)


def test_its_noise_is_read_beside_its_impacts(study: Study) -> None:
    """They fill the spectrum to the top, with ten times as much."""
    told = study.campaign.sigma
    assert NOISE["w"] < told["w"] < 1.6 * NOISE["w"]
    assert told["angle"] == pytest.approx(NOISE["angle"], rel=0.1)


def test_the_missing_force_takes_off_the_screw_what_it_bears(study: Study, base: Refit) -> None:
    missing = force_of(study, base)
    assert missing.site.path == "coupling"
    assert missing.misfit < 2.0 < missing.before
    (play,) = (one for one in likened(missing, None, base) if one.effect.kind == "backlash")
    assert play.values["eps"] == pytest.approx(EPS, rel=0.3)


def test_play_is_named_by_pieces_of_the_records(verdict: Verdict) -> None:
    (placed,) = verdict.effects
    assert verdict.verdict in ("effect", "ambiguous")
    assert (placed.effect.kind, placed.site.path) == ("backlash", "coupling")
    assert placed.values["eps"] == pytest.approx(EPS, rel=0.05)
    assert verdict.closed > 0.9
    assert "pieces of 4 records" in str(verdict)
