"""Every public function, method and component is given what it cannot use, argument by argument.

It must say so by an `InertanceError`, or work: errors from inside NumPy, SciPy, CasADi or Python itself,
hanging, and NaN without a word are defects. What is public is looked up, so that a new function is tried by
itself; its arguments need a good value in `GOOD`, by their names.
"""

from __future__ import annotations

import dataclasses
import inspect
import math
import signal
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
import pandas  # noqa: F401
import pytest
import scipy.signal  # noqa: F401
from inertance.analysis import (
    Campbell,
    Norm,
    Orbit,
    OrderSpectrum,
    PowerSpectrum,
    ResponseCurve,
    Scatter,
    Spectrogram,
    StateSpace,
    SteppedSine,
    Tuning,
)
from inertance.components.language import Field, Option, Parameter, RealInput, Variable
from inertance.identification import Campaign, Chirp, Filter, Multisine, Record, SineDwells
from inertance.machines import (
    BallScrewInerter,
    InterconnectedStruts,
    PlanetaryGeometry,
    RandomDisplacement,
    Sinusoid,
)
from inertance.sweeps import Design, Sweep
from inertance.synthesis import RationalFunction

SECONDS = 60
BAD: dict[str, Callable[[], Any]] = {
    "None": lambda: None,
    "text": lambda: "x",
    "empty text": lambda: "",
    "0": lambda: 0,
    "-1": lambda: -1,
    "True": lambda: True,
    "nan": lambda: math.nan,
    "inf": lambda: math.inf,
    "1e308": lambda: 1e308,
    "beyond floats": lambda: 10**400,
    "complex": lambda: 1j,
    "empty list": list,
    "list of numbers": lambda: [1.0, math.nan],
    "list of texts": lambda: ["x", "y"],
    "array": lambda: np.zeros((2, 2)),
    "array of texts": lambda: np.array(["x"]),
    "dict": lambda: {"x": None},
    "dict of a number": lambda: {3: "x"},
    "set": lambda: {1.0},
    "generator": lambda: (x for x in [1.0]),
    "object": object,
    "function": lambda: len,
    "class": lambda: int,
    "bytes": lambda: b"x",
}
NUMBERS = {"0", "-1", "1e308", "inf"}
TEXTS = {"text", "empty text"}
REFUSED = {
    "float": set(BAD) - NUMBERS,
    "int": set(BAD) - NUMBERS | {"inf", "1e308"},
    "str": set(BAD) - TEXTS,
    "Network": set(BAD),
    "DAE": set(BAD),
    "StateSpace": set(BAD),
    "Component": set(BAD),
}
"""What a plain annotation does not allow, whatever the function."""


def oscillator() -> ia.Network:
    net = ia.Network("oscillator", wall=ia.Fixed(), spring=ia.Spring(k=100.0), damper=ia.Damper(d=1.0))
    net.add(mass=ia.Mass(m=1.0), push=ia.Force())
    net.connect(net.wall.flange, net.spring.flange_a, net.damper.flange_a)
    return net.connect(net.spring.flange_b, net.damper.flange_b, net.mass.flange, net.push.flange)


@cache
def dae() -> ia.DAE:
    return oscillator().dae()


@cache
def run() -> ia.Result:
    return ia.simulate(dae(), 0.1, inputs={"push.f": 1.0}, step=0.01, sensitivities=["spring.k"])


@cache
def linear() -> StateSpace:
    return ia.analysis.linearise(dae(), ["push.f"], ["mass.s"])


@cache
def car() -> ia.DAE:
    return ia.machines.quarter_car(strut()).dae()


@cache
def frame() -> ia.DAE:
    return ia.machines.shear_frame([1.0, 1.0], [10.0, 10.0]).dae()


def strut() -> Any:
    return ia.machines.suspension("S1", k=1e4, d=1e3)


@cache
def orbit() -> Orbit:
    return ia.analysis.harmonic_orbit(dae(), "push.f", 1.0, 1.0, ["mass.s"], harmonics=3)


@cache
def record() -> Record:
    t = np.linspace(0.0, 1.0, 101)
    return Record("record", t, {"F": np.sin(9 * t), "x": 1e-3 * np.cos(9 * t)})


@cache
def campaign() -> Campaign:
    return Campaign(
        oscillator(),
        channels={"F": {"input": "push.f", "unit": "N"}, "x": {"output": "mass.s", "unit": "m"}},
        parameters={"spring.k": {"rel": 0.2}},
        train=[{"record": record()}],
    )


@cache
def swept() -> Sweep:
    return ia.sweeps.sweep(oscillator(), {"spring.k": [1.0, 2.0]}, lambda d, v: v["spring.k"], workers=0)


@cache
def stepped() -> SteppedSine:
    return ia.analysis.stepped_sine(oscillator(), "push.f", 1.0, [1.0], ["mass.s"], most=4)


@cache
def shaft() -> ia.DAE:
    net: Any = ia.Network("shaft", rotor=ia.rotational.Inertia(J=1.0), end=ia.rotational.Fixed())
    net.add(shaft=ia.rotational.Spring(c=100.0))
    net.connect(net.rotor.flange, net.shaft.flange_a).connect(net.shaft.flange_b, net.end.flange)
    built: ia.Network = net
    return built.dae()


@cache
def turning() -> ia.Result:
    return ia.Network("coasting", rotor=ia.rotational.Inertia(J=1.0, w=60.0)).simulate(0.5)


def stepwise() -> ia.Stepwise:
    return ia.Stepwise(dae(), 0.0, 1.0, {}, {"push.f": [0.0]})


def line() -> RationalFunction:
    return RationalFunction([1.0], [1.0, 1.0])


def inerter() -> BallScrewInerter:
    return BallScrewInerter(screw=ia.NutScrew(lead=0.01), flywheel=ia.DiskFlywheel(m=0.78, R=0.05))


GOOD: dict[str, Callable[[], Any]] = {
    "network": dae, "dae": dae, "car": car, "frame": frame, "system": linear, "model": oscillator,
    "admittance": line, "impedance": line, "inerter": inerter,
    "strut": strut, "front": strut, "rear": strut, "mount": strut, "seat": strut, "element": strut,
    "elements": strut, "campaign": campaign, "done": swept, "result": run, "after": linear, "effect": object,
    "inputs": lambda: ["push.f"], "outputs": lambda: ["mass.s"], "signals": lambda: ["mass.s"],
    "parameters": lambda: ["spring.k"], "driven": lambda: "push.f", "output": lambda: "mass.s",
    "name": lambda: "mass.s", "parameter": lambda: "spring.k", "path": lambda: "mass.s",
    "start": lambda: {"mass.v": 1.0}, "stop": lambda: 0.1, "begin": lambda: 0.0, "time": lambda: 0.05,
    "amplitude": lambda: 1.0, "frequency": lambda: 1.0, "frequencies": lambda: [1.0], "f": lambda: [1.0],
    "band": lambda: (0.5, 1.0), "harmonic": lambda: 1, "n": lambda: [0.1], "s": lambda: 1j, "t": lambda: 0.1,
    "m": lambda: 1.0, "k": lambda: 1e4, "d": lambda: 1e3, "b": lambda: 10.0, "mu": lambda: 0.1,
    "beta": lambda: 0.1, "L": lambda: 10.0, "T": lambda: 100.0, "m_s": lambda: 250.0, "m_u": lambda: 35.0,
    "k_t": lambda: 1e5, "J": lambda: 0.1, "R": lambda: 0.1, "N": lambda: 4.0, "lam": lambda: 0.5,
    "J_s": lambda: 0.1, "J_p": lambda: 0.1, "J_r": lambda: 0.1, "J_e": lambda: 0.1, "lead": lambda: 0.01,
    "tau": lambda: 0.1, "inertia": lambda: 1.0, "w": lambda: 1.0, "layout": lambda: "S1",
    "road_class": lambda: "C", "speed": lambda: 20.0, "duration": lambda: 10.0, "height": lambda: 0.1,
    "length": lambda: 1.0, "low": lambda: 0.5, "high": lambda: 2.0, "input_psd": lambda: 1.0,
    "component": lambda: ia.Damper(d=1.0), "fixed": lambda: "ground", "moving": lambda: "mass.flange",
    "flanges": lambda: {"mass.flange": "force-in"}, "count": lambda: 4, "step": lambda: 0.01,
    "read_model.port": dict, "read_model.base": Path,
    "values": lambda: {"spring.k": [1.0, 2.0]}, "ranges": lambda: {"spring.k": (1.0, 2.0)},
    "rate": lambda: 50.0,
    "measure": lambda: lambda dae, *, parameters: parameters.get("spring.k", 1.0),
    "first": lambda: lambda dae, *, parameters: parameters.get("spring.k", 1.0),
    "second": lambda: lambda dae, *, parameters: 1.0 / parameters.get("spring.k", 1.0),
    "bounds": lambda: {"spring.k": (50.0, 200.0)}, "spread": lambda: {"spring.k": 0.1}, "share": lambda: 0.5,
    "modes": lambda: linear().modes(), "signal": lambda: np.sin, "displacement": lambda: lambda t: 0.01 * t,
    "displacements": lambda: [RandomDisplacement(1, 1.0)], "acceleration": lambda: np.zeros(8),
    "rms": lambda: 1.0, "cutoff": lambda: 10.0, "seed": lambda: 1, "factor": lambda: 2.0, "every": lambda: 2,
    "channel": lambda: "x", "channels": lambda: campaign().measured, "end": lambda: 1.0, "stage": lambda: (),
    "amplitudes": lambda: (1.0,), "names": lambda: ("spring.k",), "points": lambda: ((1.0,),),
    "num": lambda: [1.0], "den": lambda: [1.0, 1.0], "A": lambda: -np.eye(1), "B": lambda: np.eye(1),
    "C": lambda: np.eye(1), "D": lambda: np.eye(1), "degree": lambda: 1, "courses": lambda: {"push.f": [0.0]},
    "wanted": lambda: [("mass.s", 0)], "changes": dict, "at": lambda: [0.0], "port": lambda: {},
    "train": list,
    "ports": lambda: oscillator().mass.flange, "components": ia.Fixed, "value": lambda: 1.0, "shape": dict,
    "given": line, "communication_step": lambda: 0.01, "unit": lambda: "m", "doc": lambda: "what it is",
    "default": lambda: 1.0, "variable": lambda: 1.0, "pole": lambda: -1.0, "record": record,
    "source": lambda: "a",
    "impulse": lambda: 1.0, "velocity": lambda: 1.0, "holds": lambda: True, "least": lambda: 1.0,
    "clutch": lambda: ia.rotational.Clutch(fn_max=1.0, f_normalized=1.0),
    "struts": lambda: InterconnectedStruts(A_b=2e-4, A_r=1e-4, p_0=1e6, V_0=1e-4, R=0.0),
    # of one function
    "campbell.network": shaft, "campbell.speed": lambda: "rotor.w", "campbell.speeds": lambda: [1.0, 2.0],
    "power_spectrum.run": run, "power_spectrum.window": lambda: 0.09, "power_spectrum.rate": lambda: 100.0,
    "Result.compare.other": run, "Result.plot_phase.x": lambda: "mass.s",
    "Result.plot_phase.y": lambda: "mass.v",
    "spectrogram.run": run, "spectrogram.window": lambda: 0.09, "order_tracking.run": turning,
    "order_tracking.name": lambda: "rotor.phi", "order_tracking.shaft": lambda: "rotor.phi",
    "Campbell.crossings.order": lambda: 1.0, "OrderSpectrum.track.order": lambda: 1.0,
    "diagnose.campaign": lambda: "none.toml", "design.campaign": lambda: "none.toml",
    "fit.campaign": lambda: "none.toml",
    "linearise.inputs": lambda: ["push.f"], "sweep.parameters": lambda: {"spring.k": [1.0, 2.0]},
    "sweep.measure": lambda: lambda dae, values: values["spring.k"], "sobol_indices.measure": lambda: "value",
    "Network.name": lambda: "net", "Sampled.time": lambda: np.arange(8.0),
    "Sampled.values": lambda: np.arange(8.0),
    "weighted_rms.run": lambda: np.arange(8.0) * 0.01,
    "Record.name": lambda: "record",
    "Record.time": lambda: np.arange(64.0), "Record.values": lambda: {"F": np.arange(64.0)},
    "shear_frame.m": lambda: [1.0], "shear_frame.k": lambda: [1.0], "shear_frame.d": lambda: [1.0],
    "pareto_front.first": lambda: lambda dae, *, parameters: parameters["spring.k"],
    "read_record.path": lambda: "none.csv", "load_signal.path": lambda: "none.csv",
    "load_table.path": lambda: "none.csv",
    "load_points.path": lambda: "none.csv", "load_points.columns": lambda: {"x": "m"},
    "read_ssp.path": lambda: "none.ssp", "FMU.path": lambda: "none.fmu",
    "Result.save.path": lambda: "none.txt",
    "export_fmu.path": lambda: "none.txt", "check_fmu.model": lambda: "none.fmu",
    "Campaign.load.path": lambda: "none.toml", "split.first": lambda: ["mass"],
    "split.network": oscillator, "stepped_sine.network": oscillator, "impedance.network": strut,
    "admittance.network": strut, "Stepwise.inputs": dict, "SineDwells.frequencies": lambda: (1.0,),
    "Varied.parameters": lambda: {"spring.k": 1.0}, "Campaign.model": oscillator,
    "Campaign.parameters": dict, "Campaign.channels": dict,
    "StateSpace.from_ss.system": lambda: linear().to_scipy(),
    "DAE.root.path": lambda: "mass.s", "DAE.field.path": lambda: "spring.k", "DAE.closed.signals": dict,
    "Network.connect.ports": lambda: oscillator().mass.flange,
    "Network.insert.port": lambda: oscillator().mass.flange,
    "Orbit.over_period.output": lambda: "mass.s", "Variations.start_slopes.start": lambda: {"mass.s": 0.0},
    "Variations.adjoint.weights": lambda: np.ones((len(run().time), 1)),
    "Variations.adjoint.name": lambda: "push.f",
    "Variations.pushed.changes": dict, "RationalFunction.of.given": line,
    "SystemStructure.name": lambda: "system",
    "SystemStructure.components": dict, "Connection.start": lambda: "a.x", "Connection.end": lambda: "b.x",
    "Design.names": lambda: ("spring.k",), "PlanetaryGeometry.beta": lambda: 0.3, "bump.begin": lambda: 0.0,
    "response_rms.system": linear, "Record.window.begin": lambda: 0.0, "sampled.stop": lambda: 1.0,
    "Polynomial.along.course": lambda: np.zeros(3), "Filter.apply.values": lambda: np.zeros(100),
    "describing_function.element": lambda: ia.Spring(k=1.0), "option.default": lambda: 1,
    "Experiment.initial": lambda: "fit",
    "inerter_rig.displacement": lambda: np.sin, "mode.values": lambda: "a", "Chirp.__call__.t": lambda: 0.1,
}  # fmt: skip

MODULES = ("analysis", "diagnosis", "fmu", "identification", "machines", "sweeps", "synthesis")
CONSTRUCTED = {
    ia.Network, ia.Sampled, Record, Design, ia.Polynomial, ia.Stepwise, ia.Variations, StateSpace,
    RationalFunction, PlanetaryGeometry, RandomDisplacement, Sinusoid, Campaign, Chirp,
    Multisine, SineDwells, Filter, ia.FMU,
}  # fmt: skip
INSTANCES: dict[type, Callable[[], Any]] = {
    ia.Network: oscillator, ia.DAE: dae, ia.Result: run, StateSpace: linear, Record: record,
    Campaign: campaign, Orbit: orbit, ResponseCurve: lambda: ResponseCurve([orbit()]),
    SteppedSine: stepped, ia.Stepwise: stepwise, RationalFunction: line,
    Scatter: lambda: Scatter(1.0, np.array([1.0, 2.0])), Tuning: lambda: Tuning(1.0, 0.1),
    ia.Variations: lambda: ia.Variations(dae(), ["mass.s"], ["spring.k"]), Norm: lambda: linear().h2(),
    Filter: lambda: Filter(10.0), Campbell: lambda: ia.analysis.campbell(shaft(), "rotor.w", [1.0, 20.0]),
    PowerSpectrum: lambda: ia.analysis.power_spectrum(run(), "mass.s", 0.09, rate=100.0),
    Spectrogram: lambda: ia.analysis.spectrogram(run(), "mass.s", 0.09),
    OrderSpectrum: lambda: ia.analysis.order_tracking(turning(), "rotor.phi", "rotor.phi", turns=2.0),
}  # fmt: skip
OTHERS = {
    # made by the library alone, or without methods that take anything
    "CheckReport", "Connection", "CoupledRun", "Event", "Experiment", "FMUBlock", "Finding", "Fit",
    "NoiseFloor",
    "ForeignEvent", "ForeignRun", "Mode", "OperatingPoint", "PositiveReal", "Prediction", "Shock", "Split",
    "Sweep", "SystemRun", "SystemStructure", "Tuned", "Verdict", "Channel", "Varied", "write_report",
    # what a declaration of a component takes is tried where components are
    "BooleanInput", "BooleanOutput", "IntegerOutput",
    "RealInput", "RealOutput", "RotationalFlange", "TranslationalFlange", "der", "derived", "dissipation",
    "energy", "impulse", "mode", "option", "parameter", "supply", "variable",
}  # fmt: skip


def faces() -> dict[str, Any]:
    """Return what the package and its modules show, by name."""
    shown = {name: getattr(ia, name) for name in dir(ia)}
    for module in map(shown.__getitem__, MODULES):
        shown |= {name: getattr(module, name) for name in getattr(module, "__all__", dir(module))}
    return shown


def public() -> Iterator[tuple[str, Callable[..., Any]]]:
    """Yield every public function, constructor and method with its name."""
    for name, found in faces().items():
        if name in OTHERS or inspect.ismodule(found) or not callable(found):
            continue
        if not inspect.isclass(found):
            if getattr(found, "__module__", "").startswith("inertance"):
                yield name, found
        elif found in CONSTRUCTED:
            yield name, found
        if inspect.isclass(found) and found in INSTANCES:
            fields = getattr(found, "__dataclass_fields__", ())
            for method, function in inspect.getmembers(found):
                if method in fields:
                    continue
                taken = not method.startswith("_") or method in ("__call__", "__getitem__", "__contains__")
                if taken and (inspect.isfunction(function) or inspect.ismethod(function)):
                    yield f"{name}.{method}", function


def call(name: str, function: Callable[..., Any], changed: str, value: Any) -> Any:
    """Call a function with good values for what it needs and another for one argument."""
    arguments, more, owner = {}, [], name.rpartition(".")[0]
    taken = inspect.signature(function).parameters
    instance = []
    for parameter in taken.values():
        if parameter.name == "self":
            instance = [next(make() for kind, make in INSTANCES.items() if kind.__name__ == owner)]
            continue
        good = value if parameter.name == changed else None
        if parameter.name != changed:
            if parameter.default is not parameter.empty or parameter.kind is parameter.VAR_KEYWORD:
                continue
            good = good_value(name, parameter.name)
        if parameter.kind is parameter.VAR_POSITIONAL:
            more = [good]
        elif parameter.kind is parameter.POSITIONAL_ONLY:
            instance.append(good)
        else:
            arguments[parameter.name] = good
    if more:
        return function(*instance, *arguments.values(), *more)
    return function(*instance, **arguments)


def good_value(name: str, parameter: str) -> Any:
    key = f"{name}.{parameter}"
    if key not in GOOD and parameter not in GOOD:
        raise LookupError(f"give a good value of '{key}' in GOOD")
    return GOOD.get(key, GOOD.get(parameter))()  # type: ignore[misc]


CASES = [
    (name, function, parameter)
    for name, function in public()
    for parameter in inspect.signature(function).parameters.values()
    if parameter.name != "self" and parameter.kind is not parameter.VAR_KEYWORD
]


def must_be_refused(name: str, annotation: Any) -> set[str]:
    if name.endswith("__contains__"):
        return set()
    kinds = {kind.strip().split(".")[-1] for kind in str(annotation).split("|")}
    if not kinds - {"None"} or not kinds - {"None"} <= set(REFUSED):
        return set()
    refused = set.intersection(*(REFUSED[kind] for kind in kinds - {"None"}))
    return refused - {"None"} if "None" in kinds else refused


def not_finite(value: Any) -> bool:
    """Return whether NaN stands somewhere in a result."""
    if isinstance(value, float | complex | np.floating):
        return bool(np.isnan(value))
    if isinstance(value, np.ndarray):
        return bool(np.issubdtype(value.dtype, np.number) and np.isnan(value).any())
    if isinstance(value, dict):
        return any(map(not_finite, value.values()))
    if isinstance(value, list | tuple):
        return any(map(not_finite, value))
    if dataclasses.is_dataclass(value) and type(value).__name__ in ("Tuned", "Scatter", "Tuning"):
        return any(not_finite(getattr(value, f.name)) for f in dataclasses.fields(value))
    return False


def assemble(result: ia.Component) -> None:
    """Let a component tell what is wrong with its values, which it does when it is assembled."""
    network = result if isinstance(result, ia.Network) else ia.Network("holds it", part=result)
    try:
        network.dae()
    except ia.ModelError as error:
        others = [problem for problem in error.problems if "is not connected" not in problem]
        if others:
            raise


class TookTooLong(BaseException):
    pass


def too_long(*_: Any) -> None:
    raise TookTooLong


def outcome(name: str, function: Callable[..., Any], parameter: inspect.Parameter, kind: str) -> str:
    """Say what is wrong with what comes of a bad value, empty if nothing is."""
    signal.signal(signal.SIGALRM, too_long)
    signal.alarm(SECONDS)
    try:
        result = call(name, function, parameter.name, BAD[kind]())
        if inspect.isgenerator(result):
            result = list(result)
        if isinstance(result, ia.Component):
            assemble(result)
    except ia.InertanceError as error:
        return "" if str(error) else "an error without words"
    except TookTooLong:
        return f"goes on for over {SECONDS} s"
    except Exception as error:
        return f"{type(error).__name__}: {str(error)[:120]}"
    finally:
        signal.alarm(0)
    if kind in must_be_refused(name, parameter.annotation):
        return f"taken for {parameter.annotation}"
    return "NaN without a word" if not_finite(result) else ""


@pytest.mark.parametrize(
    ("name", "function", "parameter"), CASES, ids=[f"{name}-{p.name}" for name, _, p in CASES]
)
def test_a_bad_argument_is_refused(
    name: str,
    function: Callable[..., Any],
    parameter: inspect.Parameter,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    told = {kind: outcome(name, function, parameter, kind) for kind in BAD}
    assert {kind: wrong for kind, wrong in told.items() if wrong} == {}


def elements() -> Iterator[tuple[str, type[ia.Component], Field]]:
    """Yield every parameter, option, input and start value of every component."""
    for room in (ia, ia.machines, ia.rotational, ia.signals):
        for name in dir(room):
            kind = getattr(room, name)
            if not (inspect.isclass(kind) and issubclass(kind, ia.Component)):
                continue
            if kind.__init__ is not ia.Component.__init__:
                continue
            for field in kind.fields.values():
                if isinstance(field, Parameter | Option | RealInput | Variable):
                    yield f"{room.__name__}.{name}", kind, field


@pytest.mark.parametrize(
    ("kind", "field"),
    [(kind, field) for _, kind, field in elements()],
    ids=[f"{name}-{field.name}" for name, _, field in elements()],
)
def test_a_bad_value_of_a_component_is_told(kind: type[ia.Component], field: Field) -> None:
    wrong = {}
    for told, bad in BAD.items():
        try:
            problems = "; ".join(kind(**{field.name: bad()}).problems())
        except ia.InertanceError as error:
            problems = f"{field.name}: {error}"
        except Exception as error:
            wrong[told] = f"{type(error).__name__}: {error}"
            continue
        called = told in ("function", "class") and isinstance(field, Parameter | RealInput)
        number = told in NUMBERS - {"inf"}
        if not (called or number or isinstance(field, Option)) and field.name not in problems:
            wrong[told] = "taken"
    assert wrong == {}
