"""Laws that the missing force shows, where they hold the speed of their joint; maps, levels, points."""

from dataclasses import replace
from typing import Any

import casadi as ca
import inertance as ia
import numpy as np
import pytest
from inertance import rotational
from inertance.diagnosis.effects.effect import effect_of
from inertance.diagnosis.effects.hypothesis import Hypothesis
from inertance.diagnosis.law.aligned import aligned, loose
from inertance.diagnosis.law.axes import Axis, Grid
from inertance.diagnosis.law.drawing import Drawing
from inertance.diagnosis.law.in_place import in_place
from inertance.diagnosis.law.law import Law, rows_of
from inertance.diagnosis.law.missing_force import force_of
from inertance.diagnosis.law.polish import first_trial
from inertance.diagnosis.law.regression import own_of
from inertance.diagnosis.law.sought import judged, likely_laws, sought
from inertance.diagnosis.models.study import Study
from inertance.diagnosis.search.joint_fit import JointFit
from inertance.diagnosis.search.record_start import reach_of
from inertance.identification import Accuracy, Campaign, Filter, Multisine, Record, sampled

NOISE, RATE, SECONDS, BEGINS = 1e-4, 200.0, 6.0, 12.0
SPEEDS, WIDTH = (-0.2, 0.25), 0.01  # [rad/s]


class Clutch(ia.rotational.CompliantWithSpeed):
    """Torque that rises by 0.5 N.m at each of two speeds, where it holds the joint."""

    def equations(self) -> Any:
        yield self.tau == sum(0.25 * (ca.tanh((self.w_rel - w) / WIDTH) + np.tanh(w / WIDTH)) for w in SPEEDS)


def rotor(*parts: ia.Component, c: float = 40.0, d: float = 0.12) -> ia.Network:
    net = ia.Network("rotor", frame=rotational.Fixed(), motor=rotational.Inertia(J=0.02))
    net.add(bearing=rotational.Damper(d=d), coupling=rotational.SpringDamper(c=c, d=0.03))
    net.add(load=rotational.Inertia(J=0.03), brake=rotational.Damper(d=0.1), drive=rotational.Torque())
    net.connect(net.frame.flange, net.bearing.flange_a, net.brake.flange_a)
    net.connect(net.bearing.flange_b, net.motor.flange, net.coupling.flange_a, net.drive.flange)
    net.connect(net.coupling.flange_b, net.load.flange, net.brake.flange_b)
    for part in parts:
        net.add(extra=part)
        net.connect(net.motor.flange, net.extra.flange_a).connect(net.extra.flange_b, net.load.flange)
    return net


class Rubbing(ia.rotational.CompliantWithSpeed):
    """Torque that rises over speed, and by six times as much where the joint stands in the middle."""

    def equations(self) -> Any:
        yield self.tau == (0.2 + ca.exp(-((self.phi_rel / 0.02) ** 2))) * 0.8 * ca.tanh(self.w_rel / 0.3)


class Waves(ia.CompliantWithSpeed):
    """f = 3 N sin(2 pi s/30 mm)."""

    def equations(self) -> Any:
        yield self.f == 3 * ca.sin(2 * np.pi * self.s_rel / 0.03)


class Bulge(ia.CompliantWithSpeed):
    """f = 8 N tanh(s/4 mm)^5."""

    def equations(self) -> Any:
        yield self.f == 8 * ca.tanh(self.s_rel / 4e-3) ** 5


def cart(*parts: ia.Component, k: float = 400.0) -> ia.Network:
    net = ia.Network(
        "cart", wall=ia.Fixed(), spring=ia.SpringDamper(k=k, d=6.0), mass=ia.Mass(m=1.0), push=ia.Force()
    )
    net.connect(net.wall.flange, net.spring.flange_a)
    net.connect(net.spring.flange_b, net.mass.flange, net.push.flange)
    for part in parts:
        net.add(extra=part)
        net.connect(net.wall.flange, net.extra.flange_a).connect(net.extra.flange_b, net.mass.flange)
    return net


def campaign(part: ia.Component, offset: float = 0.0, rate: float = RATE) -> Campaign:
    """Return records that begin in motion, late by the clock, some with a zero of their own."""
    true, rng, records = cart(part, k=430.0), np.random.default_rng(2), []
    for number in range(3):
        shape = Multisine(rms=9.0 - number, low=0.4, high=4.0, period=3.0, seed=number)
        force = sampled(shape, stop=SECONDS + 1, rate=rate, fade=0.3)
        run = true.simulate(SECONDS + 1, step=1 / rate, inputs={"push.f": force})
        t = np.asarray(force.time)
        x = np.interp(t, run.time, run["mass.s"]) + NOISE * rng.standard_normal(len(t)) + number * offset
        kept = t >= 1.0
        record = Record(f"run {number}", t[kept] + BEGINS, {"F": force.values[kept], "x": x[kept]})
        records.append({"record": record} | ({"offset": ["x"]} if offset else {}))
    return Campaign(
        cart(),
        channels={"F": {"input": "push.f", "unit": "N"}, "x": {"output": "mass.s", "unit": "m"}},
        parameters={"spring.k": {"rel": 0.1}, "spring.d": {"rel": 0.2}},
        train=records[:2],
        test=records[2:],
        noise={"x": NOISE},
    )


def fitted(records: Campaign) -> tuple[Study, Any]:
    study = Study(records, Accuracy(foreseen=10**6))
    return study, JointFit(study, records.start).fitted()


@pytest.fixture(scope="module")
def slipping() -> Campaign:
    """Return records of a rotor with a clutch in its coupling."""
    return turned(Clutch())


def turned(part: ia.Component) -> Campaign:
    """Return records of a rotor with a part beside its coupling, of which one side each is measured."""
    true, rng, records = rotor(part, c=37.4, d=0.133), np.random.default_rng(4), []
    noise = {"w": 0.017, "angle": 0.005}
    for number in range(3):
        shape = Multisine(rms=1.1, low=0.3, high=8.0, period=5.0, seed=number)
        torque = sampled(shape, stop=11.0, rate=250.0, fade=0.3)
        run = true.simulate(11.0, step=4e-3, inputs={"drive.tau": torque})
        t = np.asarray(torque.time)
        seen = {"w": run["motor.w"], "angle": run["load.phi"]}
        values = {
            n: np.interp(t, run.time, v) + noise[n] * rng.standard_normal(len(t)) for n, v in seen.items()
        }
        kept = t >= 1.0
        values = {"u": torque.values[kept]} | {n: v[kept] for n, v in values.items()}
        records.append({"record": Record(f"run {number}", t[kept] + BEGINS, values)})
    channels = {"w": {"output": "motor.w", "unit": "rad/s"}, "angle": {"output": "load.phi", "unit": "rad"}}
    return Campaign(
        rotor(),
        channels={"u": {"input": "drive.tau", "unit": "N.m"}, **channels},
        parameters={name: {"rel": 0.1} for name in ("coupling.c", "bearing.d", "brake.d")},
        train=records[:2],
        test=records[2:],
        noise=noise,
    )


def test_a_law_that_holds_the_speed_is_shown_by_the_force(slipping: Campaign) -> None:
    missing = ia.missing_force(slipping, "coupling")
    law = missing.shown()
    assert law.variables == ("speed",)
    assert law.is_foreseen
    assert missing.law("speed").of_what == "what is missing"
    assert "of the missing force foreseen" in str(law)
    with pytest.raises(ia.ModelError, match="over one or two"):
        missing.shown("sped")


def clutch_at(speeds: Any) -> Any:
    return sum(0.25 * (np.tanh((speeds - w) / WIDTH) + np.tanh(w / WIDTH)) for w in SPEEDS)


def off(law: Law) -> float:
    """Return how far a law of the clutch is off between its steps [N.m rms]."""
    x = law.points[:, 0]
    away = np.all([np.abs(x - w) > 0.06 for w in SPEEDS], axis=0) & (np.abs(x) < 0.4)
    return float(np.sqrt(np.mean((law.values - clutch_at(x))[away] ** 2)))


def test_what_the_force_shows_is_a_law_of_free_runs(slipping: Campaign) -> None:
    study, base = fitted(slipping)
    missing = force_of(study, base)
    law = missing.shown()
    assert law.shown
    shown, found = judged(study, base, missing, law, {}), sought(study, base)
    assert found is not None
    for one in (shown, found):
        assert one.law is not None, one.refused
        assert one.model is not None
        assert (one.law.site.path, one.law.variables) == ("coupling", ("speed",))
        assert one.model.misfit < 1.2 < 0.5 * base.misfit
        assert off(one.law) < 0.1 * np.ptp(clutch_at(np.linspace(-0.4, 0.4)))
    assert found.law is not None
    assert off(found.law) < 0.06


def test_a_state_that_leaves_no_trace_stays_where_it_is(slipping: Campaign) -> None:
    """Both sides begin at one speed where a law holds them: how far apart is told by nothing that is seen."""
    law = ia.missing_force(slipping, "coupling").shown()
    for run in first_trial(law.runs[0].bench.study, law).runs:
        columns, shared, priors = run.columns()
        moved = own_of(columns[:, :, 0], columns[:, :, 1 + shared :], priors)
        assert (np.abs(moved) <= reach_of(run.experiment, run.found)).all()


def test_a_map_is_tried_after_the_curve_of_one_variable() -> None:
    missing = ia.missing_force(turned(Rubbing()), "coupling")
    assert missing.shown().variables == ("speed",)
    likely = [law.variables for law in likely_laws(missing, missing.shown())]
    assert likely == [("speed",), ("position", "speed")]


def test_one_law_takes_the_place_of_effects_whatever_it_foresees() -> None:
    """Begun as the effects have it, though the records foresee nothing of it."""
    study, base = fitted(campaign(Bulge()))
    site = next(s for s in study.sites if s.path == "spring")
    parts = [
        Hypothesis(effect_of(kind), site, f"{kind}_1", values)
        for kind, values in (
            ("cubic_stiffness", {"k3": 2e6}),
            ("position_ripple", {"f_sin": 0.5, "f_cos": 0.1, "period": 0.02}),
        )
    ]
    joint = JointFit(study, base.parameters, parts)
    model = joint.fitted()
    found = in_place(study, model, model.effects, base)
    assert found is not None
    assert found.law is not None, found.refused
    assert found.model is not None
    assert found.law.variables == ("position",)
    assert found.model.misfit < model.misfit
    assert found.before is base


def test_the_level_of_a_law_that_zeros_of_sensors_make_up_for_is_told_unknown() -> None:
    known, unknown = (ia.missing_force(campaign(Bulge(), offset)).law("position") for offset in (0.0, 1e-3))
    assert known.level_known
    assert not unknown.level_known
    assert np.median(unknown.standard_error) < 0.2 * np.ptp(unknown.values)
    assert any("but for a constant" in trait for trait in unknown.traits)
    assert not any("but for a constant" in trait for trait in known.traits)


def test_records_whose_level_nobody_knows_are_aligned() -> None:
    """A zero of a sensor, a constant force and where the cart is are one, in each record another."""
    missing = ia.missing_force(campaign(Waves(), 4e-3), "spring")
    settled = missing.settled
    assert settled.misfit < 1.2
    assert settled.levels_known == (False, False)
    one = loose(settled, 1)
    assert one is not None
    assert one.shift == pytest.approx(-1 / missing.parameters["spring.k"], rel=0.05)
    run, force = one.moved(4.0)
    assert run.left.std() < 1.2  # the record says nothing of it
    runs, forces = (settled.runs[0], run), (settled.forces[0], force)
    off = replace(settled, runs=runs, forces=forces)
    drawn, apart, again = (
        Drawing(missing.site, some).law(("position",)) for some in (settled, off, aligned(off))
    )
    assert drawn.explained > 0.99 > 0.9 > apart.explained
    assert again.explained == pytest.approx(drawn.explained, abs=0.01)
    levels = [[f.values.mean() for f in some.forces] for some in (settled, aligned(off))]
    assert np.diff(levels[1]) == pytest.approx(np.diff(levels[0]), abs=0.6)
    assert len(again.forces[1]) == len(again.runs[1].t)
    beside = aligned(off).beside(again.fit.moved)
    assert [f.mean() for f in beside] == pytest.approx(levels[1], abs=1e-6)


def test_records_that_tell_the_level_stay_as_they_are() -> None:
    settled = ia.missing_force(campaign(Waves()), "spring").settled
    assert settled.levels_known == ()
    assert loose(settled, 0) is None
    assert aligned(settled) is settled


def test_the_missing_force_hears_the_noise_that_a_filter_lets_through() -> None:
    """Read off the empty top of a low-passed spectrum it would be a hundredth, and all of it a force."""
    known, low, rng = campaign(Bulge(), rate=1000.0), Filter(cutoff=150.0), np.random.default_rng(1)

    def passed(record: Record) -> dict[str, Record]:
        x = record.values["x"] + low.apply(4e-4 * rng.standard_normal(len(record.time)), 1000.0)
        step = np.ptp(x) / 2**16
        return {"record": replace(record, values={**record.values, "x": step * np.round(x / step)})}

    records = [passed(experiment.record) for experiment in known.experiments]
    seen = Campaign(cart(), known.channels, known.parameters, train=records[:2], test=records[2:])
    heard = ia.missing_force(seen, "spring")
    assert heard.search.study.campaign.floors["x"].sigma == pytest.approx(4e-4 * 0.3**0.5, rel=0.2)
    assert heard.misfit < 1.2
    assert heard.law("position").explained > 0.95


def test_a_map_holds_its_ends() -> None:
    points = np.array([-1.0, 0.0, 2.0])
    grid = Grid((Axis("position", points), Axis("speed", points)))
    values = np.arange(9.0)
    rows = np.array(rows_of(grid, values))
    table = rows[:, 2].reshape(5, 5)
    assert rows[:, 0].min() == -4.0
    assert rows[:, 0].max() == 5.0
    assert (table[1:-1, 1:-1].ravel() == values).all()
    assert (table[0] == table[1]).all()
    assert (table[:, -1] == table[:, -2]).all()


@pytest.mark.parametrize("variable", ["position", "speed"])
def test_a_curve_holds_the_ends_at_which_it_pushes(variable: str) -> None:
    grid = Grid((Axis(variable, np.array([-1.0, 0.0, 1.0])),))
    pulls, pushes, bump = ([-1.0, 0.0, 1.0], [1.0, 0.0, -1.0], [0.0, 1.0, 0.0])
    assert rows_of(grid, np.array(pulls)) == [(-1.0, -1.0), (0.0, 0.0), (1.0, 1.0)]
    assert rows_of(grid, np.array(pushes)) == [(-2.0, 1.0), (-1.0, 1.0), (0.0, 0.0), (1.0, -1.0), (2.0, -1.0)]
    assert rows_of(grid, np.array(bump))[-1] == (2.0, 0.0)


@pytest.mark.parametrize(("variable", "reached"), [("position", "body.phi"), ("speed", "body.w")])
def test_a_machine_beyond_a_curve_that_pushes_meets_what_is_at_its_end(variable: str, reached: str) -> None:
    """The points of speed are uneven, and those of position smooth, as in a diagnosis."""
    points = np.concatenate([-np.geomspace(5, 0.01, 15), [0.0], np.geomspace(0.01, 4, 12)])
    axis = Axis(
        variable, np.linspace(-3.0, 0.7, 24) if variable == "position" else points, variable == "position"
    )
    values = 0.2 * np.sin(6 * axis.points) - 0.3 * axis.points
    kinds: Any = {"over": variable} | ({"interpolation": "smooth"} if axis.smooth else {})
    part = rotational.TabulatedForce(table=rows_of(Grid((axis,)), values), **kinds)
    net = ia.Network("turned", wall=rotational.Fixed(), part=part, body=rotational.Inertia(J=0.02))
    net.add(drive=rotational.Torque(), brake=rotational.Damper(d=0.4))
    net.connect(net.wall.flange, part.flange_a, net.brake.flange_a)
    net.connect(part.flange_b, net.body.flange, net.brake.flange_b, net.drive.flange)
    run = net.simulate(8.0, step=0.01, inputs={"drive.tau": lambda t: 5.0})
    beyond = run["part.tau"][run[reached] > axis.points[-1] + 0.2]
    assert len(beyond) > 100
    assert beyond == pytest.approx(values[-1], rel=1e-7)  # a table has eight digits


def test_more_points_change_nothing_of_a_law(slipping: Campaign) -> None:
    law = ia.missing_force(slipping).law("speed")
    finer = law.finer()
    assert len(finer.values) == len(finer.standard_error) == 2 * len(law.values) - 1
    for motion in law.motions:
        assert finer.along(motion) == pytest.approx(law.along(motion), abs=1e-9 * np.ptp(law.values))
    assert finer.traits
    most = replace(law.grid.axes[0], points=np.linspace(-1.0, 1.0, 150))
    crowded = replace(law, fit=replace(law.fit, grid=Grid((most,)), values=np.zeros(150)))
    assert crowded.finer() is crowded
