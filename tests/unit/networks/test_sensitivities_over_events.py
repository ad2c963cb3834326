"""Sensitivities of runs that switch modes, and of compiled ones: against differences, and against CVODES."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import inertance as ia
import numpy as np
import pytest

TIGHT: dict[str, Any] = {"rtol": 1e-10, "atol": 1e-13}


def rubbing() -> ia.Network:
    """A block of grams that a spring drags, in micrometres, over what sticks: it creeps and slips in turn."""
    net = ia.Network(
        "rubbing",
        wall=ia.Fixed(),
        pull=ia.Position(),
        spring=ia.Spring(k=900.0),
        rub=ia.CoulombFriction(f_c=3e-3),
        mass=ia.Mass(m=5e-3),
    )
    net.connect(net.pull.flange, net.spring.flange_a)
    net.connect(net.spring.flange_b, net.mass.flange, net.rub.flange_b)
    return net.connect(net.wall.flange, net.rub.flange_a)


def dragged(solver: str, **parameters: float) -> ia.Result:
    """From t = 3 s on, in motion, by a record."""
    t = np.linspace(2.9, 3.4, 801)
    drag = ia.Sampled(t, 2e-5 * np.sin(40 * t) + 4e-6 * np.sin(97 * t))
    return ia.simulate(
        rubbing(), 3.3, begin=3.0, step=1e-4, inputs={"pull.s_ref": drag}, parameters=parameters,
        start={"mass.s": 1e-6, "mass.v": 2e-4}, solver=solver,
        sensitivities=["rub.f_c", "spring.k", "mass.m"],
        **TIGHT,
    )  # fmt: skip


def bumping() -> ia.Network:
    """A mass that swings into a compliant stop with clearance, whose force begins with a corner."""
    net = ia.Network(
        "bumping",
        wall=ia.Fixed(),
        spring=ia.Spring(k=40.0),
        stop=ia.ElastoGap(k=4000.0, d=3.0, s_rel0=-0.01),
        mass=ia.Mass(m=0.7, s=0.05),
    )
    net.connect(net.wall.flange, net.spring.flange_a, net.stop.flange_a)
    return net.connect(net.spring.flange_b, net.stop.flange_b, net.mass.flange)


def apart(of: Callable[[float], Any], run: ia.Result, signal: str, name: str, value: float) -> float:
    """Return how far a sensitivity is from differences, as a share of its largest, beside events.

    Close to an event the two runs of a difference are not in the same mode.
    """
    h = 1e-5 * abs(value)
    above, below = of(value + h), of(value - h)
    t = np.linspace(run.time[0], run.time[-1], 401)[1:-1] + 1.3e-6
    events = np.array([event.time for event in run.events if event.time > run.time[0]])
    assert len(events) == len([e for e in above.events if e.time > run.time[0]])
    t = t[np.abs(t[:, None] - events).min(axis=1, initial=np.inf) > 3e-4]
    upper, lower = (np.interp(t, other.time, other[signal]) for other in (above, below))
    slope = np.interp(t, run.time, run.sensitivity(signal, name))
    difference = (upper - lower) / (2 * h)
    assert np.abs(difference).max() > 0
    return float(np.abs(slope - difference).max() / np.abs(difference).max())


@pytest.mark.parametrize("solver", ["auto", "compiled"])
@pytest.mark.parametrize("name", ["rub.f_c", "spring.k", "mass.m"])
def test_stick_slip_under_a_record_in_micrometres(solver: str, name: str) -> None:
    run = dragged(solver)
    value = run.dae.parameter_values[name]
    assert len(run.events) > 6
    assert apart(lambda v: dragged("compiled", **{name: v}), run, "mass.s", name, value) < 2e-3
    assert run.time[0] == 3.0


@pytest.mark.parametrize("name", ["stop.s_rel0", "stop.k", "spring.k"])
def test_bumps_on_a_compliant_stop(name: str) -> None:
    dae = bumping().dae()

    def swung(value: float) -> ia.Result:
        return ia.simulate(
            dae, 1.2, step=1e-4, parameters={name: value}, solver="compiled", sensitivities=[name], **TIGHT
        )

    value = dae.parameter_values[name]
    assert apart(swung, swung(value), "mass.s", name, value) < 5e-3  # corners lie between points


def test_compiled_runs_know_what_cvodes_follows() -> None:
    net = ia.Network(
        "smooth",
        wall=ia.Fixed(),
        element=ia.CubicSpring(k=9.0, k3=30.0),
        damper=ia.Damper(d=0.3),
        mass=ia.Mass(m=1.0),
    )
    net.connect(net.wall.flange, net.element.flange_a, net.damper.flange_a)
    net.connect(net.element.flange_b, net.damper.flange_b, net.mass.flange)
    names = ["element.k", "element.k3", "damper.d", "mass.m"]
    asked: dict[str, Any] = {"start": {"mass.a": 5.0}, "sensitivities": names, **TIGHT}

    def missed(step: float) -> float:
        """Return the largest difference of the two, as a share of each sensitivity's largest."""
        compiled, followed = (
            net.simulate(3.0, step=step, solver=solver, **asked) for solver in ("compiled", "cvodes")
        )
        assert (compiled.stats["solver"], followed.stats["solver"]) == ("compiled", "cvodes")
        return max(
            float(np.abs(compiled.sensitivity(signal, name) - exact).max() / np.abs(exact).max())
            for name in names
            for signal in ("mass.s", "element.f")
            if (exact := followed.sensitivity(signal, name)).any()
        )

    coarse, fine = missed(4e-3), missed(1e-3)
    assert fine < 1e-5
    assert fine < coarse / 10  # of order 2 in the distance of points


def test_rigid_impacts_are_refused_by_name() -> None:
    net = ia.Network("hard", wall=ia.Fixed(), stop=ia.HardStop(), mass=ia.Mass(m=1.0, s=0.1))
    net.connect(net.wall.flange, net.stop.flange_a)
    net.connect(net.stop.flange_b, net.mass.flange)
    with pytest.raises(
        ia.ModelError, match="'hard' has shocks, through which sensitivities are not followed"
    ):
        net.simulate(1.0, sensitivities=["mass.m"])


def test_forces_are_followed_through_a_mode_that_samples_hardly_resolve() -> None:
    """A stiff shaft swings 0.45 times between samples, turned by a force that is straight between them."""
    net = ia.Network(
        "shaft", torque=ia.rotational.Torque(), coupling=ia.rotational.SpringDamper(c=6e3, d=0.6)
    )
    net.add(motor=ia.rotational.Inertia(J=0.02), load=ia.rotational.Inertia(J=0.03))
    net.connect(net.torque.flange, net.motor.flange, net.coupling.flange_a)
    net.connect(net.coupling.flange_b, net.load.flange)
    dae, t = net.dae(), np.arange(0.0, 1.0, 0.004)
    rng = np.random.default_rng(3)
    turned, more = rng.standard_normal((2, len(t)))
    signals = ["motor.w", "load.phi"]

    def run(push: float) -> ia.Result:
        drive = ia.Sampled(t, turned + push * more, interpolation="linear")
        return ia.simulate(dae, t[-1], step=0.004, inputs={"torque.tau": drive}, **TIGHT)

    low, nominal, high = (run(push) for push in (-0.5, 0.0, 0.5))
    wanted = np.column_stack([high.at(name, t) - low.at(name, t) for name in signals])
    change = np.interp(nominal.time, t, more)[:, None]
    found = ia.Variations(dae, signals, []).pushed(nominal, {"torque.tau": change})
    assert np.abs(found[np.searchsorted(nominal.time, t - 1e-9), :, 0] - wanted).max() < 1e-6 * wanted.max()
