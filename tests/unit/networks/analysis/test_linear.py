"""Linearising: against simulation, closed forms and python-control; operating points; names and units."""

from math import inf, pi, sqrt
from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
import pytest
import scipy.linalg
import scipy.signal
from inertance.analysis import StateSpace
from inertance.networks import DAE


def quarter_car(strut: ia.Component) -> ia.Network:
    car = ia.Network(
        "car",
        road=ia.Position(),
        tyre=ia.Spring(k=150e3),
        wheel=ia.Mass(m=35.0),
        strut=strut,
        body=ia.Mass(m=250.0),
    )
    car.connect(car.road.flange, car.tyre.flange_a)
    car.connect(car.tyre.flange_b, car.wheel.flange, car.strut.flange_a)
    return car.connect(car.strut.flange_b, car.body.flange)


def rubbing(f_c: float = 5.0) -> ia.Network:
    """A mass that rubs on the ground, and one on a spring behind it."""
    net = ia.Network(
        "rubbing", wall=ia.Fixed(), rub=ia.CoulombFriction(f_c=f_c), first=ia.Mass(m=1.0),
        spring=ia.Spring(k=100.0), second=ia.Mass(m=2.0), push=ia.Force(),
    )  # fmt: skip
    net.connect(net.wall.flange, net.rub.flange_a)
    net.connect(net.rub.flange_b, net.first.flange, net.spring.flange_a)
    return net.connect(net.spring.flange_b, net.second.flange, net.push.flange)


def pendulum_like(k: float = -100.0, k3: float = 1e4) -> DAE:
    """Return a spring with two wells, at +-sqrt(-k/k3)."""
    net = ia.Network(
        "wells", wall=ia.Fixed(), spring=Well(k=k, k3=k3), mass=ia.Mass(m=1.0), damper=ia.Damper(d=1.0)
    )
    net.connect(net.wall.flange, net.spring.flange_a, net.damper.flange_a)
    return net.connect(net.spring.flange_b, net.damper.flange_b, net.mass.flange).dae()


class Well(ia.Compliant):
    """A spring of any sign with a cubic term."""

    k = ia.parameter("N/m", "linear stiffness")
    k3 = ia.parameter("N/m3", "cubic stiffness")

    def equations(self) -> Any:
        yield self.f == self.k * self.s_rel + self.k3 * self.s_rel**3


def test_oscillator_has_the_textbook_poles_names_and_units() -> None:
    net = ia.Network(
        "oscillator",
        wall=ia.Fixed(),
        strut=ia.SpringDamper(k=100.0, d=0.4),
        mass=ia.Mass(m=1.0),
        push=ia.Force(),
    )
    net.connect(net.wall.flange, net.strut.flange_a).connect(
        net.strut.flange_b, net.mass.flange, net.push.flange
    )
    system = ia.analysis.linearise(net, ["push.f"], ["mass.s", "mass.a"])
    assert system.states == ("mass.s", "mass.v")
    assert system.state_units == ("m", "m/s")
    assert system.input_units == ("N",)
    assert system.output_units == ("m", "m/s2")
    (mode,) = system.modes()
    assert mode.frequency == pytest.approx(10 / (2 * pi))
    assert mode.damping == pytest.approx(0.02)
    assert mode.shape["mass.s"] == pytest.approx(mode.shape["mass.a"] / mode.pole**2)
    assert system(0.0)[:, 0] == pytest.approx([0.01, 0.0])


def test_small_motion_agrees_with_a_run_to_1e_4() -> None:
    inerter = ia.series(ia.Damper(d=3224.0), ia.Inerter(b=333.0))
    net = quarter_car(ia.parallel(ia.CubicSpring(k=60e3, k3=1e7), inerter))
    f, amplitude = 1.5, 1e-5
    system = ia.analysis.linearise(net, ["road.s_ref"], ["body.a", "tyre.f"])
    stop = 12.0
    run = net.simulate(
        stop,
        inputs={"road.s_ref": lambda t: amplitude * np.sin(2 * pi * f * t)},
        rtol=1e-9,
        atol=1e-13,
        step=1e-3,
    )
    last = run.time > stop - 1 / f
    for name, gain in zip(system.outputs, system.response(f)[:, 0], strict=True):
        expected = amplitude * np.imag(gain * np.exp(2j * pi * f * run.time))
        assert run[name][last] == pytest.approx(expected[last], abs=1e-4 * abs(expected).max())


def test_derivatives_of_inputs_are_kept_out_of_the_states() -> None:
    """A mass on a driven flange: force m a is improper, with the acceleration as input it is a gain."""
    net = ia.Network(
        "shaker", table=ia.Position(), mass=ia.Mass(m=3.0), spring=ia.SpringDamper(k=50.0, d=1.0)
    )
    net.add(load=ia.Mass(m=2.0))
    net.connect(net.table.flange, net.mass.flange, net.spring.flange_a).connect(
        net.spring.flange_b, net.load.flange
    )
    by_position = ia.analysis.linearise(net, ["table.s_ref"], ["table.flange.f", "load.s"])
    by_acceleration = ia.analysis.linearise(net, ["der(der(table.s_ref))"], ["table.flange.f", "load.s"])
    assert len(by_position.D_s) == 2
    assert not by_position.proper
    assert by_acceleration.proper
    assert by_acceleration.input_units == ("m/s2",)
    s = 2.0 + 5.0j
    spring = (50.0 + s) * s**2 * 2.0 / (2.0 * s**2 + s + 50.0)
    exact = [-(3.0 * s**2 + spring), (50.0 + s) / (2.0 * s**2 + s + 50.0)]
    assert by_position(s)[:, 0] == pytest.approx(exact)
    assert by_acceleration(s)[:, 0] * s**2 == pytest.approx(by_position(s)[:, 0])
    with pytest.raises(ia.ModelError, match=r"der\(der\(table.s_ref\)\)"):
        by_position.to_scipy()


def test_parameters_can_be_inputs() -> None:
    net = ia.Network(
        "hanging",
        wall=ia.Fixed(),
        spring=ia.Spring(k=100.0),
        mass=ia.Mass(m=1.0),
        w=ia.ConstantForce(f_constant=9.81),
    )
    net.connect(net.wall.flange, net.spring.flange_a).connect(
        net.spring.flange_b, net.mass.flange, net.w.flange
    )
    system = ia.analysis.linearise(net, ["spring.k", "w.f_constant"], ["mass.s"])
    assert system.point is not None
    assert system.point.values["mass.s"] == pytest.approx(0.0981)
    assert system(0.0)[0] == pytest.approx([-9.81 / 100.0**2, 0.01])


def test_stuck_friction_is_linear_in_its_mode_and_told() -> None:
    system = ia.analysis.linearise(rubbing(), ["push.f"], ["second.s", "first.s"], signals={"push.f": 1.0})
    assert system.point is not None
    assert system.point.modes == {"rub.mode": "stuck"}
    assert system.states == ("second.v", "second.s")
    assert system.poles.imag == pytest.approx([-sqrt(50.0), sqrt(50.0)])
    assert system.point.values["second.s"] == pytest.approx(0.01)
    assert system(1j)[1, 0] == 0.0
    assert any("rub.mode is 'stuck'" in note for note in system.notes)
    assert any("held" in note and "rub.v_rel" in note for note in system.notes)


def test_what_slid_to_its_rest_holds_there() -> None:
    """From a stretched spring it slides up to where friction holds, where it was taken to slide on."""
    net = ia.Network(
        "o", wall=ia.Fixed(), spring=ia.Spring(k=400.0), rub=ia.CoulombFriction(f_c=5.0),
        mass=ia.Mass(m=1.0, s=0.1), push=ia.Force(),
    )  # fmt: skip
    net.connect(net.wall.flange, net.spring.flange_a, net.rub.flange_a)
    net.connect(net.spring.flange_b, net.rub.flange_b, net.mass.flange, net.push.flange)
    system = ia.analysis.linearise(net, ["push.f"], ["mass.s"])
    assert system.point is not None
    assert system.point.modes == {"rub.mode": "stuck"}
    assert system.point.values["rub.s_rel"] == pytest.approx(5.0 / 400.0)
    assert system.states == ()
    assert system(0j).item() == 0.0
    assert any("rub.mode is 'stuck'" in note for note in system.notes)


def test_a_mass_pressed_on_a_stop_rests_on_it() -> None:
    """Its equilibrium was taken 50 mm inside the stop, where the spring is relaxed."""
    net = ia.Network(
        "rest", wall=ia.Fixed(), spring=ia.Spring(k=400.0), stop=ia.HardStop(s_min=0.05),
        mass=ia.Mass(m=1.0, s=0.1), push=ia.Force(),
    )  # fmt: skip
    net.connect(net.wall.flange, net.spring.flange_a, net.stop.flange_a)
    net.connect(net.spring.flange_b, net.stop.flange_b, net.mass.flange, net.push.flange)
    system = ia.analysis.linearise(net, ["push.f"], ["mass.s"])
    assert system.point is not None
    assert system.point.modes == {"stop.mode": "contact"}
    assert system.states == ()
    assert ia.analysis.operating_point(net).values["stop.s_rel"] == pytest.approx(0.05)


@pytest.mark.parametrize("law", [ia.Backlash(k=1.0, d=1.0, eps=0.1), ia.QuadraticDamper(c=1.0)])
def test_what_has_no_slope_in_series_with_a_spring_has_no_admittance(law: ia.Component) -> None:
    """A clearance passes no force on; the admittance of the spring alone was returned."""
    with pytest.raises(ia.ModelError, match=r"not linear here: .*\.v_rel has no slope"):
        ia.analysis.admittance(ia.series(law, ia.Spring(k=1.0)))


def test_a_force_past_break_away_leaves_no_equilibrium() -> None:
    with pytest.raises(ia.ModelError, match=r"no equilibrium near its start: der\(.*remains"):
        ia.analysis.linearise(rubbing(), signals={"push.f": 7.0})


def test_sliding_friction_is_linearised_along_a_run() -> None:
    net = rubbing(0.5)
    run = net.simulate(1.0, inputs={"push.f": 7.0})
    assert run["rub.mode"][-1] == 1
    system = ia.analysis.linearise(net, ["push.f"], ["second.s"], at=run, time=1.0)
    assert len(system.states) == 4
    assert abs(system.poles) == pytest.approx([0, 0, sqrt(150.0), sqrt(150.0)], abs=1e-6)


def test_all_wells_are_found() -> None:
    points = ia.analysis.equilibria(pendulum_like(), spread=0.3)
    assert sorted(p.values["mass.s"] for p in points) == pytest.approx([-0.1, 0.0, 0.1], abs=1e-9)


def test_admittances_of_elements_and_of_flanges_in_a_network() -> None:
    s = 0.3 + 2j
    tid = ia.parallel(ia.Spring(k=5.0), ia.series(ia.Damper(d=2.0), ia.Inerter(b=3.0)))
    exact = 5.0 / s + 1 / (1 / 2.0 + 1 / (3.0 * s))
    assert ia.analysis.admittance(tid)(s).item() == pytest.approx(exact)
    assert ia.analysis.impedance(tid)(s).item() == pytest.approx(1 / exact)
    wheel = ia.rotational.Inerter(J=2.0)
    assert ia.analysis.admittance(wheel)(s).item() == pytest.approx(2.0 * s)
    car = quarter_car(tid)
    masses = 1 / (1 / (250.0 * s) + 1 / (35.0 * s + 150e3 / s))
    assert ia.analysis.admittance(car, "strut.flange_a", "strut.flange_b")(s).item() == pytest.approx(
        exact + masses
    )
    with pytest.raises(ia.ModelError, match="did you mean 'flange_b'"):
        ia.analysis.admittance(car, "strut.flange_x", "strut.flange_b")


def test_norms_are_infinite_for_a_reason() -> None:
    net = quarter_car(ia.SpringDamper(k=60e3, d=2600.0))
    direct = ia.analysis.linearise(net, ["road.s_ref"], ["tyre.f"]).h2()
    assert direct == inf
    assert "strictly proper" in direct.reason
    free = ia.analysis.linearise(net, ["der(road.s_ref)"], ["body.s"]).h2()
    assert free == inf
    assert "pole at" in free.reason


def test_hinf_finds_the_peak_of_an_oscillator() -> None:
    zeta = 1e-3
    system = StateSpace(
        np.array([[0, 1.0], [-1.0, -2 * zeta]]),
        np.array([[0], [1.0]]),
        np.array([[1.0, 0]]),
        np.zeros((1, 1)),
    )
    peak = system.hinf()
    assert peak == pytest.approx(1 / (2 * zeta * sqrt(1 - zeta**2)), rel=1e-9)
    assert peak.frequency == pytest.approx(sqrt(1 - 2 * zeta**2) / (2 * pi), rel=1e-6)
    assert system.h2() == pytest.approx(sqrt(1 / (4 * zeta)), rel=1e-12)


def test_names_that_are_wrong_are_told() -> None:
    net = quarter_car(ia.Spring(k=1.0))
    with pytest.raises(ia.ModelError, match=r"did you mean 'road\.s_ref'"):
        ia.analysis.linearise(net, ["road.s_re"])
    with pytest.raises(ia.ModelError, match=r"no output 'body\.x'"):
        ia.analysis.linearise(net, outputs=["body.x"])
    with pytest.raises(KeyError, match=r"did you mean 'body\.v'"):
        ia.analysis.linearise(net)["body.w", "road.s_ref"]


def test_python_control_agrees_to_1e_10_and_gives_back_what_it_got() -> None:
    control = pytest.importorskip("control")
    net = quarter_car(ia.SpringDamper(k=60e3, d=2600.0))
    system = ia.analysis.linearise(net, ["road.s_ref"], ["body.v", "wheel.v"])
    other = system.to_ss()
    w = np.geomspace(0.1, 300.0, 50)
    theirs = np.moveaxis(other(1j * w, squeeze=False), -1, 0)
    assert abs(theirs - system(1j * w)).max() <= 1e-10 * abs(theirs).max()
    assert sorted(other.poles().imag) == pytest.approx(sorted(system.poles.imag), rel=1e-10)
    assert float(system.h2()) == pytest.approx(control.norm(other, 2), rel=1e-10)
    back = StateSpace.from_ss(other)
    assert (back.A == system.A).all()
    assert back.inputs == ("road_s_ref",)


def test_scipy_there_and_back() -> None:
    system = ia.analysis.linearise(quarter_car(ia.SpringDamper(k=60e3, d=2600.0)), ["road.s_ref"], ["body.s"])
    theirs = system.to_scipy()
    time = np.linspace(0.0, 0.5, 501)
    _, moved, _ = scipy.signal.lsim(theirs, np.ones(len(time)), time)
    steady = -np.linalg.solve(system.A, system.B)
    end = steady - scipy.linalg.expm(system.A * 0.5) @ steady
    assert moved[-1] == pytest.approx((system.C @ end).item(), rel=1e-9)
    lag = StateSpace.from_ss(scipy.signal.TransferFunction([3.0], [0.5, 1.0]))
    assert lag(2j).item() == pytest.approx(3.0 / (1j + 1.0))


def test_plots_carry_names_and_units(tmp_path: Path) -> None:
    from matplotlib import pyplot

    system = ia.analysis.linearise(quarter_car(ia.SpringDamper(k=60e3, d=2600.0)), ["road.s_ref"], ["body.a"])
    figure = system.plot_bode()
    legend = figure.axes[0].get_legend()
    assert legend is not None
    assert legend.get_texts()[0].get_text() == "body.a [m/s² / (m)]"
    assert figure.axes[1].get_xlabel() == "frequency [Hz]"
    assert system.plot_nyquist().axes[0].get_title() == "car"
    assert len(ia.analysis.plot_modes(system.modes()).axes) == 2
    animation = ia.analysis.animate_modes(system.modes(), frames=4)
    animation.save(tmp_path / "modes.gif", writer="pillow")
    assert (tmp_path / "modes.gif").stat().st_size > 1000
    pyplot.close("all")
