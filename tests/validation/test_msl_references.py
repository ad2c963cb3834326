"""The eight MSL examples with reference results (Dymola, tolerance 1e-6): every counted signal and switch.

Source: Modelica Standard Library 4.1.0, Mechanics.Rotational.Examples and Mechanics.Translational.Examples;
components bear the names they have there. MSL's bodies with a length are masses between rods here.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache
from itertools import pairwise
from math import exp, inf, pi
from typing import Any

import casadi as ca
import inertance as ia
import numpy as np
import pytest
from inertance import Network, rotational, signals
from scipy.linalg import expm

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
    clutch: dict[str, Any] = {"peak": 1.1, "fn_max": 20}
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
    body: dict[str, Any] = {"m": 1, "d": 1, "v_s": 0.5, "peak": 1.001}
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
    """An example: how to build it, its length, the largest error allowed, of a signal's range, and modes.

    The errors are those measured, rounded up; all are well below 1e-3.
    """

    build: Callable[[], Network]
    stop: float
    error: float
    modes: dict[str, str] = field(default_factory=dict)


CASES = {
    "Rotational.First": Case(first, 1.0, 3.5e-4),
    "Rotational.Backlash": Case(backlash, 1.0, 3e-5),
    "Rotational.CoupledClutches": Case(
        coupled_clutches, 1.5, 3e-5, {f"clutch{i}": f"clutch{i}.mode" for i in (1, 2, 3)}
    ),
    "Translational.Accelerate": Case(accelerate, 1.0, 2e-7),
    "Translational.Damper": Case(damper, 1.0, 4e-6),
    "Translational.ElastoGap": Case(elasto_gap, 5.0, 8e-6),
    "Translational.Friction": Case(
        friction, 5.0, 4e-5, {b: f"{b}.friction.mode" for b in ("stop1", "stop2", "supportFriction")}
    ),
    "Translational.Oscillator": Case(oscillator, 1.0, 5e-4),
}
HYBRID = [name for name, case in CASES.items() if case.modes]


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
def test_every_counted_motion_agrees(name: str, reference: Callable[[str], Any]) -> None:
    expected, run = reference(name), run_of(name)
    rows = expected.between_events
    assert expected.motions
    for signal in expected.motions:
        values = expected.signals[signal][rows]
        ours = np.interp(expected.time[rows], run["time"], run[signal])
        assert np.abs(ours - values).max() < CASES[name].error * np.ptp(values), signal


@pytest.mark.parametrize("name", CASES)
def test_every_counted_mode_switches_when_it_should(name: str, reference: Callable[[str], Any]) -> None:
    expected, run = reference(name), run_of(name)
    assert expected.modes == [f"{element}.mode" for element in CASES[name].modes]
    for element, mode in CASES[name].modes.items():
        theirs, ours = lasting(expected.history(f"{element}.mode")), lasting(history(run, mode))
        assert [value for _, value in ours] == [value for _, value in theirs], element
        assert [t for t, _ in ours] == pytest.approx([t for t, _ in theirs], abs=BLINK), element


@pytest.mark.parametrize("name", HYBRID)
def test_break_away_comes_where_the_start_flags_rise(name: str, reference: Callable[[str], Any]) -> None:
    """MSL's startForward and startBackward are true from break-away until the speed is above zero.

    Here nothing lies between: break-away is the event stuck -> forward or backward. So a flag must fall
    within BLINK of its rise, and the rise must be such an event.
    """
    expected, run = reference(name), run_of(name)
    breakaways: list[Any] = [(e.mode, e.target, e.time) for e in run.events if e.source == "stuck"]
    risen = 0
    for signal in expected.starts:
        element, flag = signal.split(".")
        target = flag.removeprefix("start").lower()
        (_, at_first), *changes = expected.history(signal)
        assert not at_first, signal
        for (rise, _), (fall, _) in zip(changes[::2], changes[1::2], strict=True):
            risen += 1
            assert fall - rise < BLINK, signal
            assert (CASES[name].modes[element], target, pytest.approx(rise, abs=BLINK)) in breakaways, signal
    assert risen


def test_first_against_its_exact_solution() -> None:
    """What parts us from the reference of First (3.1e-4 of the range) is the reference's own error."""
    run = run_of("Rotational.First")
    # phi2, w2, phi3, w3, sin and cos of the torque; the inertia before the gear counts ratio^2 times
    c, J, omega = 1e4, 2 + 100 * 0.1, 10 * pi
    motion = np.zeros((6, 6))
    motion[0, 1] = motion[2, 3] = 1
    motion[1] = [-c / J, -10 / J, c / J, 0, 100 / J, 0]
    motion[3, [0, 2]] = c / 2, -c / 2
    motion[4, 5], motion[5, 4] = omega, -omega
    exact = np.array([expm(motion * t)[:, 5] for t in run["time"][::100]]).T
    for name, row in {"inertia2.phi": 0, "inertia2.w": 1, "inertia3.phi": 2, "inertia3.w": 3}.items():
        assert np.abs(run[name][::100] - exact[row]).max() < 1e-5 * np.ptp(exact[row]), name


def test_oscillator_against_its_closed_form() -> None:
    """What parts us from the reference of Oscillator (4.8e-4 of the range) is the reference's own error."""
    run = run_of("Translational.Oscillator")
    t, w0, w = run["time"], 100.0, 2 * pi * 15.9155
    exact = -0.5 + (np.sin(w * t) - w / w0 * np.sin(w0 * t)) / (w0**2 - w**2)
    assert np.abs(run["mass1.s"] - exact).max() < 5e-6 * np.ptp(exact)
