"""The missing force over time, where it acts, its law, against machines whose extra force is known."""

from typing import Any

import casadi as ca
import inertance as ia
import numpy as np
import pytest
from inertance.identification import Campaign, Multisine, Record, sampled


class Extra(ia.CompliantWithSpeed):
    """A hardening that no effect has, or friction: f = 30 tanh((s - s_0)/0.02)^3, or 3 tanh(v/0.002)."""

    how = ia.option("which", default="bulge")

    def equations(self) -> Any:
        s, v = self.s_rel - 0.4, self.v_rel
        yield self.f == {"bulge": 30 * ca.tanh(s / 0.02) ** 3, "rub": 3 * ca.tanh(v / 2e-3)}[self.how]


def machine(k: float, how: str = "", between: bool = False) -> ia.Network:
    net = ia.Network(
        "carts", wall=ia.Fixed(), spring=ia.SpringDamper(k=k, d=4.0, s_rel0=0.4), push=ia.Force()
    )
    net.add(cart=ia.Mass(m=1.0, s=0.4), link=ia.SpringDamper(k=900.0, d=3.0), second=ia.Mass(m=0.7, s=0.4))
    net.connect(net.wall.flange, net.spring.flange_a)
    net.connect(net.spring.flange_b, net.cart.flange, net.push.flange, net.link.flange_a)
    net.connect(net.link.flange_b, net.second.flange)
    if how:
        net.add(extra=Extra(how=how))
        net.connect((net.cart if between else net.wall).flange, net.extra.flange_a)
        net.connect((net.second if between else net.cart).flange, net.extra.flange_b)
    return net


def campaign(how: str, between: bool = False, initial: str = "fit") -> Campaign:
    true, rng, records = machine(430.0, how, between), np.random.default_rng(3), []
    for number in range(3):
        force = sampled(
            Multisine(rms=9.0 - number, low=0.4, high=4.0, period=2.0, seed=number),
            stop=4.0,
            rate=200.0,
            fade=0.3,
        )
        run = true.simulate(4.0, step=5e-3, inputs={"push.f": force})
        noise = rng.normal(0, 1e-4, (2, len(run.time)))
        values = {"F": force.values, "x": run["cart.s"] + noise[0], "y": run["second.s"] + noise[1]}
        records.append({"record": Record(f"run {number}", force.time + 7.0, values), "initial": initial})
    outputs = {"x": {"output": "cart.s", "unit": "m"}, "y": {"output": "second.s", "unit": "m"}}
    return Campaign(
        machine(400.0),
        channels={"F": {"input": "push.f", "unit": "N"}, **outputs},
        parameters={"spring.k": {"rel": 0.1}, "spring.d": {"rel": 0.2}},
        train=records[:2],
        test=records[2:],
        noise={"x": 1e-4, "y": 1e-4},
    )


@pytest.fixture(scope="module")
def bulging() -> Any:
    """Return what is missing of a spring that hardens, from records that begin at rest."""
    return ia.missing_force(campaign("bulge", initial="rest"), site="spring")


def test_the_force_is_found_where_it_acts() -> None:
    missing = ia.missing_force(campaign("rub", between=True))
    assert missing.site.path == "link"
    assert missing.ranking[0].site == "link"
    assert missing.ranking[1].evidence < -100
    assert missing.before > 10
    assert missing.misfit < 1.1
    assert missing.parameters["spring.k"] == pytest.approx(430.0, rel=5e-3)
    one = missing.records[0]
    true = 3 * np.tanh(one.motion.v / 2e-3)
    inner = slice(20, -20)
    steady = np.abs(one.motion.v[inner]) > 0.1
    away = (one.force - true)[inner][steady] / one.standard_error[inner][steady]
    assert np.mean(np.abs(away) < 2) > 0.9
    assert missing.force["run 1"].shape == missing.standard_error["run 1"].shape


def test_a_law_of_position_is_drawn(bulging: Any) -> None:
    law = bulging.law()
    assert law.variables == ("position",)
    assert law.explained > 0.98
    assert law.shares["speed",] < 0.5
    assert law.origin == pytest.approx(0.4, abs=1e-3)
    assert "odd: alike both ways" in law.traits
    x = law.points[:, 0]
    visited = np.abs(x) < 0.8 * np.abs(x).max()
    moved = bulging.search.bench.scales * law.fit.moved + bulging.search.bench.centers
    true = 30 * np.tanh(x / 0.02) ** 3 + (430.0 - moved[0]) * x
    assert np.abs(law.values - true)[visited].max() < 0.05 * np.ptp(true)
    network = machine(400.0)
    network.add(law=law.component())
    network.connect(network.wall.flange, network.law.flange_a)
    network.connect(network.law.flange_b, network.cart.flange)
    push = {"push.f": lambda t: 8 * np.sin(12 * t)}
    run = network.simulate(
        2.0, step=0.01, inputs=push, parameters={"spring.k": float(moved[0]), "spring.d": float(moved[1])}
    )
    same = machine(430.0, "bulge").simulate(2.0, step=0.01, inputs=push)
    assert np.std(run["cart.s"] - same["cart.s"]) < 0.03 * np.std(same["cart.s"])


def test_pictures_are_saved(bulging: Any, tmp_path: Any) -> None:
    bulging.plot(tmp_path / "force.png")
    bulging.law("speed").plot(tmp_path / "speed.png")
    bulging.law(("position", "speed")).plot(tmp_path / "map.png")
    assert {path.name for path in tmp_path.iterdir()} == {"force.png", "speed.png", "map.png"}
    assert "missing force at spring" in str(bulging)
    with pytest.raises(ia.ModelError, match="over one or two"):
        bulging.law("sped")
    with pytest.raises(ia.ModelError, match="is no component"):
        bulging.law("time").component()


def test_a_site_whose_force_acts_by_its_derivatives_and_is_not_seen_is_passed_over() -> None:
    """Two springs in a row beside the measured mass, at a node that has no mass."""

    def driven(friction: float) -> ia.Network:
        net = ia.Network("side", wall=ia.Fixed(), drive=ia.Position(), mass=ia.Mass(m=1.0))
        net.add(near=ia.Spring(k=300.0), far=ia.Spring(k=200.0), link=ia.SpringDamper(k=400.0, d=4.0))
        net.add(guide=ia.SpringDamper(k=100.0, d=2.0), rub=ia.CoulombFriction(f_c=friction))
        net.connect(net.drive.flange, net.near.flange_a, net.link.flange_a)
        net.connect(net.near.flange_b, net.far.flange_a)
        net.connect(net.wall.flange, net.far.flange_b, net.guide.flange_a, net.rub.flange_a)
        net.connect(net.link.flange_b, net.mass.flange, net.guide.flange_b, net.rub.flange_b)
        return net

    shape = Multisine(rms=0.01, low=0.4, high=4.0, period=2.0, seed=1)
    u = sampled(shape, stop=4.0, rate=200.0, fade=0.3)
    run = driven(0.6).simulate(4.0, step=5e-3, inputs={"drive.s_ref": u})
    x = np.interp(u.time, run.time, run["mass.s"]) + np.random.default_rng(2).normal(0, 1e-5, len(u.time))
    found = ia.missing_force(
        Campaign(
            driven(0.0),
            channels={"u": {"input": "drive.s_ref", "unit": "m"}, "x": {"output": "mass.s", "unit": "m"}},
            parameters={"guide.k": {"rel": 0.1}},
            train=[{"record": Record("shaken", u.time, {"u": u.values, "x": x}), "initial": "rest"}],
            noise={"x": 1e-5},
        )
    )
    assert {one.site for one in found.ranking}.isdisjoint({"near", "far"})
    assert found.misfit < 1.2 < 10 < found.before


def test_a_site_that_is_none() -> None:
    with pytest.raises(ia.ModelError, match=r"there is no site 'sprin'.*spring"):
        ia.missing_force(campaign("bulge"), site="sprin")


def test_where_force_and_motion_are_measured_it_is_inverse_dynamics() -> None:
    net = ia.Network("gauge", wall=ia.Fixed(), spring=ia.SpringDamper(k=500.0, d=2.0), drive=ia.Position())
    net.connect(net.wall.flange, net.spring.flange_a).connect(net.spring.flange_b, net.drive.flange)
    t = np.linspace(0, 4, 801)
    s = 0.02 * np.sin(5 * t) + 0.01 * np.sin(11 * t)
    v = np.gradient(s, t)
    extra = 4 * np.tanh(v / 0.01)
    noise = np.random.default_rng(1).normal(0, 0.05, len(t))
    record = Record("both", t, {"x": s, "F": 500 * s + 2 * v + extra + noise})
    known = Campaign(
        net,
        channels={
            "x": {"input": "drive.s_ref", "unit": "m"},
            "F": {"output": "spring.flange_b.f", "unit": "N"},
        },
        parameters={"spring.d": {"rel": 0.01}},
        train=[{"record": record}],
        noise={"F": 0.05},
    )
    # what is measured is the spring's alone: a force beside it changes nothing
    with pytest.raises(ia.ModelError, match="no force at"):
        ia.missing_force(known, site="spring")
    total = Campaign(
        net,
        channels={"x": {"input": "drive.s_ref", "unit": "m"}, "F": {"output": "drive.flange.f", "unit": "N"}},
        parameters={"spring.d": {"rel": 0.01}},
        train=[{"record": Record("both", t, {"x": s, "F": -record.values["F"]})}],
        noise={"F": 0.05},
    )
    missing = ia.missing_force(total, site="spring")
    one = missing.records[0]
    assert np.abs(np.interp(t, one.time, one.force) - extra)[20:-20].max() < 0.3
    assert missing.law().variables == ("speed",)


def test_the_force_on_a_machine_that_sticks_is_told_at_the_points_of_its_motion(tmp_path: Any) -> None:
    """A run with a force sticks at instants of its own."""

    def rubbing(k: float, how: str = "") -> ia.Network:
        net = machine(k, how)
        net.add(rail=ia.CoulombFriction(f_c=2.5))
        return net.connect(net.wall.flange, net.rail.flange_a).connect(net.rail.flange_b, net.cart.flange)

    true, rng, records = rubbing(430.0, "bulge"), np.random.default_rng(8), []
    for number in range(2):
        force = sampled(
            Multisine(rms=9.0, low=0.4, high=4.0, period=2.0, seed=number), stop=4.0, rate=200.0, fade=0.3
        )
        run = true.simulate(4.0, step=5e-3, inputs={"push.f": force})
        x = np.interp(force.time, run.time, run["cart.s"]) + rng.normal(0, 1e-4, len(force.time))
        records.append({"record": Record(f"run {number}", force.time + 3.0, {"F": force.values, "x": x})})
    missing = ia.missing_force(
        Campaign(
            rubbing(400.0),
            channels={
                "F": {"input": "push.f", "unit": "N"},
                "x": {"output": "cart.s", "unit": "m"},
            },
            parameters={"spring.k": {"rel": 0.1}},
            train=records,
            noise={"x": 1e-4},
        ),
        site="spring",
    )
    assert missing.misfit < 1.2 < 10 < missing.before
    for one in missing.records:
        assert len(one.motion.t) == len(one.time) == len(one.force) == len(one.standard_error)
        assert len(one.time) > 801
    missing.plot(tmp_path / "force.png")
    assert missing.shown().variables == ("position",)
