"""Records that begin in motion, sensors with offsets, models without states, effects at their least size."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.diagnosis import Verdict
from inertance.diagnosis.criteria import SOLVER_STEPS_PER_SAMPLE
from inertance.diagnosis.effects.effect import effect_of
from inertance.diagnosis.effects.hypothesis import Hypothesis, with_effects
from inertance.diagnosis.effects.sites import sites_of
from inertance.diagnosis.models.study import quiet, study_of, thinned
from inertance.diagnosis.search.joint_fit import JointFit
from inertance.diagnosis.search.record_start import projected
from inertance.identification import Accuracy, Campaign, Filter, Multisine, Record, sampled
from inertance.identification.fitting.campaign_model import start_of

CHANNELS = {
    "F": {"input": "push.f", "unit": "N"},
    "x": {"output": "carriage.s", "unit": "m"},
}
PRIORS = {"spring.k": {"rel": 0.1}, "guide.d": {"rel": 0.3}}
RATE, NOISE = 250.0, 1e-5


@pytest.fixture(scope="module")
def cart(carriage: Callable[..., Any]) -> Any:
    return carriage(rate=RATE, duration=6.0, noise=NOISE)


def cut(record: Record, begin: float, end: float) -> Record:
    """Return a record from the middle of one, on a clock of its own."""
    inside = (record.time >= begin) & (record.time <= end)
    time = record.time[inside] - record.time[inside][0]
    return Record(record.name, time, {name: values[inside] for name, values in record.values.items()})


def shaken(truth: ia.Network, frequency: float, seed: int, force: float = 30.0) -> Record:
    """Return a sine of force and its answer, begun in mid-motion."""
    time = np.arange(0.0, 4.0, 1 / RATE)
    drive = ia.Sampled(time, force * np.sin(2 * np.pi * frequency * time))
    run = truth.simulate(float(time[-1]), inputs={"push.f": drive}, step=1 / RATE, rtol=1e-8, atol=1e-11)
    x = run["carriage.s"][np.searchsorted(run.time, time + 1e-6, side="right") - 1]
    noise = NOISE * np.random.default_rng(seed).standard_normal(len(x))
    return cut(Record(f"sine {frequency:g} Hz", time, {"F": drive.values, "x": x + noise}), 1.03, 3.5)


def hardening(k: float) -> ia.Network:
    net = ia.Network("hardening", wall=ia.Fixed(), spring=ia.CubicSpring(k=k, k3=4e8), guide=ia.Damper(d=6.0))
    net.add(carriage=ia.Mass(m=2.0), push=ia.Force())
    net.connect(net.wall.flange, net.spring.flange_a, net.guide.flange_a)
    return net.connect(net.carriage.flange, net.spring.flange_b, net.guide.flange_b, net.push.flange)


def verdict_on(cart: Any, records: list[Record], budget: float | None = None, **entries: Any) -> Verdict:
    *train, test = [{"record": record, **entries} for record in records]
    campaign = Campaign(cart.rig(), CHANNELS, PRIORS, train, [test], noise={"x": NOISE})
    return ia.diagnose(campaign, budget=budget)


def test_sines_of_a_hardening_spring_begin_in_motion() -> None:
    """A linear answer to the start left 0.2 of the signal, for which no effect was found."""
    *train, test = [
        {"record": shaken(hardening(4100.0), f, n, force=60.0)} for n, f in enumerate((7.0, 10.0, 13.0, 9.0))
    ]
    campaign = Campaign(hardening(4000.0), CHANNELS, PRIORS, train, [test], noise={"x": NOISE})
    found = ia.diagnose(campaign)
    assert found.verdict in ("none", "parameters")
    assert found.parameters["spring.k"] == pytest.approx(4100.0, rel=2e-3)


@pytest.mark.parametrize("begin", [0.83, 1.57, 2.21])
def test_a_record_that_begins_in_motion_is_no_cause(cart: Any, begin: float) -> None:
    records = [cut(cart.measured(cart.rig(k=820.0), seed), begin, 5.0) for seed in (1, 2, 3)]
    found = verdict_on(cart, records)
    assert found.verdict in ("none", "parameters")
    assert found.parameters["spring.k"] == pytest.approx(820.0, rel=2e-3)


def test_friction_is_found_in_sines_that_begin_in_motion(cart: Any) -> None:
    """And a budget that suffices is not spoken of."""
    records = [shaken(cart.rubbing(), f, n) for n, f in enumerate((2.0, 3.5, 2.7))]
    found = verdict_on(cart, records, budget=600.0)
    assert [(p.effect.kind, p.site.path) for p in found.effects] == [("coulomb_friction", "guide")]
    assert found.effects[0].values["f_c"] == pytest.approx(0.8, rel=0.05)
    assert not any("budget" in note for note in found.notes)


def test_an_offset_that_is_given_is_no_cause(cart: Any) -> None:
    def lifted(seed: int) -> Record:
        record: Record = cart.measured(cart.rig(k=820.0), seed)
        return replace(record, values={**record.values, "x": record.values["x"] + seed * 1e-3})

    found = verdict_on(cart, [lifted(seed) for seed in (1, 2, 3)], offset=["x"])
    assert found.verdict in ("none", "parameters")


@pytest.mark.parametrize(
    ("entries", "stage", "told"),
    [({"shooting": 1.0}, (), "shooting is for fits"), ({}, ({"channels": ["x"]},), "[[stage]] is for fits")],
)
def test_what_a_diagnosis_would_leave_out_is_refused(
    cart: Any, entries: dict[str, Any], stage: tuple[dict[str, Any], ...], told: str
) -> None:
    train = [{"record": cart.measured(cart.rig(), 1), **entries}]
    campaign = Campaign(cart.rig(), CHANNELS, PRIORS, train, noise={"x": NOISE}, stage=stage)
    with pytest.raises(ia.ModelError) as caught:
        ia.diagnose(campaign)
    assert told in str(caught.value)


def strut(friction: float = 0.0) -> ia.Network:
    """Return a strut on a test rig: its motion is prescribed, its force is measured."""
    net = ia.Network("strut", frame=ia.Fixed(), cell=ia.ForceSensor(), drive=ia.Position())
    net.add(spring=ia.Spring(k=2e3), damper=ia.Damper(d=50.0))
    net.connect(net.frame.flange, net.cell.flange_a)
    net.connect(net.cell.flange_b, net.spring.flange_a, net.damper.flange_a)
    net.connect(net.spring.flange_b, net.damper.flange_b, net.drive.flange)
    if friction:
        net.add(seal=ia.CoulombFriction(f_c=friction))
        net.connect(net.cell.flange_b, net.seal.flange_a)
        net.connect(net.seal.flange_b, net.drive.flange)
    return net


def stroke(truth: ia.Network, frequency: float, seed: int) -> Record:
    time = np.arange(0.0, 4.0, 1 / RATE)
    motion = ia.Sampled(time, 0.02 * np.sin(2 * np.pi * frequency * time))
    run = truth.simulate(float(time[-1]), inputs={"drive.s_ref": motion}, step=1 / RATE)
    force = run["cell.f"][np.searchsorted(run.time, time + 1e-6, side="right") - 1]
    noise = 0.05 * np.random.default_rng(seed).standard_normal(len(force))
    return Record(f"stroke {frequency:g} Hz", time, {"s": motion.values, "F": force + noise})


@pytest.fixture
def bench() -> Callable[..., Campaign]:
    def campaign(friction: float, **how: Any) -> Campaign:
        strokes = [stroke(strut(friction), f, n) for n, f in enumerate((0.7, 1.9, 1.1))]
        records = [{"record": record, **how} for record in strokes]
        channels = {"s": {"input": "drive.s_ref", "unit": "m"}, "F": {"output": "cell.f", "unit": "N"}}
        priors = {"spring.k": {"rel": 0.1}, "damper.d": {"rel": 0.3}}
        return Campaign(strut(), channels, priors, records[:2], records[2:], noise={"F": 0.05})

    return campaign


def test_a_model_without_states_is_fitted_and_diagnosed(bench: Callable[..., Campaign]) -> None:
    assert not strut().dae().state_names
    assert ia.fit(bench(0.0)).values["spring.k"] == pytest.approx(2e3, rel=1e-3)
    assert ia.diagnose(bench(0.0)).verdict == "none"
    for how in ({}, {"initial": "rest"}):
        found = ia.diagnose(bench(3.0, **how))
        assert found.verdict == "effect"
        assert found.effects[0].effect.kind == "coulomb_friction"
        assert found.effects[0].values["f_c"] == pytest.approx(3.0, rel=0.02)


def test_a_budget_ends_a_diagnosis_and_says_what_it_left_out(cart: Any) -> None:
    records = [{"record": cart.measured(cart.rubbing(), seed)} for seed in (1, 2)]
    campaign = Campaign(cart.rig(), CHANNELS, PRIORS, records[:1], records[1:], noise={"x": NOISE})
    found = ia.diagnose(campaign, budget=1e-3)
    assert found.verdict == "interrupted"
    assert not found.effects
    assert any("budget of 0.001 s ended" in note for note in found.notes)


def test_an_added_mass_may_be_as_small_as_it_likes(cart: Any) -> None:
    effect = effect_of("added_inertia")
    site = next(s for s in sites_of(cart.rig()) if effect.place in s.places)
    least = {q.name: q.low for q in effect.quantities[site.domain]}
    with_effects(cart.rig(), [Hypothesis(effect, site, "more", least)]).dae()


def test_slopes_that_cannot_be_followed_are_told(cart: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    def singular(*_: Any) -> None:
        raise np.linalg.LinAlgError("Singular matrix")

    dae = cart.rig(k=1e9).dae()
    run = ia.simulate(dae, 1.0, inputs={"push.f": 1.0})
    monkeypatch.setattr(np.linalg, "solve", singular)
    with pytest.raises(ia.SimulationError, match="beyond what can be followed"):
        ia.Variations(dae, ["carriage.s"], ["spring.k"]).along(run)


@pytest.mark.parametrize(("rate", "noise"), [(50.0, 1e-5), (250.0, 1e-4), (20e3, 1e-4), (20e3, 1e-3)])
def test_how_fast_a_record_begins_is_seen_at_any_rate(rate: float, noise: float) -> None:
    """Twenty samples are a period of the motion at 50 Hz, and nothing but noise at 20 kHz."""
    rng, missed = np.random.default_rng(4), []
    for _ in range(20):
        time, omega, phase = np.arange(0.0, 4.0, 1 / rate), rng.uniform(12, 30), rng.uniform(0, 2 * np.pi)
        signal = 0.01 * np.sin(omega * time + phase) + noise * rng.standard_normal(len(time))
        speed, value = start_of(time, signal)
        assert value == pytest.approx(0.01 * np.sin(phase), abs=4e-3)
        missed.append((speed - 0.01 * omega * np.cos(phase)) / (0.01 * omega))
    assert np.std(missed) < 1.0  # of the peak speed


def test_a_record_that_grows_beyond_bounds_is_told(cart: Any) -> None:
    with pytest.raises(ia.SimulationError, match="grows beyond bounds"):
        projected(np.ones((4, 1)), np.array([[1.0], [np.inf], [0.0], [1.0]]))


def test_only_fast_noise_is_taken_off_an_input() -> None:
    rng, time = np.random.default_rng(5), np.arange(0.0, 8.0, 1e-3)
    slow, smooth = np.sin(2 * np.pi * 3 * time), Filter(cutoff=125.0)
    noisy = slow + 0.01 * rng.standard_normal(len(time))
    assert np.std(quiet(noisy, smooth, 1e3) - slow) < 0.6 * 0.01
    chirping = slow + 0.05 * np.sin(2 * np.pi * 200 * time)
    assert np.array_equal(quiet(chirping, smooth, 1e3), chirping)
    square = np.sign(slow)
    assert np.array_equal(quiet(square, smooth, 1e3), square)
    coarse = np.asarray(np.round(slow[83:], 3), dtype=float)  # begins in motion, where filters swing
    assert np.std((quiet(coarse, smooth, 1e3) - slow[83:])[100:-100]) < 0.6 * np.std(coarse - slow[83:])


def two_bodies(k3: float) -> ia.Network:
    """Return two bodies that roll away together, the first pushed, the second measured."""
    net = ia.Network("train", rail=ia.Fixed(), push=ia.Force(), first=ia.Mass(m=1.0), carriage=ia.Mass(m=2.0))
    net.add(coupling=ia.CubicSpring(k=900.0, k3=k3), oil=ia.Damper(d=20.0), wheels=ia.Damper(d=0.5))
    net.connect(net.push.flange, net.first.flange, net.coupling.flange_a, net.oil.flange_a)
    net.connect(net.coupling.flange_b, net.oil.flange_b, net.carriage.flange, net.wheels.flange_b)
    return net.connect(net.rail.flange, net.wheels.flange_a)


def test_where_a_stiffening_machine_begins_is_known_from_the_model_before() -> None:
    """A body that is not measured seems to be at 0, half a metre off, where the spring would tear it away."""

    def record(seed: int) -> dict[str, Record]:
        drive = sampled(Multisine(rms=10.0, low=0.3, high=8.0, period=5.0, seed=seed), 8.0, 250.0)
        run = two_bodies(3e5).simulate(8.0, inputs={"push.f": drive}, step=1 / 250.0, rtol=1e-8, atol=1e-11)
        x = run["carriage.s"][np.searchsorted(run.time, drive.time + 1e-6, side="right") - 1]
        noise = 1e-4 * np.random.default_rng(seed).standard_normal(len(x))
        return {
            "record": cut(Record(f"run {seed}", drive.time, {"F": drive.values, "x": 0.5 + x + noise}), 2, 7)
        }

    priors = {"coupling.k": {"rel": 0.1}, "wheels.d": {"rel": 0.3}}
    train, test = [record(1), record(2)], [record(3)]
    campaign = Campaign(two_bodies(0.0), CHANNELS, priors, train, test, noise={"x": 1e-4})
    study = study_of(thinned(campaign), Accuracy("compiled", 1e-7))
    base = JointFit(study, campaign.start).fitted()
    site = next(site for site in study.sites if site.path == "coupling")
    stiffening = Hypothesis(effect_of("cubic_stiffness"), site, "more", {"k3": 2.7e5})
    assert JointFit(study, base.parameters, [stiffening], base).fitted().misfit < 1.1


def test_effects_are_granted_steps_by_what_the_model_takes(
    cart: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where samples are far apart, friction that sticks and slips between them takes many times more."""
    slow = np.arange(0.0, 60.1, 0.5)
    net = cart.rig(d=200.0)
    pushed = 20 * np.sin(1.1 * slow)
    record = Record("slow", slow, {"F": pushed, "x": pushed / 800})
    study = study_of(
        thinned(Campaign(net, CHANNELS, {"spring.k": {"rel": 0.1}}, [{"record": record}])),
        Accuracy("auto", 1e-6),
    )
    taken = study.steps_per_sample()
    assert 2.5 < taken < SOLVER_STEPS_PER_SAMPLE
    assert study.granting_steps().accuracy.steps == round(20 * taken)
    monkeypatch.setattr(type(study), "steps_per_sample", lambda _: 1.0)
    assert study.granting_steps().accuracy.steps == SOLVER_STEPS_PER_SAMPLE


def stepped(truth: ia.Network, seed: int) -> Record:
    """Return random steps of a force that is held for 0.2 s each, and their answer."""
    rng = np.random.default_rng(seed)
    time = np.arange(0.0, 6.0, 5e-3)
    held = np.repeat(30.0 * rng.standard_normal(30), 40)
    drive = ia.Sampled(time, held, interpolation="hold")
    run = truth.simulate(float(time[-1]), inputs={"push.f": drive}, step=5e-3, rtol=1e-8, atol=1e-11)
    x = run["carriage.s"][np.searchsorted(run.time, time + 1e-6, side="right") - 1]
    return Record(f"steps {seed}", time, {"F": held, "x": x + NOISE * rng.standard_normal(len(time))})


@pytest.mark.parametrize("friction", [0.0, 2.0])
def test_friction_is_found_under_commands_that_are_held(cart: Any, friction: float) -> None:
    """Each step cuts a run where no mode switches."""
    truth = cart.rig(k=4100.0)
    if friction:
        truth.add(rail=ia.CoulombFriction(f_c=friction))
        truth.connect(truth.wall.flange, truth.rail.flange_a).connect(
            truth.rail.flange_b, truth.carriage.flange
        )
    *train, test = [{"record": stepped(truth, seed), "initial": "rest"} for seed in (1, 2, 3)]
    channels = {**CHANNELS, "F": {**CHANNELS["F"], "interpolation": "hold"}}
    found = ia.diagnose(Campaign(cart.rig(), channels, PRIORS, train, [test], noise={"x": NOISE}))
    assert [placed.effect.kind for placed in found.effects] == ["coulomb_friction"] * bool(friction)
    assert found.verdict in ({"effect", "ambiguous"} if friction else {"parameters"})
