"""What is given is seen, whenever it comes and however short it is."""

from functools import cache
from typing import Any

import casadi as ca
import numpy as np
import pytest
from inertance import (
    Component,
    ConstantForce,
    CoulombFriction,
    Damper,
    Fixed,
    Force,
    Inerter,
    Mass,
    ModelError,
    Network,
    Position,
    RealOutput,
    Sampled,
    Speed,
    Spring,
    SpringDamper,
    parallel,
    parameter,
    series,
    simulate,
)
from inertance.machines import quarter_car as ready_car
from inertance.machines import suspension

SOLVERS = ("cvodes", "idas", "rosenbrock", "compiled")


class Bump(Component):
    """A cosine bump of 5 cm and 0.4 s, as a block that looks at the clock by itself."""

    start_time = parameter("s", "when it begins")
    y = RealOutput("m", "height")

    def equations(self) -> Any:
        since = self.time - self.start_time
        inside = ca.logic_and(since >= 0, since < 0.4)
        yield self.y == ca.if_else(inside, 0.025 * (1 - ca.cos(5 * ca.pi * since)), 0.0)


def bump(start: float) -> Any:
    return lambda t: ca.if_else(
        ca.logic_and(t >= start, t < start + 0.4), 0.025 * (1 - ca.cos(5 * ca.pi * (t - start))), 0.0
    )


def quarter_car(**road: Any) -> Network:
    tid = series(SpringDamper(k=24e3, d=2400.0), Inerter(b=190.0))
    strut = parallel(Spring(k=60e3), tid)
    car = Network(
        "quarter car",
        road=Position(),
        tyre=Spring(k=150e3),
        wheel=Mass(m=35.0),
        strut=strut,
        body=Mass(m=250.0),
        **road,
    )
    car.connect(car.road.flange, car.tyre.flange_a)
    car.connect(car.tyre.flange_b, car.wheel.flange, car.strut.flange_a)
    car.connect(car.strut.flange_b, car.body.flange)
    return car


def oscillator(**source: Any) -> Network:
    net = Network(
        "oscillator",
        wall=Fixed(),
        spring=Spring(k=100.0),
        damper=Damper(d=1.0),
        mass=Mass(m=1.0),
        push=Force(**source),
    )
    net.connect(net.wall.flange, net.spring.flange_a, net.damper.flange_a)
    return net.connect(net.spring.flange_b, net.damper.flange_b, net.mass.flange, net.push.flange)


def pulse(begin: float, end: float) -> Any:
    return lambda t: ca.if_else(ca.logic_and(t > begin, t < end), 1.0, 0.0)


PEAK = 8.2225


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_bump_gives_the_same_peak_whenever_it_comes(solver: Any) -> None:
    dae = quarter_car().dae()
    for start in (0, 0.25, 1, 10, 100):
        run = simulate(dae, start + 3.0, step=1e-3, inputs={"road.s_ref": bump(start)}, solver=solver)
        assert abs(run["body.a"]).max() == pytest.approx(PEAK, rel=1e-5), start
        if solver == "compiled":
            break  # each function is compiled; later ones come as data below


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_bump_in_data_gives_the_same_peak_whenever_it_comes(solver: Any) -> None:
    dae = quarter_car().dae()
    for start in (0, 0.25, 1, 10, 100):
        t = np.arange(0, start + 3.001, 1e-3)
        inside = (t >= start) & (t < start + 0.4)
        road = np.where(inside, 0.025 * (1 - np.cos(5 * np.pi * (t - start))), 0.0)
        run = simulate(dae, start + 3.0, step=1e-3, inputs={"road.s_ref": (t, road)}, solver=solver)
        assert abs(run["body.a"]).max() == pytest.approx(PEAK, rel=1e-5), start


@pytest.mark.parametrize("start", [0.0, 1.0, 100.0])
def test_a_bump_from_a_block_gives_the_same_peak_whenever_it_comes(start: Any) -> None:
    car = quarter_car(profile=Bump(start_time=start))
    car.connect(car.profile.y, car.road.s_ref)
    run = car.simulate(start + 3.0, step=1e-3)
    assert abs(run["body.a"]).max() == pytest.approx(PEAK, rel=1e-5)


@cache
def exactly_pushed() -> Any:
    given = {"push.f": pulse(5.0, 5.5)}
    return oscillator().simulate(10.0, inputs=given, solver="rosenbrock", max_step=1e-3)


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("step", [None, 2e-3])
def test_a_pulse_of_force_is_seen_with_any_output_step(solver: Any, step: Any) -> None:
    run = oscillator().simulate(10.0, inputs={"push.f": pulse(5.0, 5.5)}, solver=solver, step=step)
    exact = exactly_pushed()
    assert exact.at("mass.s", 5.3) > 5e-3
    assert run["mass.s"][-1] == pytest.approx(exact["mass.s"][-1], abs=1e-6)


@pytest.mark.parametrize(
    "signal",
    [
        lambda t: ca.exp(-(((t - 700.0) / 1e-4) ** 2)) * 1e4,
        lambda t: ca.sin(0.1 * t) * 0 + ca.exp(-(((t - 700.0) / 1e-4) ** 2)) * 1e4,
        lambda t: 1e4 * ca.fmax(0, 1 - ca.fabs(t - 700.0) / (ca.sqrt(ca.pi) * 1e-4)),
        lambda t: ca.if_else(ca.fabs(t - 700) < 0.5 * ca.sqrt(ca.pi) * 1e-4, 1e4, 0),
        lambda t: ca.if_else(
            ca.fmod(t, 1000.0) > 700.0, ca.if_else(t < 700 + ca.sqrt(ca.pi) * 1e-4, 1e4, 0), 0
        ),
    ],
    ids=["smooth", "smooth on another", "triangle", "rectangle", "periodic"],
)
def test_a_blow_of_a_tenth_of_a_millionth_of_the_run_is_seen(signal: Any) -> None:
    net = Network("wagon", push=Force(), mass=Mass(m=1.0))
    net.connect(net.push.flange, net.mass.flange)
    run = net.simulate(1000.0, inputs={"push.f": signal})
    assert run["mass.v"][-1] == pytest.approx(np.sqrt(np.pi), rel=1e-5)


@pytest.mark.parametrize("solver", ["auto", "compiled"])
def test_a_block_held_by_friction_slips_at_each_short_pulse(solver: Any) -> None:
    def pulses(t: Any) -> Any:
        return 20.0 * (pulse(3.0, 3.001)(t) + pulse(7.0, 7.001)(t))

    net = Network("block", floor=Fixed(), friction=CoulombFriction(f_c=1.0), mass=Mass(m=1.0), push=Force())
    net.connect(net.floor.flange, net.friction.flange_a)
    net.connect(net.friction.flange_b, net.mass.flange, net.push.flange)
    run = net.simulate(10.0, inputs={"push.f": pulses}, solver=solver)
    v = 19.0 * 1e-3
    slid = 2 * (0.5 * 19.0 * 1e-6 + v**2 / 2)
    assert run["mass.s"][-1] == pytest.approx(slid, rel=1e-4)
    slips = [event.time for event in run.events if event.source == "stuck"]
    assert slips == pytest.approx([3.0, 7.0], abs=1e-9)


@pytest.mark.parametrize("solver", SOLVERS)
def test_before_and_after_a_jump_are_two_points(solver: Any) -> None:
    net = Network("wagon", push=Force(), mass=Mass(m=2.0))
    net.connect(net.push.flange, net.mass.flange)
    run = net.simulate(
        2.0, step=0.5, inputs={"push.f": lambda t: ca.if_else(t < 0.7, 0.0, 4.0)}, solver=solver
    )
    around = run["mass.a"][np.abs(run.time - 0.7) < 1e-9]
    assert around.tolist() == [0.0, 2.0]
    assert run["mass.v"][-1] == pytest.approx(2.6, rel=1e-9)


def test_a_jump_at_an_output_takes_the_place_of_the_output() -> None:
    net = Network("wagon", push=Force(), mass=Mass(m=2.0))
    net.connect(net.push.flange, net.mass.flange)
    for solver in SOLVERS:
        signal = lambda t: ca.if_else(t < 1.0, 0.0, 4.0)  # noqa: E731
        run = net.simulate(2.0, step=0.5, inputs={"push.f": signal}, solver=solver)
        assert run.time.tolist() == pytest.approx([0, 0.5, 1, 1, 1.5, 2], abs=1e-12)
        assert run["mass.a"].tolist() == [0, 0, 0, 2, 2, 2]


def test_a_kink_adds_no_point() -> None:
    ramp = lambda t: ca.fmax(0.0, t - 0.37)  # noqa: E731
    run = oscillator().simulate(1.0, step=0.01, inputs={"push.f": ramp})
    assert run.time == pytest.approx(np.linspace(0, 1, 101), abs=0)


def test_sensitivities_are_followed_over_jumps() -> None:
    signal = pulse(0.33, 0.5)
    net = oscillator()
    run = net.simulate(1.0, inputs={"push.f": signal}, sensitivities=["spring.k"], rtol=1e-9, atol=1e-12)
    h = 1e-2
    less, more = (
        net.simulate(1.0, inputs={"push.f": signal}, parameters={"spring.k": k}, rtol=1e-10, atol=1e-13)
        for k in (100 - h, 100 + h)
    )
    times = np.linspace(0, 1, 51)
    slope = [(more.at("mass.s", t) - less.at("mass.s", t)) / (2 * h) for t in times]
    followed = run.sensitivity("mass.s", "spring.k")
    assert followed.shape == run.time.shape
    assert np.interp(times, run.time, followed) == pytest.approx(np.array(slope), abs=1e-8)


def test_a_run_that_begins_within_or_after_a_pulse_sees_what_is_left() -> None:
    net = Network("wagon", push=Force(), mass=Mass(m=1.0))
    net.connect(net.push.flange, net.mass.flange)
    for begin, seen in ((-5.0, 1.0), (4.0, 1.0), (4.5, 0.5), (5.0, 0.0)):
        run = net.simulate(8.0, begin=begin, inputs={"push.f": pulse(4.0, 5.0)})
        assert run["mass.v"][-1] == pytest.approx(seen, abs=1e-8)


def test_a_prescribed_speed_is_seen_late() -> None:
    net = Network(
        "drive",
        drive=Speed(v_ref=lambda t: ca.exp(-(((t - 80) / 0.01) ** 2))),
        damper=Damper(d=5.0),
        mass=Mass(m=1.0),
    )
    net.connect(net.drive.flange, net.damper.flange_a)
    net.connect(net.damper.flange_b, net.mass.flange)
    run = net.simulate(100.0)
    assert run["drive.flange.s"][-1] == pytest.approx(0.01 * np.sqrt(np.pi), rel=1e-4)
    assert run["mass.s"][-1] == pytest.approx(0.01 * np.sqrt(np.pi), rel=1e-4)


def test_a_function_of_numbers_alone_is_seen_by_its_numbers() -> None:
    t = np.linspace(0, 100, 10_001)
    table = ca.interpolant("table", "linear", [t], np.where((t > 50.005) & (t < 50.195), 1.0, 0.0))
    net = Network("wagon", push=Force(f=Sampled(t, 0 * t)), pull=Force(), mass=Mass(m=1.0))
    net.connect(net.push.flange, net.pull.flange, net.mass.flange)
    run = net.simulate(100.0, inputs={"pull.f": lambda t: table(t)})
    assert run["mass.v"][-1] == pytest.approx(0.19, rel=1e-4)
    assert run.stats["steps"] < 1000


@pytest.mark.parametrize("kind", ["linear", "jagged", "needle", "cliffs"])
def test_a_table_is_followed_as_its_data_are(kind: str) -> None:
    """Its knots, between any instants, are found in its numbers."""
    rng = np.random.default_rng(1)
    t, values = np.sort(np.append(rng.uniform(7.0, 31.0, 300), [7.0, 31.0])), rng.normal(size=302)
    if kind == "linear":
        values = 3 * t
    elif kind == "needle":
        values = np.where(np.arange(302) == 123, 50.0, 0.0)
    elif kind == "cliffs":
        t, values = np.array([7, 9, 9 + 1e-6, 20, 20 + 1e-6, 31]), np.array([0, 0, 1, 2, -1, 0.0])
    table = ca.interpolant("table", "linear", [t], values)
    signals: list[Any] = [Sampled(t, values, interpolation="linear"), lambda t: table(t)]
    given = ({"push.f": signal} for signal in signals)
    runs = [oscillator().simulate(31.0, begin=7.0, inputs=each, solver="cvodes") for each in given]
    one, other = (run["mass.s"][-1] for run in runs)
    assert other == pytest.approx(one, abs=1e-4 * np.ptp(runs[0]["mass.s"]))
    assert runs[1].stats["steps"] < 1.3 * runs[0].stats["steps"] + 100


@pytest.mark.parametrize("cliff", [0.0, 1.0])
def test_a_function_that_is_no_table_is_seen_by_its_numbers(cliff: float) -> None:
    def wave(t: Any) -> Any:
        return ca.sin(3 * t) + ca.if_else(t > 5.5, cliff, 0.0)

    t = ca.MX.sym("t")
    shape = ca.Function("shape", [t], [wave(t)], {"never_inline": True})
    signals: list[Any] = [wave, lambda t: shape(t)]
    runs = [oscillator().simulate(10.0, inputs={"push.f": signal}, rtol=1e-8) for signal in signals]
    one, other = (run["mass.s"][-1] for run in runs)
    assert other == pytest.approx(one, abs=1e-5 * np.ptp(runs[0]["mass.s"]))


@pytest.mark.parametrize("around", ["added", "times", "second output"])
def test_a_short_pulse_around_a_function_is_not_stepped_over(around: str) -> None:
    """It lies between any two of the instants at which numbers are looked at."""
    s = ca.MX.sym("s")
    pair = ca.Function("pair", [s], [ca.cos(s), 0 * s], {"never_inline": True})
    table = ca.interpolant("table", "linear", [[0.0, 100.0]], [0.0, 0.0])

    def push(t: Any) -> Any:
        pulse = ca.if_else(ca.logic_and(t > 50.00003, t < 50.00013), 1e4, 0.0)
        if around == "second output":
            return pair(t)[1] + pulse
        return pulse * (1 + table(t)) if around == "times" else pulse + table(t)

    net = Network("wagon", push=Force(f=push), mass=Mass(m=1.0))
    net.connect(net.push.flange, net.mass.flange)
    assert net.simulate(100.0)["mass.v"][-1] == pytest.approx(1.0, rel=1e-6)


def test_a_signal_need_not_be_hashable() -> None:
    class Pull:
        __hash__ = None  # type: ignore[assignment]

        def __call__(self, t: Any) -> Any:
            return 0 * t + 1.0

    run = oscillator().simulate(1.0, inputs={"push.f": Pull()})
    assert run["mass.s"][-1] > 0


def test_the_longest_step_is_kept() -> None:
    runs = [oscillator().simulate(10.0, inputs={"push.f": 1.0}, max_step=h) for h in (1e-2, 1e-3)]
    assert runs[0].stats["steps"] >= 1000
    assert runs[1].stats["steps"] >= 10_000
    with pytest.raises(ModelError, match="max_step must be above 0 s, got 0"):
        oscillator().simulate(1.0, inputs={"push.f": 1.0}, max_step=0)


def test_a_function_that_returns_another_formula_each_time_is_refused() -> None:
    """Random numbers drawn in a function were read once, and were a constant."""
    rng = np.random.default_rng(0)
    net = Network("pushed", push=Force(), mass=Mass(m=1.0))
    net.connect(net.push.flange, net.mass.flange)
    with pytest.raises(ModelError, match=r"input 'push.f': .* returns another each time; draw random"):
        net.simulate(1.0, inputs={"push.f": lambda t: rng.normal() * t})


@pytest.mark.parametrize("force", [0.3, -4.905, 1e6 / 3])
def test_a_constant_force_does_not_shorten_steps(force: Any) -> None:
    def steps(given: float) -> int:
        net = Network("held", wall=Fixed(), spring=Spring(k=100.0), mass=Mass(m=1.0))
        net.add(push=ConstantForce(f_constant=given), pull=Force(f=given))
        net.connect(net.wall.flange, net.spring.flange_a)
        net.connect(net.spring.flange_b, net.mass.flange, net.push.flange, net.pull.flange)
        return int(net.simulate(2.0).stats["steps"])

    rounded = 2.0 ** np.round(np.log2(abs(force)))  # whose multiples are exact
    assert steps(force) < 2 * steps(rounded)


@pytest.mark.parametrize("solver", ["cvodes", "rosenbrock", "compiled"])
def test_a_low_wide_pulse_is_felt_beside_high_narrow_ones(solver: Any) -> None:
    """Cut into small parts, it looked like a polynomial in each, and was stepped over."""

    def push(t: Any) -> Any:
        return 4e4 * ca.exp(-(((t - 1.8) / 5e-4) ** 2)) + 40.0 * ca.exp(-(((t - 0.52) / 0.03) ** 2))

    net = Network("wagon", push=Force(), mass=Mass(m=1.0))
    net.connect(net.push.flange, net.mass.flange)
    run = net.simulate(12.0, inputs={"push.f": push}, solver=solver, rtol=1e-8)
    assert run["mass.v"][-1] == pytest.approx((4e4 * 5e-4 + 40.0 * 0.03) * np.sqrt(np.pi), rel=1e-6)


@pytest.mark.parametrize("interpolation", ["linear", "cubic"])
def test_corners_of_noisy_data_do_not_shorten_steps_below_their_own(interpolation: Any) -> None:
    """A cubic has corners in its second derivative, and corners stay corners however close one looks."""
    noise = np.random.default_rng(1).normal(size=2001)
    time = np.linspace(0.0, 2.0, len(noise))
    net = Network("shaken", drive=Position(), inerter=Inerter(b=2.0), mass=Mass(m=1.0), push=Force())
    net.connect(net.drive.flange, net.inerter.flange_a)
    net.connect(net.inerter.flange_b, net.mass.flange, net.push.flange)
    data = Sampled(time, noise, interpolation=interpolation)
    moved = Sampled(time, 1e-6 * np.cumsum(np.cumsum(noise)))
    given = {"push.f": data, "drive.s_ref": moved if interpolation == "cubic" else 0.0}
    run = net.simulate(2.0, inputs=given, solver="compiled")
    assert run.stats["steps"] < 15 * len(noise)


def test_a_slow_course_does_not_shorten_steps() -> None:
    car = ready_car(suspension("S1", k=60e3, d=2000.0))
    run = car.simulate(10.0, inputs={"road.s_ref": lambda t: 0.01 * ca.sin(6 * t)}, rtol=1e-4, atol=1e-6)
    assert run.stats["steps"] < 700  # 1057 where an input that stays 0 counted as the finest of courses


@pytest.mark.parametrize("solver", ["cvodes", "rosenbrock"])
def test_a_pulse_in_data_is_felt_before_a_wider_one_that_samples_show(solver: Any) -> None:
    """A few samples of the end of this interval lie on a parabola, by chance, and the first pulse between."""
    end, triangles = 0.6667152623591912, ((2901.0, 0.62006107, 0.00035169), (2652.0, 0.62411032, 0.00373779))
    near = [np.linspace(at - 1.2 * width, at + 1.2 * width, 401) for _, at, width in triangles]
    time = np.unique(np.concatenate([np.linspace(0.0, end, 50), *near]).round(13))
    force = sum(size * np.maximum(0.0, 1 - 2 * np.abs(time - at) / width) for size, at, width in triangles)
    net = Network("wagon", push=Force(), mass=Mass(m=1.0))
    net.connect(net.push.flange, net.mass.flange)
    data = Sampled(time, force, interpolation="linear")
    run = net.simulate(end, inputs={"push.f": data}, solver=solver, rtol=1e-8)
    assert run["mass.v"][-1] == pytest.approx(np.trapezoid(force, time), rel=1e-5)


def test_rest_around_a_smooth_kerb_costs_no_start_anew() -> None:
    car = ready_car(suspension("S4", k=60e3, d=2000.0, b=200.0))
    kerb = {"road.s_ref": lambda t: 0.02 / (1 + ca.exp(-40 * (t - 1)))}
    run = car.simulate(3.0, inputs=kerb, atol=1e-8)
    assert run.stats["integrator calls"] == 1
    assert run.stats["steps"] < 400  # 325 where nothing bounds them, 774 in twelve calls


def test_steps_are_short_only_near_what_is_short() -> None:
    net = Network("wagon", push=Force(), mass=Mass(m=1.0))
    net.connect(net.push.flange, net.mass.flange)
    run = net.simulate(1000.0, inputs={"push.f": lambda t: ca.exp(-(((t - 50) / 0.03) ** 2))})
    assert run["mass.v"][-1] == pytest.approx(0.03 * np.sqrt(np.pi), rel=1e-5)
    assert run.stats["steps"] < 1000


@pytest.mark.parametrize("solver", ["cvodes", "idas", "rosenbrock"])
@pytest.mark.parametrize(("centre", "width"), [(0.7188376, 0.0029295), (0.3749989, 0.0003554)])
def test_a_pulse_in_data_is_felt_that_two_parts_of_the_run_share(
    solver: Any, centre: float, width: float
) -> None:
    """Each part saw a flank at its end, a tenth off a quartic, and steps were as long as the pulse."""
    near = np.linspace(centre - 1.2 * width, centre + 1.2 * width, 401)
    time = np.unique(np.concatenate([np.linspace(0.0, 1.0, 50), near]).round(13))
    phase = (time - centre) / width
    force = np.where(np.abs(phase) < 0.5, 0.5 + 0.5 * np.cos(2 * np.pi * phase), 0.0) / width
    net = Network("wagon", push=Force(), mass=Mass(m=1.0))
    net.connect(net.push.flange, net.mass.flange)
    run = net.simulate(1.0, inputs={"push.f": Sampled(time, force)}, solver=solver, rtol=1e-8)
    assert run["mass.v"][-1] == pytest.approx(0.5, rel=1e-4)
