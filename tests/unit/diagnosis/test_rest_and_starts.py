"""Where records begin: at rest where effects let a machine rest, and with states that a machine can have."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.diagnosis.effects.effect import EFFECTS, effect_of
from inertance.diagnosis.effects.hypothesis import Hypothesis
from inertance.diagnosis.effects.sites import Site
from inertance.diagnosis.models.study import Study, study_of, thinned
from inertance.diagnosis.search.joint_fit import JointFit
from inertance.diagnosis.search.record_start import begun, settled
from inertance.identification import Accuracy, Campaign, Multisine, Record, sampled

CHANNELS = {"F": {"input": "push.f", "unit": "N"}, "x": {"output": "carriage.s", "unit": "m"}}
PRIORS = {"spring.k": {"rel": 0.1}, "guide.d": {"rel": 0.3}}
WEIGHT, EPS = 6.0, 2e-3


@pytest.fixture(scope="module")
def cart(carriage: Callable[..., Any]) -> Any:
    return carriage(rate=250.0, duration=6.0, noise=1e-5)


def study(cart: Any, records: list[Record], initial: str) -> Study:
    entries = [{"record": record, "initial": initial} for record in records]
    campaign = Campaign(cart.rig(), CHANNELS, PRIORS, entries[:-1], entries[-1:], noise={"x": 1e-5})
    return study_of(thinned(campaign), Accuracy())


def at(given: Study, kind: str, path: str, **values: float) -> Hypothesis:
    (site,) = (site for site in given.sites if site.path == path)
    return Hypothesis(effect_of(kind), site, f"{kind}_1", values)


def test_a_machine_at_rest_rests_where_what_is_missing_lets_it(cart: Any) -> None:
    """Taken for the start values of the model without the weight, it would fall from there."""
    net = cart.rig(k=820.0)
    net.add(weight=ia.ConstantForce(f_constant=WEIGHT)).connect(net.weight.flange, net.carriage.flange)
    sunk = WEIGHT / 820.0
    net.carriage.s = sunk
    records = [cart.measured(net, seed) for seed in (1, 2, 3)]
    given = study(cart, records, "rest")
    weight = at(given, "constant_force", "guide", f_constant=1.0)
    found = JointFit(given, given.campaign.start, [weight]).fitted()
    assert found.misfit == pytest.approx(1.0, abs=0.1)
    assert found.effects[0].values["f_constant"] == pytest.approx(WEIGHT, rel=1e-3)
    assert all(start["carriage.s"] == pytest.approx(sunk, abs=1e-5) for start in found.starts)


def test_only_what_acts_at_rest_moves_where_a_machine_rests(cart: Any) -> None:
    given = study(cart, [cart.measured(cart.rig(), seed) for seed in (1, 2)], "rest")
    damped, pulled = at(given, "viscous_damping", "guide", d=1.0), at(given, "constant_force", "guide", f=1.0)
    assert given.displaced([damped]) is given
    assert given.displaced([damped, pulled]) is given.unsettled
    assert {e.initial for e in given.unsettled.campaign.experiments} == {"fit"}
    displacing = {kind for kind, effect in EFFECTS.items() if effect.displaces}
    assert displacing == {"constant_force", "arm_gravity", "position_ripple", "harmonic_ripple"}


def test_play_begins_within_its_stops() -> None:
    """A stretch of metres springs back at once, and absurd speeds can make up for what that leaves."""

    def rig(play: bool) -> ia.Network:
        net = ia.Network("carts", wall=ia.Fixed(), spring=ia.SpringDamper(k=900.0, d=6.0), push=ia.Force())
        net.add(carriage=ia.Mass(m=2.0), link=ia.SpringDamper(k=700.0, d=4.0), second=ia.Mass(m=1.5))
        net.add(anchor=ia.SpringDamper(k=800.0, d=5.0))
        net.connect(net.wall.flange, net.spring.flange_a, net.anchor.flange_a)
        net.connect(net.spring.flange_b, net.carriage.flange, net.push.flange)
        net.connect(net.anchor.flange_b, net.second.flange)
        if not play:
            net.connect(net.carriage.flange, net.link.flange_a)
            return net.connect(net.link.flange_b, net.second.flange)
        net.add(gap=ia.Backlash(eps=EPS, k=1e6, d=0.0), oil=ia.Damper(d=0.02))
        net.connect(net.carriage.flange, net.gap.flange_a, net.oil.flange_a)
        net.connect(net.gap.flange_b, net.oil.flange_b, net.link.flange_a)
        return net.connect(net.link.flange_b, net.second.flange)

    def measured(seed: int) -> Record:
        pushed = sampled(Multisine(rms=12.0, low=0.5, high=6.0, period=5.0, seed=seed), 5.0, 125.0, fade=0.5)
        run = rig(True).simulate(5.0, inputs={"push.f": pushed}, step=1 / 125.0, rtol=1e-8, atol=1e-11)
        here = np.searchsorted(run.time, pushed.time + 1e-6, side="right") - 1
        noise = 1e-5 * np.random.default_rng(seed).standard_normal((2, len(here)))
        values = {
            "F": pushed.values,
            "x": run["carriage.s"][here] + noise[0],
            "y": run["second.s"][here] + noise[1],
        }
        return Record(f"run {seed}", pushed.time, values).window(1.5, 5.0)

    channels = {**CHANNELS, "y": {"output": "second.s", "unit": "m"}}
    priors = {"link.k": {"rel": 0.1}, "link.d": {"rel": 0.3}}
    entries = [{"record": measured(seed)} for seed in (1, 2)]
    given = study_of(thinned(Campaign(rig(False), channels, priors, entries, [])), Accuracy())
    play = at(given, "backlash", "link", eps=1.2 * EPS)
    found = JointFit(
        given, given.campaign.start, [replace(play, site=replace(play.site, force=30.0, spring=()))]
    ).fitted()
    for start in found.starts:
        assert abs(start["backlash_1.gap.s_rel"]) < 3 * EPS
        assert abs(start["carriage.v"]) < 2.0
    assert found.effects[0].values["eps"] == pytest.approx(EPS, rel=0.02)
    assert found.parameters["link.d"] == pytest.approx(4.0, rel=0.1)


@pytest.mark.parametrize("tied", [False, True])
def test_what_leaves_no_trace_stays_where_it_seems_to_be(tied: bool) -> None:
    """Of two states that make up for each other but for a trace, neither goes far."""
    slopes = np.array([[1.0, 1.0], [1.0, 1.0 + 1e-6]])

    def run_from(at: np.ndarray) -> Any:
        missed = np.array([1.0, 2.0]) - slopes @ at
        return SimpleNamespace(missed=missed, weighed=(missed, slopes), reach=np.ones(2))

    near = np.zeros(2) if tied else None
    begin, _ = settled(np.zeros(2), run_from, np.tile([[-np.inf], [np.inf]], 2), near=near)
    assert np.abs(begin).max() < 2.0 if tied else np.abs(begin).max() > 1e5


@pytest.mark.parametrize("push", [0.0, 1e-9, 1e-3])
def test_a_decay_begins_where_it_does_however_little_the_force_channel_holds(cart: Any, push: float) -> None:
    """With accelerations alone it seems to begin at rest, where noise of a force hardly moves the model."""
    time, records = np.arange(0.0, 4.0, 1 / 250.0), list[Record]()
    for seed, begin in ((1, -5e-3), (2, 4e-3)):
        truth, rng = cart.rig(k=820.0), np.random.default_rng(seed)
        truth.carriage.s = begin
        run = truth.simulate(time[-1], step=1 / 250.0, inputs={"push.f": 0.0}, rtol=1e-9, atol=1e-12)
        seen = np.interp(time, run.time, run["carriage.a"]) + 1e-2 * rng.standard_normal(len(time))
        records.append(Record(f"run {seed}", time, {"F": push * rng.standard_normal(len(time)), "a": seen}))
    channels = {"F": CHANNELS["F"], "a": {"output": "carriage.a", "unit": "m/s2"}}
    train, test = ([{"record": record}] for record in records)
    campaign = Campaign(cart.rig(), channels, PRIORS, train, test, noise={"a": 1e-2})
    given = study_of(thinned(campaign), Accuracy())
    found = JointFit(given, given.campaign.start).fitted()
    assert found.misfit == pytest.approx(1.0, abs=0.1)
    begins = [start["carriage.s"] for start in found.starts]
    assert begins == pytest.approx([-5e-3, 4e-3], rel=0.01)


def lagging(command: np.ndarray, width: float, ahead: float) -> np.ndarray:
    """Return what follows a command with play, as `actuator_backlash` says, from a share of it ahead."""
    at, followed = float(command[0]) + ahead * width, list[float]()
    for value in command.tolist():
        at = min(max(at, value - width), value + width)
        followed.append(at)
    return np.array(followed)


@pytest.mark.parametrize("ahead", [(1.0, 1.0, 1.0), (-1.0, 1.0, -0.4), (0.3, -0.7, 0.0)])
@pytest.mark.parametrize("began", [0.0, 40.0])
def test_an_actuator_with_play_stood_anywhere_when_a_record_in_motion_began(
    cart: Any, ahead: tuple[float, ...], began: float
) -> None:
    """Taken for the middle, or for where the command seems to come from, the width would be wrong."""
    width, time, records = 6.0, np.arange(0.0, 4.0, 1 / 250.0), list[Record]()
    for seed, share in enumerate(ahead):
        rng = np.random.default_rng(seed)
        tones = zip((0.3, 0.8, 1.9), rng.uniform(0, 2 * np.pi, 3), strict=True)
        command = 7.0 * np.sum([np.sin(2 * np.pi * f * time + phase) for f, phase in tones], axis=0)
        truth = cart.rig(k=820.0)
        truth.carriage.s, truth.carriage.v = 4e-3, -0.05
        driven = ia.Sampled(time, lagging(command, width, share))
        run = truth.simulate(
            4.0 - 1 / 250.0, step=1 / 250.0, inputs={"push.f": driven}, rtol=1e-9, atol=1e-12
        )
        here = np.searchsorted(run.time, time + 1e-6, side="right") - 1
        seen = run["carriage.s"][here] + 1e-5 * rng.standard_normal(len(time))
        records.append(Record(f"run {seed}", time + began, {"F": command, "x": seen}))
    given = study(cart, records, "fit")
    site = Site("F", "channel", "push.f", "", frozenset({"channel"}))
    play = Hypothesis(effect_of("actuator_backlash"), site, "actuator_backlash_1", {"width": 4.0})
    found = JointFit(given, given.campaign.start, [play]).fitted()
    assert found.effects[0].values["width"] == pytest.approx(width, rel=5e-3)
    assert found.misfit == pytest.approx(1.0, abs=0.1)
    assert found.parameters["spring.k"] == pytest.approx(820.0, rel=2e-3)
    assert found.own == [{}, {}, {}]  # which no record has of a parameter


@pytest.mark.parametrize("opened", [True, False])
def test_what_comes_soon_after_the_start_tells_first_where_a_record_begins(opened: bool) -> None:
    """From where what slides first slides the other way, no small step misses less of all of a record."""
    time = np.linspace(0.0, 1.0, 200)

    def run_from(start: np.ndarray | None, own: object) -> Any:
        assert start is not None
        late, slopes = time > 0.1, np.ones((200, 1))
        missed = 1.0 - start[0] - np.where(late & (start[0] < -2.0), 4.2, 0.0)
        whole = {"missed": missed, "weighed": (missed, slopes), "reach": np.ones(1)}
        short = {"missed": missed[~late], "weighed": (missed[~late], slopes[~late]), "reach": np.ones(1)}
        return SimpleNamespace(**whole, opening=SimpleNamespace(**(short if opened else whole)))

    experiment: Any = SimpleNamespace(initial="fit", unknown={}, offset=())
    _, moved = begun(experiment, lambda: np.array([-3.0]), run_from, np.zeros(1), anew=True)
    assert moved is not None
    assert moved[0] - 3.0 == pytest.approx(1.0 if opened else -2.8, abs=0.05)
