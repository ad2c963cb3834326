"""Effects: where they can be, and that each can be put in and taken for what it is."""

from dataclasses import replace
from typing import Any
from unittest.mock import patch

import inertance as ia
import numpy as np
import pytest
from inertance import rotational
from inertance.diagnosis.effects.edits import edited
from inertance.diagnosis.effects.effect import EFFECTS, Effect, Motion, Quantity, effect_of, register
from inertance.diagnosis.effects.hypothesis import Hypothesis, driven, sensed
from inertance.diagnosis.effects.sites import GROUND, Site, sites_of
from inertance.diagnosis.models.probes import scaled
from inertance.diagnosis.models.study import study_of
from inertance.diagnosis.search.score_test import _forces, screen
from inertance.identification import Accuracy, Campaign, Experiment, Record
from inertance.machines import Sinusoid, ge_wang


def rig() -> ia.Network:
    return ia.machines.inerter_rig(ge_wang.planetary_inerter(regularised=0.1), Sinusoid(0.01, 3.0))


def cart() -> ia.Network:
    net = ia.Network(
        "carts", wall=ia.Fixed(), k1=ia.Spring(k=1e3), d1=ia.Damper(d=1.0), one=ia.Mass(m=1.0),
        k2=ia.Spring(k=1e3), two=ia.Mass(m=2.0), push=ia.Force(f=lambda t: 10 * np.sin(20 * t)),
    )  # fmt: skip
    net.connect(net.wall.flange, net.k1.flange_a, net.d1.flange_a)
    net.connect(net.k1.flange_b, net.d1.flange_b, net.one.flange, net.k2.flange_a, net.push.flange)
    return net.connect(net.k2.flange_b, net.two.flange)


def test_sites_of_carts() -> None:
    found = {site.path: site for site in sites_of(cart())}
    assert set(found) == {"d1", "k1", "one", "k2", "two"}
    assert found["d1"].same == ("k1", "one")
    assert found["k1"].places == {"series", "loaded"}
    assert found["one"].places == {"node"}
    assert found["two"].places == {"node", "across"}
    assert found["two"].fixed == GROUND


def test_sites_of_an_inerter_are_named_by_the_deepest_part() -> None:
    found = {site.path: site for site in sites_of(rig())}
    assert "inerter" in found["inerter.screw"].same
    assert found["inerter.screw.friction"].domain == "rotational"
    assert not any("actuator" in path or "frame" in path for path in found)


def row_of(**between: ia.Component) -> list[Site]:
    """Return the sites of parts in a row from a wall to a mass."""
    net = ia.Network("row", wall=ia.Fixed(), mass=ia.Mass(m=1.0), **between)
    ports = [net.wall.flange, *(p for one in between.values() for p in (one.flange_a, one.flange_b))]
    ports.append(net.mass.flange)
    for one, other in zip(ports[::2], ports[1::2], strict=True):
        net.connect(one, other)
    return sites_of(net)


def line_of(**between: ia.Component) -> dict[str, tuple[str, ...]]:
    """Return, by site, what is in one line with it, of such a row."""
    return {site.path: site.line for site in row_of(**between)}


def test_what_bears_one_force_is_in_one_line() -> None:
    strut, inerter = ia.SpringDamper(k=1e3, d=1.0), ia.Inerter(b=2.0)
    assert line_of(strut=strut, inerter=inerter) == {"strut": ("inerter",), "inerter": ("strut",), "mass": ()}
    three = line_of(one=ia.Spring(k=1.0), two=ia.Damper(d=1.0), last=ia.Inerter(b=1.0))
    assert three["two"] == ("last", "one")


def test_a_site_yields_where_a_part_that_bears_its_force_has_a_stiffness() -> None:
    sprung = {site.path: site.yields for site in row_of(strut=ia.Spring(k=1e3), inerter=ia.Inerter(b=2.0))}
    assert sprung == {"strut": True, "inerter": True, "mass": False}
    oil, loose = ia.Damper(d=1.0), ia.SpringDamper(k=0.0, d=1.0)
    assert not any(site.yields for site in row_of(oil=oil, loose=loose, inerter=ia.Inerter(b=2.0)))
    screw = {site.path: site.yields for site in sites_of(rig())}
    assert screw["inerter.screw.contact"]
    assert screw["inerter.screw"]
    assert not screw["inerter.flywheel"]
    sites, plain, flanks = sites_of(rig()), effect_of("backlash"), effect_of("elastic_backlash")
    only_play = {site.path for site in sites if plain.may_act(site) and not flanks.may_act(site)}
    assert only_play == {"inerter.screw", "inerter.screw.contact"}
    assert any(flanks.may_act(site) for site in sites)


def test_what_a_body_or_a_sensor_parts_is_in_no_line() -> None:
    assert not any(site.line for site in sites_of(cart()))
    parted = line_of(strut=ia.Spring(k=1e3), cell=ia.ForceSensor(), inerter=ia.Inerter(b=2.0))
    assert not any(parted.values())


class ForceLimitingSpring(ia.Spring):
    """A user's element, named like a source."""


class Shaker(ia.Force):
    """A user's source, named like none."""


def test_an_element_is_a_site_by_what_it_is_not_by_its_name() -> None:
    net = ia.Network(
        "named",
        wall=ia.Fixed(),
        spring=ForceLimitingSpring(k=1e3),
        rod=ia.Rod(),
        sensor=ia.ForceSensor(),
        mass=ia.Mass(m=1.0),
        seen=ia.SpeedSensor(),
        push=Shaker(f=1.0),
    )
    net.connect(net.wall.flange, net.spring.flange_a).connect(net.spring.flange_b, net.rod.flange_a)
    net.connect(net.rod.flange_b, net.sensor.flange_a)
    net.connect(net.sensor.flange_b, net.mass.flange, net.seen.flange, net.push.flange)
    assert {site.path for site in sites_of(net)} == {"spring", "mass"}


@pytest.mark.parametrize("kind", [k for k, effect in EFFECTS.items() if effect.place != "channel"])
def test_every_effect_fits_every_site_and_runs(kind: str) -> None:
    effect, net = effect_of(kind), cart()
    for site in sites_of(net):
        if effect.place not in site.places or site.domain not in effect.quantities:
            continue
        scaled = replace(site, force=20.0, travel=0.02, speed=0.4)
        values = {q.name: max(0.01, q.low) for q in effect.quantities[site.domain]}
        assert effect.edits is not None
        edits = effect.edits(scaled, "extra", values)
        run = edited(net, edits).simulate(0.05)
        assert np.isfinite(run["one.s"]).all()
        scope = {"net": net.clone()}
        exec("from inertance import *", scope)
        exec("\n".join(map(str, edits)), scope)
        again = scope["net"].simulate(0.05)
        assert again["one.s"] == pytest.approx(run["one.s"], abs=1e-12)


ACROSS = [
    kind
    for kind, effect in EFFECTS.items()
    if effect.basis and effect.place in ("across", "loaded") and "translational" in effect.quantities
]


@pytest.mark.parametrize("kind", ACROSS)
def test_the_basis_is_the_force_of_the_component(kind: str) -> None:
    """Between the ground and a prescribed motion the component's force is its basis times its sizes."""
    effect = effect_of(kind)
    if kind == "lugre_friction":
        shown_by_basis(effect, {"f_c": 0.3, "f_s": 0.3, "v_s": 0.7, "s_p": 0.9})
        shown_by_basis(effect, {"f_c": 0.3, "f_s": 0.5, "v_s": 0.7, "s_p": 0.0004})
    else:
        quantities = effect.quantities["translational"]
        shown_by_basis(effect, {q.name: max(0.3 + 0.2 * i, q.low) for i, q in enumerate(quantities)})


def shown_by_basis(effect: Effect, values: dict[str, float]) -> None:
    net = ia.Network("probe", wall=ia.Fixed(), probe=ia.Damper(d=0.0), drive=ia.Position(s_ref=np.sin))
    net.connect(net.wall.flange, net.probe.flange_a).connect(net.probe.flange_b, net.drive.flange)
    site = Site(
        "probe",
        "translational",
        "probe.flange_b",
        "probe.flange_a",
        frozenset({"across", "loaded"}),
        speed=0.7,
        rubs=True,
    )
    t = np.linspace(0, 6, 2001)
    motion = Motion(t, np.sin(t), np.cos(t), np.zeros_like(t), -np.sin(t))
    shape = {q.name: values[q.name] for q in effect.quantities["translational"] if q.shape}
    assert effect.basis is not None
    assert effect.edits is not None
    columns = effect.basis(motion, shape)
    sizes = [values[q.name] for q in effect.sizes("translational")]
    expected = np.dot(sizes, columns)
    run = edited(net, effect.edits(site, "extra", values)).simulate(6.0, step=3e-3)
    force = np.interp(t, run.time, run["drive.flange.f"])
    slow = np.abs(motion.v) < 0.05
    if effect.kind == "load_dependent_friction":
        assert force == pytest.approx(0, abs=1e-9)  # the probe carries no load
    else:
        assert force[~slow] == pytest.approx(-expected[~slow], abs=0.02) or force[~slow] == pytest.approx(
            expected[~slow], abs=0.02
        )


@pytest.mark.parametrize("n", [1.0, 1.7, 2.0, 4.0])
def test_hysteresis_is_screened_as_sharply_as_it_yields(n: float) -> None:
    net = ia.Network("probe", wall=ia.Fixed(), drive=ia.Position(s_ref=lambda t: 0.3 * t * np.sin(2 * t)))
    net.add(law=ia.BoucWen(k=1.0, alpha=0.0, beta=0.5 / 0.4**n, gamma=0.5 / 0.4**n, n=n))
    net.connect(net.wall.flange, net.law.flange_a).connect(net.law.flange_b, net.drive.flange)
    run = net.simulate(6.0, step=1e-2, rtol=1e-9, atol=1e-11)
    motion = Motion(run.time, run["law.s_rel"], run["law.v_rel"], run["law.f"], run["law.f"])
    basis = effect_of("hysteresis").basis
    assert basis is not None
    assert basis(motion, {"s_y": 0.4, "n": n})[0] == pytest.approx(run["law.z"], abs=2e-3)


def test_gravity_acts_from_the_ground_alone() -> None:
    net = ia.Network(
        "arms", wall=rotational.Fixed(), pivot=rotational.Damper(d=0.1), upper=rotational.Inertia(J=1.0),
        elbow=rotational.Damper(d=0.1), fore=rotational.Inertia(J=0.5),
    )  # fmt: skip
    net.connect(net.wall.flange, net.pivot.flange_a).connect(net.pivot.flange_b, net.upper.flange)
    net.connect(net.upper.flange, net.elbow.flange_a).connect(net.elbow.flange_b, net.fore.flange)
    t = np.linspace(0.0, 1.0, 50)
    motion = Motion(t, 2 + np.sin(t), np.cos(t), np.sin(t), -np.sin(t))
    tried = {
        site.path: {effect.kind: column for effect, _, column in _forces(site, motion, [motion], "push")}
        for site in sites_of(net)
    }
    assert {path for path, found in tried.items() if "arm_gravity" in found} == {"pivot", "fore"}
    assert all("constant_force" in tried[path] for path in ("pivot", "elbow", "fore"))
    gravity = np.column_stack([np.sin(motion.s), np.cos(motion.s)])  # of the angle itself, wherever it rests
    assert tried["pivot"]["arm_gravity"] == pytest.approx(gravity)


def test_where_a_site_rests_is_told_by_a_record_from_rest_or_else_by_the_mean() -> None:
    """A free decay begins far from where it ends; points crowd at its begin."""
    t = np.concatenate([np.linspace(0, 1e-3, 500), np.linspace(2e-3, 10.0, 5000)])
    decay = Motion(t, 0.1 + np.exp(-t) * np.cos(20 * t), -np.sin(t), t, t)
    still = Motion(t, 0.3 + np.sin(t) ** 2, np.sin(t), t, t)
    site = sites_of(cart())[0]
    assert scaled(site, [decay], None).rest == pytest.approx(0.1, abs=0.01)
    found = scaled(site, [decay, still], 1)
    assert found.rest == pytest.approx(0.3)
    assert found.middle == pytest.approx((min(decay.s) + max(still.s)) / 2)


def test_a_richer_law_begins_from_what_its_special_case_gave() -> None:
    site = replace(sites_of(cart())[0], travel=0.1)
    ripple, harmonics = effect_of("position_ripple"), effect_of("harmonic_ripple")
    values = {"f_sin": 2.0, "f_cos": -1.0, "period": 0.013}
    zero = dict.fromkeys(("f_sin_2", "f_cos_2", "f_sin_3", "f_cos_3"), 0.0)
    first, *overtones = harmonics.widened("translational", site, ripple, values)
    assert first == values | zero
    s = np.linspace(-0.05, 0.05, 500)
    motion = Motion(s, s, s, s, s)
    assert ripple.basis is not None
    assert harmonics.basis is not None
    wave = np.array(ripple.basis(motion, values)).T @ [2.0, -1.0]
    for overtone, period in zip(overtones, (0.026, 0.039), strict=True):
        sizes = [overtone[quantity.name] for quantity in harmonics.sizes("translational")]
        assert np.array(harmonics.basis(motion, overtone)).T @ sizes == pytest.approx(wave)
        assert overtone["period"] == pytest.approx(period)
    coulomb, dahl = effect_of("coulomb_friction"), effect_of("presliding_friction")
    begun = dahl.widened("translational", site, coulomb, {"f_c": 3.0})
    assert {start["f_c"] for start in begun} == {3.0}
    assert len({start["s_p"] for start in begun}) > 2


LAWS = [effect for effect in EFFECTS.values() if effect.plain and effect.basis and not effect.memory]


@pytest.mark.parametrize("effect", LAWS, ids=[effect.kind for effect in LAWS])
def test_joined_with_its_special_case_a_law_does_what_both_do(effect: Effect) -> None:
    """Where both stand at one site, what is left when one is taken out begins from the force of the two."""
    t = np.linspace(0.0, 10.0, 2000)
    size = 1e-6 if "damping" in effect.kind else 0.1  # some dampers are linear at low speed alone
    motion = Motion(t, size * np.sin(t), size * np.cos(t), np.cos(3 * t), -size * np.sin(t))
    site = replace(next(s for s in sites_of(cart()) if s.path == "d1"), travel=0.1, speed=0.07)
    shape = effect.shaped("translational", site)[0]
    plain = effect_of(next(iter(effect.plain)))
    own = {q.name: 1.0 + number for number, q in enumerate(effect.sizes("translational"))} | shape
    special = {q.name: 5.0 - number for number, q in enumerate(plain.sizes("translational"))}
    special |= dict(
        zip([q.name for q in plain.quantities["translational"] if q.shape], shape.values(), strict=False)
    )

    def force(of: Effect, values: dict[str, float]) -> np.ndarray:
        assert of.basis is not None
        given = {q.name: values[q.name] for q in of.quantities["translational"] if q.shape}
        sizes = [values[q.name] for q in of.sizes("translational")]
        return np.column_stack(of.basis(motion, given)) @ sizes

    both = Hypothesis(effect, site, "rich_1", own).joined(Hypothesis(plain, site, "plain_1", special))
    assert both is not None
    assert force(effect, both) == pytest.approx(force(effect, own) + force(plain, special), abs=1e-9)
    one = Hypothesis(effect, site, "rich_1", own)
    less = one.specials[0]
    again = replace(one, values=one.joined(less) or {}).specials[0]
    sizes = [q.name for q in plain.sizes("translational")]
    assert [again.values[n] for n in sizes] == pytest.approx([2 * less.values[n] for n in sizes])


def test_a_law_takes_over_what_it_has_in_common_with_another() -> None:
    """Drift of friction and Stribeck's curve both have a level, which the other can have in its place."""
    site = next(s for s in sites_of(cart()) if s.path == "d1")
    stribeck, drift, thread = (
        Hypothesis(effect_of(kind), site, "x_1", values)
        for kind, values in (
            ("stribeck_friction", {"f_c": 0.1, "f_s": 0.3, "v_s": 0.2}),
            ("friction_drift", {"f_c": 0.5, "f_u": 1e-6, "f_uu": 0.0}),
            ("position_ripple", {"f_sin": 1.0, "f_cos": 1.0, "period": 0.1}),
        )
    )
    assert stribeck.joined(drift) == pytest.approx({"f_c": 0.6, "f_s": 0.8, "v_s": 0.2})
    assert drift.joined(stribeck) == pytest.approx({"f_c": 0.7, "f_u": 1e-6, "f_uu": 0.0})
    assert stribeck.joined(thread) is None
    assert stribeck.joined(replace(drift, site=replace(site, path="elsewhere"))) is None


def test_a_spring_whose_motion_is_prescribed_is_at_rest_where_it_is_unstretched() -> None:
    """The mean of a motion that is prescribed is no place at which a law turns."""
    t = np.linspace(0.0, 1.0, 101)
    there = Motion(t, 0.3 + 0.1 * np.sin(40 * t), t, t, t)
    sites = {site.path: site for site in sites_of(cart())}
    assert [scaled(sites[path], [there], None, led=True).rest for path in ("d1", "k2")] == [0.0, 0.0]
    assert scaled(sites["k2"], [there]).rest == 0.3
    longer = {site.path: site for site in sites_of(cart().with_values(k2=ia.Spring(k=1e3, s_rel0=0.2)))}
    assert scaled(longer["k2"], [there], None, led=True).rest == 0.2
    free = ia.Network("free", wall=ia.Fixed(), rail=ia.Damper(d=1.0), mass=ia.Mass(m=1.0))
    free.connect(free.wall.flange, free.rail.flange_a).connect(free.rail.flange_b, free.mass.flange)
    (rail,) = (site for site in sites_of(free) if site.path == "rail")
    assert scaled(rail, [there], None, led=True).rest == pytest.approx(there.distance)
    assert scaled(sites["k2"], [there], None).rest == pytest.approx(there.distance)


def test_what_has_states_of_its_own_leaves_motion_prescribed() -> None:
    """Beside an effect with memory a model has states; its spring still rests where it is unstretched."""
    net = ia.Network("bench", frame=ia.Fixed(), specimen=ia.SpringDamper(k=2e4, d=9.0), cell=ia.ForceSensor())
    net.add(stroke=ia.Position(exact=True)).connect(net.stroke.flange, net.cell.flange_a)
    net.connect(net.cell.flange_b, net.specimen.flange_b).connect(net.frame.flange, net.specimen.flange_a)
    t = np.linspace(0.0, 2.0, 401)
    x = 0.003 + 0.01 * np.sin(9 * t) * np.sin(2 * t)
    F = 2.1e4 * x + 10 * np.gradient(x, t) + 0.01 * np.random.default_rng(1).standard_normal(len(t))
    channels = {"x": {"input": "stroke.s_ref", "unit": "m"}, "F": {"output": "cell.f", "unit": "N"}}
    train = [{"record": Record("run", t, {"x": x, "F": F}), "initial": "fit"}]
    study = study_of(Campaign(net, channels, {"specimen.k": {"rel": 0.1}}, train), Accuracy())
    assert study.is_led
    (site,) = (site for site in study.sites if site.path == "specimen")
    lagging = Hypothesis(effect_of("relaxation"), site, "relaxation_1", {"d": 20.0, "T": 0.05})
    for effects in ([], [lagging]):
        found = screen(study, study.campaign.start, effects)
        assert {one.site.rest for one in found if one.effect.kind == "cubic_stiffness"} == {0.0}


def test_the_usual_speed_of_a_site_is_over_time_not_over_points() -> None:
    """Points crowd where it stands, as at the events of friction; one record lasts three times another."""

    def moved(t: np.ndarray, speed: float) -> Motion:
        v = np.where(t > 1.0, speed, 0.0)
        return Motion(t, np.zeros_like(t), v, np.zeros_like(t), np.zeros_like(t))

    even = np.r_[0.0, 0.5, 1.0, np.nextafter(1.0, 2), 1.5, 2.0]
    crowded = np.r_[np.linspace(0.0, 1.0, 500), even[3:]]
    long = np.r_[0.0, 1.0, np.nextafter(1.0, 2), 6.0]
    for t in (even, crowded):
        assert moved(t, 3.0).speed == pytest.approx(3.0 / np.sqrt(2))
        site = scaled(sites_of(cart())[0], [moved(t, 3.0), moved(long, 1.0)])
        assert site.speed == pytest.approx(np.sqrt((9.0 + 5.0) / 8.0))


def test_an_effect_of_ones_own_and_unknown_ones() -> None:
    with pytest.raises(ia.ModelError, match="there is an effect 'backlash' already"):
        register(replace(effect_of("backlash")))
    with pytest.raises(ia.ModelError, match="no effect 'backlas'; did you mean 'backlash'"):
        effect_of("backlas")
    mine = register(Effect("my_own", "node", {}))
    assert effect_of("my_own") is mine
    del EFFECTS["my_own"]


def test_whether_an_effect_is_of_an_actuator_is_said_not_read_from_its_name() -> None:
    quantities = {"channel": (Quantity("gain", "1"),)}
    heat = Effect("actuator_heat", "channel", quantities, change=lambda t, y, p: y * (1 + p["gain"]))
    time, signal = np.arange(3.0), np.ones(3)
    experiment = Experiment(Record("one", time, {"x": signal}), "one")
    for effect in (heat, replace(heat, kind="sensor_heat", drives=True)):
        site = Site("x", "channel", "carriage.s", "", frozenset({"channel"}))
        placed = Hypothesis(effect, site, "heat", {"gain": 0.5})
        given = driven(experiment, [placed]).record.values["x"]
        assert given == pytest.approx(1.5 * signal if effect.drives else signal)
        seen = sensed(time, "x", signal, [placed])
        assert seen == pytest.approx(signal if effect.drives else 1.5 * signal)


def test_an_effect_of_one_kind_of_motion_is_tried_at_its_sites_alone() -> None:
    turning = next(
        site for site in sites_of(rig()) if site.domain == "rotational" and "across" in site.places
    )
    t = np.linspace(0.0, 1.0, 50)
    motion = Motion(t, np.sin(t), np.cos(t), np.sin(t), -np.sin(t))
    kinds = {effect.kind for effect, _, _ in _forces(turning, motion, [motion], "push")}
    viscous = effect_of("viscous_damping")
    straight = replace(viscous, kind="straight", quantities={"translational": (Quantity("d", "N.s/m"),)})
    with patch.dict(EFFECTS):
        register(straight)
        tried = {effect.kind for effect, _, _ in _forces(turning, motion, [motion], "push")}
    assert tried == kinds != set()


def test_the_drift_of_a_sensor_of_speed_is_an_acceleration() -> None:
    net = ia.Network("cart", push=ia.Force(), mass=ia.Mass(m=1.0))
    net.connect(net.push.flange, net.mass.flange)
    time = np.linspace(0.0, 1.0, 101)
    record = Record("run", time, {"F": np.sin(9 * time), "v": 1 - np.cos(9 * time)})
    channels = {"F": {"input": "push.f"}, "v": {"output": "mass.v", "unit": "km/h"}}
    campaign = Campaign(net, channels, {"mass.m": {"rel": 0.1}}, [{"record": record}])
    site = Site("v", "channel", "mass.v", "", frozenset({"channel"}))
    placed = Hypothesis(effect_of("sensor_drift"), site, "drift_1", {"rate": 0.1, "bend": 0.0})
    assert placed.units(campaign) == {"rate": "m/s2", "bend": "m/s3"}


@pytest.mark.parametrize("damped", [False, True])
def test_a_spring_with_play_has_elastic_flanks_and_no_part_more(damped: bool) -> None:
    """Its motion is that of the dead zone, its parameters stay where they are, and the line for it runs."""
    net = ia.Network("shaft", frame=rotational.Fixed(), load=rotational.Inertia(J=0.03, phi=0.02))
    spring = rotational.SpringDamper(c=50.0, d=0.2) if damped else rotational.Spring(c=50.0)
    net.add(coupling=spring).connect(net.frame.flange, net.coupling.flange_a)
    net.connect(net.coupling.flange_b, net.load.flange)
    (site,) = (site for site in sites_of(net) if "series" in site.places)
    placed = Hypothesis(effect_of("backlash"), site, "backlash_1", {"eps": 0.004})
    assert dict(placed.network_parameters) == {"coupling.b": 0.008}
    (edit,) = placed.edits
    still = replace(placed, site=replace(site, speed=0.0, travel=0.0))
    assert [str(one) for one in still.edits] == [str(edit)]
    changed = edited(net, [edit])
    assert {"coupling.c", "coupling.b"} <= set(changed.dae().parameters.index)
    assert [*changed.dae().state_names] == [*net.dae().state_names]
    flanks = rotational.ElastoBacklash(c=50.0, d=0.2 * damped, b=0.008)
    run, wanted = (ia.simulate(n, 2.0) for n in (changed, net.with_values(coupling=flanks)))
    assert run["load.phi"] == pytest.approx(wanted["load.phi"], abs=1e-12)
    scope: dict[str, Any] = {"net": net, "rotational": rotational}
    exec(str(edit), scope)
    assert type(scope["net"].coupling) is rotational.ElastoBacklash


def test_a_spring_that_pushes_has_flanks_as_well() -> None:
    (site,) = (site for site in sites_of(cart()) if site.path == "k2")
    placed = Hypothesis(effect_of("backlash"), site, "backlash_1", {"eps": 1e-3})
    assert [*placed.network_parameters.items()] == [("k2.b", 2e-3)]
    assert (
        str(placed.edits[0])
        == 'net = net.with_values(**{"k2": ElastoBacklash(d=0.0, k=1000.0, s_rel0=0.0, b=0.002)})'
    )
    run = ia.simulate(edited(cart(), placed.edits), 0.5)
    wanted = ia.simulate(cart().with_values(k2=ia.ElastoBacklash(k=1e3, d=0.0, b=2e-3)), 0.5)
    assert run["two.s"] == pytest.approx(wanted["two.s"], abs=1e-12)


@pytest.mark.parametrize(("eps", "d"), [(1e-7, 900.0), (2e-3, 900.0), (2e-3, 70.0)])
def test_play_behind_a_damper_that_bears_a_share_lets_it_relax(eps: float, d: float) -> None:
    """Without a width there is none: flanks that only press would hold the damper back whatever it is.

    They would miss 4 % of the force as they touch where the damper bears but 3 % of it.
    """
    k, travel, rate = 2e4, 0.01, 12.0
    net = ia.Network(
        "bench", frame=ia.Fixed(), specimen=ia.SpringDamper(k=k, d=d), slider=ia.Mass(m=1e-3),
        cell=ia.ForceSensor(), stroke=ia.Position(exact=True, s_ref=lambda t: travel * np.sin(rate * t)),
    )  # fmt: skip
    net.connect(net.stroke.flange, net.cell.flange_a)
    net.connect(net.cell.flange_b, net.slider.flange, net.specimen.flange_b)
    net.connect(net.frame.flange, net.specimen.flange_a)
    (bare,) = (site for site in sites_of(net) if site.path == "specimen")
    site = replace(bare, speed=travel * rate / 2**0.5, travel=travel, force=2.5 * k * travel)
    placed = Hypothesis(effect_of("backlash"), site, "backlash_1", {"eps": eps})
    assert dict(placed.network_parameters) == {"specimen.b": 2 * eps}
    changed = edited(net, placed.edits)
    assert {"specimen.k", "specimen.d", "specimen.b"} <= set(changed.dae().parameters.index)
    run = ia.simulate(changed, 0.6, step=1e-3)

    step, length, wanted = 1e-5, 0.0, []
    for n in range(round(0.6 / step) + 1):
        place = travel * np.sin(rate * n * step)
        relaxed = length / (1 + step * k / d)
        swept = float(np.clip(relaxed, place - eps, place + eps))
        wanted.append(0.0 if swept == relaxed else k * swept + d * (swept - length) / step)
        length = swept
    force, t = np.array(wanted)[25000::100], np.arange(0.25, 0.6, 1e-3)
    away = np.abs(run.at("cell.f", t) - force[: len(t)])
    assert away.max() < 0.003 * np.abs(force).max()


def test_what_play_takes_off_a_spring_is_what_flanks_bear_less() -> None:
    s = np.linspace(-0.02, 0.02, 401)
    rest = np.zeros_like(s)
    motion = Motion(s, s, rest, 50.0 * s, rest)
    for kind, values in (("backlash", {"eps": 0.004}), ("compliance", {"compliance": 0.02})):
        eased = effect_of(kind).eased
        assert eased is not None
        borne = motion.f - eased(motion, 50.0, values)
        beyond = np.sign(s) * np.maximum(np.abs(s) - 0.004, 0.0)
        assert borne == pytest.approx(50.0 * beyond if kind == "backlash" else 25.0 * s, abs=1e-12)
