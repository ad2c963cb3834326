"""Runs: solvers, algebraic unknowns, failures that keep what was computed, and reading the result."""

from collections.abc import Callable
from typing import Any

import casadi as ca
import inertance as ia
import numpy as np
import pytest
from inertance.networks.simulation.settings import Tolerance

TIGHT: dict[str, Any] = {"rtol": 1e-9, "atol": 1e-11}
SOLVERS = ["cvodes", "idas", "rosenbrock"]


class Implicit(ia.Compliant):
    """f + f^3 = k s_rel, which no solver of linear equations turns around."""

    k = ia.parameter("N/m", "stiffness at rest")

    def equations(self) -> Any:
        yield self.f + self.f**3 == self.k * self.s_rel


class Growing(ia.Component):
    """x' = law(x), with x as a force."""

    flange = ia.TranslationalFlange("where it acts")
    x = ia.variable("N", "what grows", start=0.5)

    def equations(self) -> Any:
        yield ia.der(self.x) == self.law(self.x)
        yield self.flange.f == self.x


class Escaping(Growing):
    """x' = x^2, infinite at t = 2."""

    def law(self, x: Any) -> Any:
        return x**2


class Rooted(Growing):
    """x' = 1 + sqrt(1 - x), which ends at x = 1."""

    def law(self, x: Any) -> Any:
        return 1 + ca.sqrt(1 - x)


def oscillator(element: ia.Component, *more: ia.Component, **start: float) -> ia.Network:
    net = ia.Network("oscillator", wall=ia.Fixed(), element=element, mass=ia.Mass(m=1.0, **start))
    net.add(**{f"e{i}": part for i, part in enumerate(more)})
    net.connect(net.wall.flange, net.element.flange_a, *(part.flange_a for part in more))
    return net.connect(net.mass.flange, net.element.flange_b, *(part.flange_b for part in more))


def smooth() -> ia.Network:
    net = oscillator(ia.CubicSpring(k=10.0, k3=3.0), ia.QuadraticDamper(c=0.3), s=0.3)
    return net.add(push=ia.Force(f=lambda t: ca.sin(3 * t))).connect(net.push.flange, net.mass.flange)


@pytest.mark.parametrize("solver", SOLVERS)
def test_solvers_agree(solver: str) -> None:
    run = smooth().simulate(4.0, solver=solver, **TIGHT)
    reference = smooth().simulate(4.0, rtol=1e-11, atol=1e-13)
    assert run["mass.s"] == pytest.approx(reference["mass.s"], abs=1e-7)
    assert run.stats["solver"] == solver


def test_the_solver_follows_the_equations() -> None:
    assert smooth().simulate(0.1).stats["solver"] == "cvodes"
    assert oscillator(Implicit(k=30.0)).simulate(0.1).stats["solver"] == "idas"
    with pytest.raises(
        ia.ModelError, match="keeps 1 algebraic unknowns, which solver 'cvodes' cannot handle"
    ):
        oscillator(Implicit(k=30.0)).simulate(0.1, solver="cvodes")


@pytest.mark.parametrize("solver", ["idas", "rosenbrock"])
@pytest.mark.parametrize(
    "event",
    [
        None,
        ia.CoulombFriction(f_c=0.5),
        ia.HardStop(e=0.5, s_min=0.2),
        ia.StribeckFriction(f_c=0.3, f_s=0.5, v_s=0.1),
    ],
)
def test_algebraic_unknowns_with_and_without_events(event: ia.Component | None, solver: str) -> None:
    net = oscillator(Implicit(k=30.0), *([event.clone()] if event else []), s=1.0)
    run = net.simulate(3.0, solver=solver, **TIGHT)
    assert run.dae.z.numel() == 1
    f, v = run["element.f"], run["mass.v"]
    assert f + f**3 == pytest.approx(30.0 * run["element.s_rel"], abs=1e-5)
    reference = net.simulate(3.0, solver="rosenbrock", rtol=1e-10, atol=1e-12)
    first = [event.time for event in reference.events[:5]]
    assert [event.time for event in run.events[:5]] == pytest.approx(first, abs=1e-7)
    assert run["mass.s"][-1] == pytest.approx(reference["mass.s"][-1], abs=1e-6)
    energy = v**2 / 2 + (f**2 / 2 + 3 * f**4 / 4) / 30.0
    assert energy.max() <= energy[0] * (1 + 1e-7)
    if event:
        assert energy[-1] < energy[0]
    else:
        assert energy[-1] == pytest.approx(energy[0], rel=1e-6)


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize(
    ("part", "end"), [(Escaping, 2.0), (Rooted, 2 * np.sqrt(0.5) - 2 * np.log(1 + np.sqrt(0.5)))]
)
def test_a_run_that_fails_keeps_what_was_computed(
    part: type[ia.Component], end: float, solver: str, capfd: pytest.CaptureFixture[str]
) -> None:
    net = ia.Network("failing", part=part(), mass=ia.Mass(m=1.0), rub=ia.Damper(d=1.0), wall=ia.Fixed())
    net.connect(net.part.flange, net.mass.flange, net.rub.flange_b).connect(net.rub.flange_a, net.wall.flange)
    with pytest.raises(
        ia.SimulationError, match=r"'failing': integration failed at t = .*part\.x = "
    ) as caught:
        net.simulate(3.0, solver=solver)
    kept = caught.value.result
    assert isinstance(kept, ia.Result)
    assert kept.time[-1] == pytest.approx(end, abs=1e-3)
    assert np.isfinite(kept["part.x"]).all()
    assert kept["part.x"][0] == 0.5
    assert (np.diff(kept.time) >= 0).all()
    if solver != "idas":  # IDAS prints notes of its own
        assert capfd.readouterr().err == ""


def test_a_failure_between_events_keeps_the_events() -> None:
    net = ia.Network(
        "failing", part=Escaping(), mass=ia.Mass(m=1.0), rub=ia.CoulombFriction(f_c=1.0), wall=ia.Fixed()
    )
    net.connect(net.part.flange, net.mass.flange, net.rub.flange_b).connect(net.rub.flange_a, net.wall.flange)
    with pytest.raises(ia.SimulationError) as caught:
        net.simulate(3.0, **TIGHT)
    kept = caught.value.result
    assert isinstance(kept, ia.Result)
    assert [event.time for event in kept.events] == pytest.approx([1.0], abs=1e-6)


def fading(h: float) -> ia.Component:
    class Relay(ia.Compliant):
        f_0 = ia.parameter("N", "force against the motion", default=1.0)
        v_rel = ia.variable("m/s", "relative velocity")
        mode = ia.mode("forward", "backward")

        def equations(self) -> Any:
            yield self.v_rel == ia.der(self.s_rel)
            yield self.f == self.mode.choose(forward=self.f_0, backward=-self.f_0)

        def transitions(self) -> Any:
            yield self.mode.goes("forward", "backward", when=self.v_rel < -h)
            yield self.mode.goes("backward", "forward", when=self.v_rel > h)

    return Relay()


@pytest.mark.parametrize(
    ("h", "told"),
    [
        (0.0, "no consistent set of modes at t = 1 s; these switch for ever: Relay 'element'"),
        (1e-12, "chattering: 200 events"),
    ],
)
@pytest.mark.parametrize("solver", ["auto", "compiled"])
def test_switching_without_end_is_told(h: float, told: str, solver: str) -> None:
    with pytest.raises(ia.SimulationError, match=told) as caught:
        oscillator(fading(h), v=1.0).simulate(3.0, solver=solver)
    kept = caught.value.result
    assert isinstance(kept, ia.Result)
    assert kept.time[-1] == pytest.approx(1.0, abs=1e-3)


def test_fast_switching_with_hysteresis_is_no_chattering() -> None:
    run = oscillator(fading(1e-2), v=1.0).simulate(2.0)
    assert len(run.events) == pytest.approx(1.0 / 2e-2, abs=2)
    assert abs(run["mass.v"][-1]) <= 1e-2 * (1 + 1e-9)


@pytest.mark.parametrize(
    ("build", "parameters"),
    [
        (smooth, ["element.k3", "mass.m", "e0.c", "element.s_rel0"]),
        (lambda: oscillator(Implicit(k=30.0), ia.Damper(d=0.5), s=1.0), ["element.k", "e0.d"]),
        (
            lambda: oscillator(ia.Spring(k=9.0), ia.Damper(d=0.1), a=3.0, v=0.0),
            ["element.k", "mass.m", "e0.d"],
        ),
        (lambda: oscillator(ia.series(ia.Spring(k=9.0), ia.Rod(L=0.2), ia.Damper(d=1.0))), ["element.rod.L"]),
    ],
)
def test_sensitivities_against_finite_differences(
    build: Callable[[], ia.Network], parameters: list[str]
) -> None:
    dae = build().dae()
    run = ia.simulate(dae, 2.0, sensitivities=parameters, **TIGHT)
    for parameter in parameters:
        value = dae.parameter_values[parameter]
        h = 1e-3 * max(value, 0.1)
        above, below = (
            ia.simulate(dae, 2.0, parameters={parameter: value + s * h}, **TIGHT) for s in (1, -1)
        )
        for signal in ("mass.s", "mass.a", "element.f"):
            slope = (above[signal] - below[signal]) / (2 * h)
            scale = max(abs(slope).max(), 1e-3)
            assert run.sensitivity(signal, parameter) == pytest.approx(slope, abs=2e-4 * scale), (
                signal,
                parameter,
            )


def test_sensitivities_over_several_calls_and_sampled_inputs() -> None:
    t = np.linspace(-0.5, 11.0, 2301)
    net = oscillator(ia.Spring(k=10.0))
    net.add(push=ia.Force(f=ia.Sampled(t, np.sin(t)))).connect(net.push.flange, net.mass.flange)
    run = net.simulate(10.0, step=0.005, sensitivities=["element.k"], **TIGHT)
    assert len(run.time) == 2001
    w, x = np.sqrt(10.0), run.time
    exact = -(np.sin(x) - np.sin(w * x) / w) / 81 + (np.sin(w * x) / w**3 - x * np.cos(w * x) / w**2) / 18
    assert run.sensitivity("mass.s", "element.k") == pytest.approx(exact, abs=1e-6)


def test_sensitivities_that_cannot_be_had() -> None:
    with pytest.raises(
        ia.ModelError, match=r"there is no parameter 'element.kk'; did you mean 'element.k'\?"
    ):
        oscillator(ia.Spring(k=1.0)).simulate(1.0, sensitivities=["element.kk"])
    with pytest.raises(KeyError, match=r"run again with sensitivities=\['mass.m'\]"):
        oscillator(ia.Spring(k=1.0)).simulate(1.0, sensitivities=["element.k"]).sensitivity(
            "mass.s", "mass.m"
        )


def test_changed_parameters_are_a_rebuilt_network() -> None:
    dae = smooth().dae()
    changed = ia.simulate(dae, 2.0, parameters={"element.k": 20.0, "mass.m": 3.0})
    net = oscillator(ia.CubicSpring(k=20.0, k3=3.0), ia.QuadraticDamper(c=0.3), s=0.3)
    net = net.with_values(mass=ia.Mass(m=3.0, s=0.3))
    net.add(push=ia.Force(f=lambda t: ca.sin(3 * t))).connect(net.push.flange, net.mass.flange)
    assert changed["mass.s"] == pytest.approx(net.simulate(2.0)["mass.s"], abs=1e-12)
    assert dae.parameter_values["element.k"] == 10.0
    again = ia.simulate(dae, 2.0)
    assert again["mass.s"] == pytest.approx(smooth().simulate(2.0)["mass.s"], abs=1e-12)


def test_reading_a_result() -> None:
    run = oscillator(ia.Spring(k=100.0), s=0.1).simulate(1.0, step=0.25)
    assert run.time == pytest.approx([0.0, 0.25, 0.5, 0.75, 1.0])
    s = run["mass.s"]
    assert run.at("mass.s", 0.125) == pytest.approx(0.1 * np.cos(1.25), rel=1e-4)
    assert (run.at("mass.s", 0.0), run.at("mass.s", 1.0)) == (s[0], s[-1])
    with pytest.raises(ValueError, match=r"t = 1\.5 s is outside the run, 0 to 1 s"):
        run.at("mass.s", 1.5)
    table = run.to_dataframe("mass.s", "element.f")
    assert list(table.columns) == ["mass.s", "element.f"]
    assert table.index.name == "time"
    assert table.attrs["units"] == {"mass.s": "m", "element.f": "N"}
    assert list(run.to_dataframe().columns) == run.dae.state_names
    assert run["der(mass.v)"] == pytest.approx(run["mass.a"])
    assert (run.unit("mass.m"), run.unit("der(mass.s)"), run.unit("time")) == ("kg", "m/s", "s")
    assert "mass.s" in run
    assert "mass.x" not in run
    with pytest.raises(KeyError, match=r"has no variable 'mass.x'; did you mean 'mass.v'\?"):
        _ = run["mass.x"]


def test_at_an_event_two_points_share_one_time() -> None:
    net = oscillator(ia.CoulombFriction(f_c=5.0))
    net.add(push=ia.Force(f=lambda t: 10 * t)).connect(net.push.flange, net.mass.flange)
    for step in (0.1, 0.3):
        run = net.simulate(0.9, step=step)
        (at,) = [event.time for event in run.events]
        assert at == pytest.approx(0.5)
        assert np.count_nonzero(run.time == at) == 2
        assert run["element.mode"][run.time == at].tolist() == [0.0, 1.0]
        assert run.at("element.mode", at) == 1.0
        assert run.stats["events by component"] == {"CoulombFriction 'element'": 1}


def test_a_run_may_begin_anywhere() -> None:
    early = smooth().simulate(
        3.0, begin=0.0, start={"mass.s": 0.0}, inputs={"push.f": lambda t: ca.sin(t)}, **TIGHT
    )
    late = smooth().simulate(
        103.0, begin=100.0, start={"mass.s": 0.0}, inputs={"push.f": lambda t: ca.sin(t - 100)}, **TIGHT
    )
    assert late.time - 100 == pytest.approx(early.time)
    assert late["mass.s"] == pytest.approx(early["mass.s"], abs=1e-8)


def test_inputs_as_number_function_data_and_pair() -> None:
    t = np.linspace(-0.1, 1.1, 1201)
    net = oscillator(ia.Spring(k=10.0)).add(push=ia.Force())
    net.connect(net.push.flange, net.mass.flange)
    runs = [
        net.simulate(1.0, inputs={"push.f": signal}, **TIGHT)
        for signal in (lambda t: np.sin(3 * t), ia.Sampled(t, np.sin(3 * t)), (t, np.sin(3 * t)))
    ]
    for run in runs[1:]:
        assert run["mass.s"] == pytest.approx(runs[0]["mass.s"], abs=1e-8)
    steady = net.simulate(1.0, inputs={"push.f": 10}, **TIGHT)
    assert steady["mass.s"] == pytest.approx(1 - np.cos(np.sqrt(10) * steady.time), abs=1e-7)


class Edge(ia.Compliant):
    """A force that exists beyond 0.05 m only."""

    def equations(self) -> Any:
        yield self.f == ca.sqrt(self.s_rel - 0.05)


def stopped_before_the_edge(s_min: float) -> ia.Network:
    net = ia.Network(
        "edge",
        wall=ia.Fixed(),
        edge=Edge(),
        mass=ia.Mass(m=1.0, s=1.0, v=-1.0),
        stop=ia.HardStop(s_min=s_min, e=0.8),
    )
    net.connect(net.wall.flange, net.edge.flange_a, net.stop.flange_a)
    return net.connect(net.edge.flange_b, net.stop.flange_b, net.mass.flange)


def test_equations_that_end_beyond_an_event_do_not_end_the_run() -> None:
    """A stretch of the integrator goes on past the stop, to where the force does not exist."""
    run = stopped_before_the_edge(0.1).simulate(5.0, step=1.0, **TIGHT)
    assert run["mass.s"].min() == pytest.approx(0.1, abs=1e-9)
    first = run.events[0]
    speed = np.sqrt(1 + 4 / 3 * (0.95**1.5 - 0.05**1.5))
    assert first.impulse == pytest.approx(1.8 * speed, rel=1e-7)


def test_equations_that_end_without_an_event_end_the_run_there() -> None:
    with pytest.raises(ia.SimulationError, match=r"t = 0\.734") as caught:
        stopped_before_the_edge(-1.0).simulate(5.0, step=1.0)
    kept = caught.value.result
    assert isinstance(kept, ia.Result)
    assert kept["mass.s"][-1] == pytest.approx(0.05, abs=1e-4)


@pytest.mark.parametrize("solver", SOLVERS)
def test_progress_advances_within_one_call_of_the_integrator(
    solver: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    told: list[float] = []
    monkeypatch.setattr("inertance.networks.simulation.progress.REFRESH_PERIOD", 0.005)
    monkeypatch.setattr("inertance.networks.simulation.progress.Progress.at", lambda _, t: told.append(t))
    net = smooth()
    run = net.simulate(100.0, step=0.1, progress=True, solver=solver, **TIGHT)
    assert run.stats["integrator calls"] == 1
    assert told == sorted(told)
    assert told[-1] == 100.0
    assert sum(0.0 < t < 100.0 for t in told) >= 2
    quiet = net.simulate(100.0, step=0.1, solver=solver, **TIGHT)
    assert (run["mass.s"] == quiet["mass.s"]).all()


@pytest.mark.parametrize(("asked", "share"), [(1e-6, 0.01), (1e-9, 0.1), (1e-11, 1.0)])
def test_multistep_methods_are_not_asked_for_less_than_rounding_lets(asked: float, share: float) -> None:
    kept = Tolerance(asked, 1e-2 * asked).between_events()
    assert (kept.rtol, kept.atol) == pytest.approx((share * asked, 1e-2 * share * asked))
