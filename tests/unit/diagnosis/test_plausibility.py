"""Which values of effects no machine has, and which are doubtful, by motion, forces and records."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.diagnosis.effects.effect import effect_of
from inertance.diagnosis.effects.hypothesis import Hypothesis
from inertance.diagnosis.effects.plausibility import doubtful, implausible
from inertance.diagnosis.effects.sites import Site, sites_of, surrounded
from inertance.diagnosis.models.study import Study
from inertance.diagnosis.search.joint_fit import JointFit
from inertance.diagnosis.search.score_test import screen
from inertance.diagnosis.verdict.resolution import unresolved
from inertance.identification import Accuracy, Campaign, Record
from numpy.typing import NDArray

TIME = np.linspace(0.0, 20.0, 401)
TURNING, SLIDING = "rotational", "translational"


def bench(torque: NDArray[np.float64] | None = None, begin: float = 0.0) -> Campaign:
    """Return a flywheel that is driven by up to 3 N.m for 20 s, its angle and the drive's force measured."""
    net = ia.Network("bench", drive=ia.rotational.Torque(), wheel=ia.rotational.Inertia(J=0.2))
    net.add(oil=ia.rotational.Damper(d=0.1), base=ia.rotational.Fixed())
    net.connect(net.drive.flange, net.wheel.flange, net.oil.flange_b)
    net.connect(net.base.flange, net.oil.flange_a)
    given = 3.0 * np.sin(TIME) if torque is None else torque
    record = Record("run", begin + TIME, {"u": given, "angle": 5.0 + np.cos(TIME)})
    channels = {"u": {"input": "drive.tau", "unit": "N.m"}, "angle": {"output": "wheel.phi", "unit": "rad"}}
    return Campaign(net, channels, {"oil.d": {"rel": 0.1}}, [{"record": record}], noise={"angle": 1e-3})


def at(domain: str = TURNING, places: str = "across", **motion: Any) -> Site:
    told = {"travel": 2.0, "speed": 1.0, "force": 4.0, "largest": 5.0}
    return Site("oil", domain, "oil.flange_b", "oil.flange_a", frozenset({places}), **{**told, **motion})


def on(channel: str) -> Site:
    return Site(channel, "channel", "", "", frozenset({"channel"}))


def placed(kind: str, site: Site, values: Mapping[str, float]) -> Hypothesis:
    return Hypothesis(effect_of(kind), site, "added", values)


REFUSED = {
    "a ripple that is passed once": (
        "position_ripple", at(travel=2.0), {"tau_sin": 1.0, "tau_cos": 0.5, "period": 3.9}, "passed 1 times",
    ),
    "friction along a way that is passed once": (
        "position_dependent_friction", at(travel=100.0, passes=1.0),
        {"tau_c": 1.0, "tau_cos": 0.5, "tau_sin": 0.1, "period": 270.0}, "in a motion that never turns",
    ),
    "a stiffness on a shaft that turns": (
        "linear_stiffness", at(travel=600 * np.pi), {"c": 1e-3}, "a shaft that turns 600 times",
    ),
    "a hardening one as well": (
        "cubic_stiffness", at(travel=600 * np.pi), {"c3": -1e-9}, "a shaft that turns 600 times",
    ),
    "friction above all forces": (
        "coulomb_friction", at(), {"tau_c": 1e4}, "2e+03 times the largest force there is",
    ),
    "asymmetric friction on one side": (
        "asymmetric_friction", at(), {"tau_forward": 1.0, "tau_backward": 60.0},
        "tau_backward = 60 N.m is 12 ",
    ),
    "friction by the load of friction": (
        "load_dependent_friction", at(places="loaded", sticks=True), {"mu": 0.7},
        "the dry friction that the",
    ),
    "a gain of 150000": ("sensor_gain", on("angle"), {"gain": 1.5e5}, "no fault of a sensor"),
    "a gain of nothing": ("sensor_gain", on("angle"), {"gain": -1.0}, "a gain of 0"),
    "a delay of seconds": ("sensor_delay", on("angle"), {"delay": 2.5}, "12% of the longest record"),
    "a lag of seconds": ("actuator_lag", on("u"), {"T": 2.5}, "12% of the longest record"),
    "a wheel of tons": ("added_inertia", at(places="node"), {"J": 21.0}, "105 times the largest inertia"),
    "a dead zone beyond the command": ("actuator_dead_zone", on("u"), {"width": 6.0}, "of the largest 'u'"),
    "nothing at all": ("viscous_damping", at(), {"d": 0.0}, "it does nothing"),
    "no mass at all": ("added_inertia", at(places="node"), {"J": 1e-12}, "it does nothing"),
}  # fmt: skip

ALLOWED = {
    "a ripple of some periods": ("position_ripple", at(), {"tau_sin": 1.0, "tau_cos": 0.5, "period": 1.0}),
    "a stiffness on a shaft that swings": ("linear_stiffness", at(travel=3.0), {"c": 2.0}),
    "hysteresis on a shaft that turns": ("hysteresis", at(travel=600 * np.pi), {"c": 10.0, "phi_y": 0.01}),
    "damping that grows on a shaft that turns": (
        "viscous_drift", at(travel=600 * np.pi), {"d": 0.1, "d_u": 1e-3, "d_uu": 0.0},
    ),
    "a stiffness on a long way": ("linear_stiffness", at(SLIDING, travel=600 * np.pi), {"k": 2.0}),
    "friction below the largest force": ("coulomb_friction", at(force=1e-6), {"tau_c": 4.0}),
    "friction where no force is known": ("coulomb_friction", at(largest=np.inf), {"tau_c": 1e4}),
    "a gain of a tenth more": ("sensor_gain", on("angle"), {"gain": 0.1}),
    "a gain that is a unit": ("sensor_gain", on("angle"), {"gain": 180 / np.pi - 1}),
    "a gain that is a sign": ("sensor_gain", on("angle"), {"gain": -2.0}),
    "a delay of a tenth of a second": ("sensor_delay", on("angle"), {"delay": 0.1}),
    "a bias of many radians": ("sensor_bias", on("angle"), {"bias": -40.0}),
    "a wheel as heavy": ("added_inertia", at(places="node"), {"J": 0.2}),
    "a narrow dead zone": ("actuator_dead_zone", on("u"), {"width": 0.3}),
}  # fmt: skip


@pytest.fixture(scope="module")
def campaign() -> Campaign:
    return bench()


@pytest.mark.parametrize(("kind", "site", "values", "told"), REFUSED.values(), ids=REFUSED)
def test_what_no_machine_has_is_refused_with_the_reason(
    campaign: Campaign, kind: str, site: Site, values: Mapping[str, float], told: str
) -> None:
    why = implausible(placed(kind, site, values), campaign)
    assert why is not None
    assert told in why


@pytest.mark.parametrize(("kind", "site", "values"), ALLOWED.values(), ids=ALLOWED)
def test_what_a_machine_may_have_is_neither_refused_nor_doubted(
    campaign: Campaign, kind: str, site: Site, values: Mapping[str, float]
) -> None:
    assert implausible(placed(kind, site, values), campaign) is None
    assert list(doubtful(placed(kind, site, values), campaign)) == []


@pytest.mark.parametrize(
    ("kind", "site", "values", "told"),
    [
        ("position_ripple", at(), {"tau_sin": 1.0, "tau_cos": 0.5, "period": 2.0}, "passed 2 times"),
        ("linear_stiffness", at(travel=5 * np.pi), {"c": 2.0}, "turns 5 times"),
        ("coulomb_friction", at(), {"tau_c": 7.0}, "1.4 times the largest force"),
        ("sensor_gain", on("angle"), {"gain": 2.0}, "a gain of 3"),
        ("added_inertia", at(places="node"), {"J": 1.0}, "5 times the largest inertia"),
    ],
)
def test_what_is_odd_is_told_and_not_refused(
    campaign: Campaign, kind: str, site: Site, values: Mapping[str, float], told: str
) -> None:
    assert implausible(placed(kind, site, values), campaign) is None
    assert [told in line for line in doubtful(placed(kind, site, values), campaign)] == [True]


def test_a_measured_force_counts_as_one_that_there_is() -> None:
    """Beside a weak model, a strong drive that was recorded moves what a strong friction holds."""
    friction = placed("coulomb_friction", at(largest=0.01), {"tau_c": 2.9})
    assert implausible(friction, bench()) is None
    assert implausible(friction, bench(0.02 * np.sin(TIME))) is not None


@pytest.mark.parametrize("begin", [0.0, 1e5])
def test_a_delay_is_judged_by_how_long_a_record_lasts(begin: float) -> None:
    late = placed("sensor_delay", on("angle"), {"delay": 2.5})
    assert implausible(late, bench(begin=begin)) is not None


def test_an_offset_command_is_judged_about_its_middle() -> None:
    blocked = placed("actuator_dead_zone", on("u"), {"width": 6.0})
    assert implausible(blocked, bench(100.0 + 3.0 * np.sin(TIME))) is not None


def test_sites_know_the_largest_force_of_their_domain() -> None:
    found = surrounded([at(force=2.0), at(force=7.0), at(SLIDING, force=0.0)], {})
    assert [site.largest for site in found] == [7.0, 7.0, np.inf]


def test_an_inertia_behind_a_screw_counts_as_a_site_feels_it() -> None:
    """A wheel of 0.2 kg.m2 that turns by 10 rad/s where a nut moves by 1 m/s is felt there as 20 kg."""
    sites = [at(SLIDING, "node", speed=1.0), at(SLIDING, speed=0.0), at(speed=1.0), at(speed=10.0)]
    sites[3] = replace(sites[3], path="wheel")
    nut, resting, shaft, _ = surrounded(sites, {("wheel", TURNING): 0.2, ("wheel", SLIDING): 90.0})
    assert nut.inertia == pytest.approx(20.0)
    assert resting.inertia == shaft.inertia == 0.0
    assert implausible(placed("added_inertia", nut, {"m": 21.0}), bench()) is None
    told = implausible(placed("added_inertia", nut, {"m": 2100.0}), bench())
    assert told is not None
    assert "105 times the largest inertia" in told


def test_friction_that_only_sticks_is_refused_and_its_value_not_known(carriage: Callable[..., Any]) -> None:
    rig = carriage(rate=100.0, duration=4.0, noise=2e-5)
    records = [{"record": rig.measured(rig.rubbing(), seed)} for seed in (1, 2)]
    channels = {"F": {"input": "push.f", "unit": "N"}, "x": {"output": "carriage.s", "unit": "m"}}
    study = Study(
        Campaign(rig.rig(), channels, {"spring.k": {"rel": 0.2}}, records[:1], records[1:]), Accuracy()
    )
    screened = screen(study, study.campaign.start)
    found = next(c for c in screened if c.effect.kind == "coulomb_friction")
    assert found.site.largest >= found.site.force
    assert found.site.path in {site.path for site in sites_of(rig.rig())}
    told = {}
    for level in (0.8, 1e4):
        rubbing = replace(placed("coulomb_friction", found.site, {"f_c": level}), name="rub")
        joint = JointFit(study, study.campaign.start, [rubbing])
        notes = list(unresolved(study, joint.seen(joint.start)))
        told[level] = implausible(rubbing, study.campaign) is not None, notes
    assert told[0.8] == (False, [])
    assert told[1e4][0]
    assert "these records do not tell its value" in told[1e4][1][0]
