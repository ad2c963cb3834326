"""The eight MSL examples with reference results (Dymola, tolerance 1e-6): every counted signal and switch.

Source: Modelica Standard Library 4.1.0, Mechanics.Rotational.Examples and Mechanics.Translational.Examples;
components bear the names they have there. MSL's bodies with a length are masses between rods here.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache
from itertools import pairwise
from math import exp, inf, pi
from pathlib import Path

import casadi as ca
import inertance as ia
import numpy as np
import pytest
from inertance import Network, rotational, signals
from numpy.typing import NDArray

Array = NDArray[np.float64]
History = list[tuple[float, int]]

NUMBERS = {"backward": -1, "stuck": 0, "forward": 1, "free": 2}
BLINK = 1e-5


def first() -> Network:
    net = Network(
        "First",
        fixed=rotational.Fixed(),
        torque=rotational.Torque(tau=lambda t: 10 * ca.sin(10 * pi * t)),
        inertia1=rotational.Inertia(J=0.1),
        gear=rotational.IdealGear(ratio=10),
        inertia2=rotational.Inertia(J=2, phi=0, w=0),
        spring=rotational.Spring(c=1e4, phi_rel=0),
        inertia3=rotational.Inertia(J=2, w=0),
        damper=rotational.Damper(d=10),
    )
    net.connect(net.torque.flange, net.inertia1.flange, net.gear.flange_a)
    net.connect(net.gear.flange_b, net.inertia2.flange, net.spring.flange_a, net.damper.flange_a)
    net.connect(net.spring.flange_b, net.inertia3.flange)
    return net.connect(net.fixed.flange, net.damper.flange_b, net.gear.support, net.torque.support)


def backlash() -> Network:
    net = Network(
        "Backlash",
        fixed=rotational.Fixed(),
        springDamper=rotational.SpringDamper(c=20e3, d=50),
        elastoBacklash=rotational.ElastoBacklash(c=20e3, d=50, b=pi / 4),
        inertia1=rotational.Inertia(J=5, phi=pi / 2, w=0),
        inertia2=rotational.Inertia(J=5, phi=pi / 2, w=0),
    )
    net.connect(net.fixed.flange, net.springDamper.flange_a, net.elastoBacklash.flange_a)
    net.connect(net.springDamper.flange_b, net.inertia1.flange)
    return net.connect(net.elastoBacklash.flange_b, net.inertia2.flange)


def coupled_clutches() -> Network:
    clutch = {"peak": 1.1, "fn_max": 20}
    net = Network(
        "CoupledClutches",
        fixed=rotational.Fixed(),
        torque=rotational.Torque(tau=lambda t: 10 * ca.sin(10 * pi * t)),
        J1=rotational.Inertia(J=1, phi=0, w=10),
        clutch1=rotational.Clutch(f_normalized=lambda t: ca.sin(0.4 * pi * t + pi / 2), **clutch),
        J2=rotational.Inertia(J=1, phi=0, w=0),
        step1=signals.Step(start_time=0.4),
        clutch2=rotational.Clutch(**clutch),
        J3=rotational.Inertia(J=1, phi=0, w=0),
        step2=signals.Step(start_time=0.9),
        clutch3=rotational.Clutch(**clutch),
        J4=rotational.Inertia(J=1, phi=0, w=0),
    )
    net.connect(net.fixed.flange, net.torque.support)
    net.connect(net.torque.flange, net.J1.flange, net.clutch1.flange_a)
    net.connect(net.clutch1.flange_b, net.J2.flange, net.clutch2.flange_a)
    net.connect(net.clutch2.flange_b, net.J3.flange, net.clutch3.flange_a)
    net.connect(net.clutch3.flange_b, net.J4.flange)
    net.connect(net.step1.y, net.clutch2.f_normalized)
    return net.connect(net.step2.y, net.clutch3.f_normalized)


def accelerate() -> Network:
    net = Network(
        "Accelerate",
        accelerate=ia.Accelerate(s=0, v=0),
        constant=signals.Constant(k=1),
        half=ia.Rod(L=0.5),
        mass=ia.Mass(m=1),
    )
    net.connect(net.constant.y, net.accelerate.a_ref)
    net.connect(net.accelerate.flange, net.half.flange_a)
    return net.connect(net.half.flange_b, net.mass.flange)


def damper() -> Network:
    net = Network(
        "Damper",
        damper1=ia.Damper(d=25),
        damper2=ia.Damper(d=25),
        spring2=ia.Spring(k=1, s_rel0=1),
        springDamper3=ia.SpringDamper(k=1, d=25, s_rel0=1),
    )
    for i, elements in enumerate(
        ([net.damper1], [net.damper2, net.spring2], [net.springDamper3]), start=1
    ):  # fmt: skip
        mass, half, fixed = ia.Mass(m=1, s=3, v=10), ia.Rod(L=0.5), ia.Fixed(s0=4.5)
        net.add(**{f"mass{i}": mass, f"half{i}": half, f"fixed{i}": fixed})
        net.connect(mass.flange, half.flange_a)
        net.connect(half.flange_b, *(element.flange_a for element in elements))
        net.connect(fixed.flange, *(element.flange_b for element in elements))
    return net


def oscillator() -> Network:
    net = Network(
        "Oscillator",
        spring1=ia.Spring(k=1e4, s_rel0=1),
        spring2=ia.Spring(k=1e4, s_rel0=1),
        damper1=ia.Damper(d=10),
    )
    for i, elements in enumerate(([net.spring1], [net.spring2, net.damper1]), start=1):
        mass, half, fixed = ia.Mass(m=1, s=-0.5, v=0), ia.Rod(L=0.5), ia.Fixed(s0=1)
        force, sine = ia.Force(), signals.Sine(f=15.9155)
        net.add(
            **{f"mass{i}": mass, f"half{i}": half, f"fixed{i}": fixed, f"force{i}": force, f"sine{i}": sine}
        )
        net.connect(sine.y, force.f).connect(force.flange, mass.flange, half.flange_a)
        net.connect(half.flange_b, *(element.flange_a for element in elements))
        net.connect(fixed.flange, *(element.flange_b for element in elements))
    return net


def elasto_gap() -> Network:
    net = Network(
        "ElastoGap",
        fixed=ia.Fixed(),
        rod1=ia.Rod(L=2),
        rod2=ia.Rod(L=2),
        springDamper1=ia.SpringDamper(k=10, d=1.5, s_rel0=1),
        springDamper2=ia.SpringDamper(k=10, d=1.5, s_rel0=1),
        mass1=ia.Mass(m=1, s=2, v=0),
        elastoGap1=ia.ElastoGap(k=10, d=1.5, s_rel0=1.5),
        elastoGap2=ia.ElastoGap(k=10, d=1.5, s_rel0=1.5),
        mass2=ia.Mass(m=1, s=2, v=0),
    )
    net.connect(net.fixed.flange, net.rod1.flange_b, net.rod2.flange_a)
    net.connect(net.rod1.flange_a, net.springDamper1.flange_a, net.elastoGap1.flange_a)
    net.connect(net.rod2.flange_b, net.springDamper2.flange_b, net.elastoGap2.flange_b)
    net.connect(net.springDamper1.flange_b, net.mass1.flange, net.springDamper2.flange_a)
    return net.connect(net.elastoGap1.flange_b, net.mass2.flange, net.elastoGap2.flange_a)


def friction() -> Network:
    speeds = np.linspace(0, 12, 50).tolist()
    stribeck = tuple((v, 5 + v + 10 * exp(-2 * v)) for v in speeds)
    body = {"m": 1, "d": 1, "v_s": 0.5, "peak": 1.001}
    net = Network(
        "Friction",
        sineForce=signals.Sine(amplitude=25, f=0.25),
        force=ia.Force(),
        stop1=ia.MassWithStopAndFriction(s_min=-24.5, s_max=24.5, f_c=5, f_s=15, s=0, v=0, **body),
        fixed2=ia.Fixed(s0=-1.75),
        spring=ia.Spring(k=500, s_rel0=1),
        half=ia.Rod(L=0.5),
        stop2=ia.MassWithStopAndFriction(s_min=-0.4, s_max=0.4, f_c=3, f_s=8, s=0, v=-5, **body),
        force2=ia.Force(),
        mass=ia.Mass(m=1, s=0, v=0),
        supportFriction=ia.SupportFriction(friction=ia.TabulatedFriction(table=stribeck)),
    )
    net.connect(net.sineForce.y, net.force.f, net.force2.f).connect(net.force.flange, net.stop1.flange)
    net.connect(net.fixed2.flange, net.spring.flange_a).connect(net.spring.flange_b, net.half.flange_a)
    net.connect(net.half.flange_b, net.stop2.flange)
    return net.connect(net.force2.flange, net.mass.flange, net.supportFriction.flange)


@dataclass(frozen=True)
class Case:
    """An example: how to build it, its length, and the largest error measured, of a signal's range."""

    build: Callable[[], Network]
    stop: float
    error: float
    modes: dict[str, str] = field(default_factory=dict)


CASES = {
    "Rotational.First": Case(first, 1.0, 3e-4),
    "Rotational.Backlash": Case(backlash, 1.0, 1e-4),
    "Rotational.CoupledClutches": Case(
        coupled_clutches, 1.5, 2e-5, {f"clutch{i}": f"clutch{i}.mode" for i in (1, 2, 3)}
    ),
    "Translational.Accelerate": Case(accelerate, 1.0, 1e-7),
    "Translational.Damper": Case(damper, 1.0, 3e-6),
    "Translational.ElastoGap": Case(elasto_gap, 5.0, 1e-5),
    "Translational.Friction": Case(
        friction, 5.0, 5e-5, {b: f"{b}.friction.mode" for b in ("stop1", "stop2", "supportFriction")}
    ),
    "Translational.Oscillator": Case(oscillator, 1.0, 5e-4),
}


class Reference:
    """A reference result: its signals by name, and the names of those that count."""

    def __init__(self, folder: Path, name: str) -> None:
        path = folder / f"{name}.csv"
        with path.open(encoding="utf-8") as file:
            heads = file.readline().replace('"', "").strip().split(",")
        table = np.loadtxt(path, delimiter=",", skiprows=1)
        self.signals: dict[str, Array] = dict(zip(heads, table.T, strict=True))
        self.time = self.signals["time"]
        counted = (folder / f"{name}.signals.txt").read_text(encoding="utf-8").split()
        self.motions = [c for c in counted if c != "time" and "mode" not in c and "start" not in c]
        self.modes = [c for c in counted if c.endswith(".mode")]
        self.starts = [c for c in counted if c.endswith((".startForward", ".startBackward"))]
        assert {"time", *self.motions, *self.modes, *self.starts} == set(counted) == set(heads)

    @property
    def between_events(self) -> NDArray[np.bool_]:
        """Rows away from events: at an event two rows share one time."""
        step = np.diff(self.time) > 0
        rows: NDArray[np.bool_] = np.append(True, step) & np.append(step, True)
        return rows

    def history(self, name: str) -> History:
        """Return the values a discrete signal takes, and from when."""
        values = self.signals[name]
        changed = np.flatnonzero(np.diff(values, prepend=values[0] - 1))
        return [(float(self.time[i]), int(values[i])) for i in changed]


@cache
def run_of(name: str) -> ia.Result:
    case = CASES[name]
    return case.build().simulate(case.stop, step=5e-4, rtol=1e-8, atol=1e-10)


def history(run: ia.Result, mode: str) -> History:
    """Return the values of one of our modes in MSL's numbers, and from when."""
    events = [event for event in run.events if event.mode == mode]
    return [(0.0, NUMBERS[events[0].source]), *((event.time, NUMBERS[event.target]) for event in events)]


def lasting(history: History) -> History:
    """Leave out what is left again within BLINK: of a reversal one tool records rest, the other not."""
    ends = [*(start for start, _ in history[1:]), inf]
    kept = [entry for entry, end in zip(history, ends, strict=True) if end - entry[0] > BLINK]
    return [kept[0], *(new for old, new in pairwise(kept) if new[1] != old[1])]


@pytest.mark.parametrize("name", CASES)
def test_every_counted_signal_agrees(name: str, msl_references: Path) -> None:
    reference, run = Reference(msl_references, name), run_of(name)
    rows = reference.between_events
    for signal in reference.motions:
        expected = reference.signals[signal][rows]
        ours = np.interp(reference.time[rows], run["time"], run[signal])
        assert np.abs(ours - expected).max() < CASES[name].error * np.ptp(expected), signal


@pytest.mark.parametrize("name", [name for name, case in CASES.items() if case.modes])
def test_every_mode_switches_when_it_should(name: str, msl_references: Path) -> None:
    reference, run = Reference(msl_references, name), run_of(name)
    assert {f"{element}.mode" for element in CASES[name].modes} == set(reference.modes)
    for element, mode in CASES[name].modes.items():
        expected, ours = lasting(reference.history(f"{element}.mode")), lasting(history(run, mode))
        assert [value for _, value in ours] == [value for _, value in expected], element
        assert [t for t, _ in ours] == pytest.approx([t for t, _ in expected], abs=1e-5), element


@pytest.mark.parametrize("name", [name for name, case in CASES.items() if case.modes])
def test_break_away_comes_where_the_start_flags_rise(name: str, msl_references: Path) -> None:
    """MSL's startForward and startBackward are true from break-away until the speed is above zero.

    We have no such state: break-away is the event stuck -> forward or backward. So a flag must fall within
    BLINK of its rise, and its rise must be one of these events.
    """
    reference, run = Reference(msl_references, name), run_of(name)
    risen = 0
    for signal in reference.starts:
        element, flag = signal.split(".")
        target = flag.removeprefix("start").lower()
        (_, initially), *changes = reference.history(signal)
        assert not initially, signal
        for (rise, _), (fall, _) in zip(changes[::2], changes[1::2], strict=True):
            risen += 1
            assert fall - rise < BLINK, signal
            assert any(
                event.mode == CASES[name].modes[element]
                and (event.source, event.target) == ("stuck", target)
                and abs(event.time - rise) < BLINK
                for event in run.events
            ), signal
    assert risen


def test_oscillator_against_its_closed_form() -> None:
    """What parts us from the reference of Oscillator (4.8e-4 of the range) is the reference's own error."""
    run = run_of("Translational.Oscillator")
    t, w0, w = run["time"], 100.0, 2 * pi * 15.9155
    exact = -0.5 + (np.sin(w * t) - w / w0 * np.sin(w0 * t)) / (w0**2 - w**2)
    assert np.abs(run["mass1.s"] - exact).max() < 1e-6 * np.ptp(exact)
