"""What is asked wrongly, and what a user's own code does wrong, is told by thing, value, unit and remedy."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import casadi as ca
import inertance as ia
import numpy as np
import pytest
from inertance import rotational
from inertance.analysis import admittance, body_positions, linearise, load_signal, pareto_front, scatter, tune
from inertance.cli import app
from inertance.identification import Campaign, Channel, Record, read_record
from inertance.machines import PitchingBody
from inertance.sweeps import saltelli, sweep
from typer.testing import CliRunner


def oscillator() -> ia.Network:
    net = ia.Network("osc", wall=ia.Fixed(), spring=ia.Spring(k=100.0), mass=ia.Mass(m=1.0), push=ia.Force())
    net.connect(net.wall.flange, net.spring.flange_a)
    return net.connect(net.spring.flange_b, net.mass.flange, net.push.flange)


def run(**options: Any) -> ia.Result:
    given: dict[str, Any] = {"stop": 1.0, "inputs": {"push.f": 1.0}} | options
    return oscillator().simulate(**given)


def floating() -> ia.Network:
    net = ia.Network("floating", mass=ia.Mass(m=1.0), push=ia.Force())
    return net.connect(net.mass.flange, net.push.flange)


def broken(t: Any) -> Any:
    raise RuntimeError("no data sheet")


@pytest.mark.parametrize(
    ("go", "kind", "told"),
    [
        (lambda: ia.fit("camapign.toml"), ia.MissingFileError, "there is no file 'camapign.toml'"),
        (lambda: ia.diagnose("x"), ia.MissingFileError, "there is no file 'x'"),
        (lambda: ia.diagnose(3), ia.ModelError, "a Campaign or the path of its TOML file is needed, got 3"),  # type: ignore[arg-type]
        (lambda: linearise(None), ia.ModelError, "a Network (or the DAE of one) is needed, got None"),  # type: ignore[arg-type]
        (lambda: linearise(oscillator), ia.ModelError, "call the function that makes it"),  # type: ignore[arg-type]
        (lambda: admittance(None), ia.ModelError, "a component is needed, got None"),  # type: ignore[arg-type]
        (lambda: admittance(ia.Spring), ia.ModelError, "give one, Spring(...), and not its class"),  # type: ignore[arg-type]
        (lambda: run()[0], ia.UnknownNameError, "by full names, such as 'mass.s', got 0"),  # type: ignore[index]
        (lambda: run()["mass.x"], ia.UnknownNameError, "no variable 'mass.x'; did you mean"),
        (lambda: oscillator().sprng, ia.UnknownPartError, "has no 'sprng'; did you mean 'spring'?"),
        (lambda: run(stepp=0.1), ia.ModelError, "no argument 'stepp'; did you mean 'step'?"),
        (lambda: oscillator().simulate(1.0, stepp=0.1), ia.ModelError, "did you mean 'step'?"),  # type: ignore[arg-type]
        (lambda: pareto_front(oscillator(), abs, abs, {}, stars=1), ia.ModelError, "did you mean 'starts'?"),  # type: ignore[arg-type]
        (lambda: run(rtol=1e-20), ia.ModelError, "rtol must be from 1e-14 to 0.1, got 1e-20"),
        (lambda: run(rtol=10), ia.ModelError, "rtol must be from 1e-14 to 0.1, got 10"),
        (lambda: run(step=1e-12), ia.ModelError, "asks for 1e+12 outputs of 1 s, more than 2e+07"),
        (lambda: run(inputs={"push.f": broken}), ia.ModelError, "read (RuntimeError: no data sheet)"),
        (lambda: run(inputs={"push.f": math.sin}), ia.ModelError, "write ca.sin or np.sin"),
        (lambda: run(inputs={"push.f": lambda t: min(1, math.exp(t))}), ia.ModelError, "write ca.sin"),
        (lambda: run(inputs={"push.f": lambda t: math.nan}), ia.ModelError, "a finite number, got nan"),
        (lambda: run(start={"mass.m": 2.0}), ia.ModelError, "is a parameter of 'osc', no variable;"),
        (lambda: run().to_dataframe("body.*"), ia.UnknownNameError, "no variable like 'body.*'"),
        (lambda: run().at("mass.s", 3.0), ia.ModelError, "t = 3 s is outside the run"),
        (lambda: oscillator().connect(), ia.ModelError, "connect() joins ports such as"),
        (lambda: linearise(floating(), "push.f", "mass.s").response(0), ia.ModelError, "(0 Hz) is a pole"),
        (lambda: ia.load_table("none.csv"), ia.MissingFileError, "there is no file 'none.csv'"),
        (lambda: saltelli({"x": (0.0, 1.0)}, 2.5), ia.ModelError, "a whole number of them, got count=2.5"),  # type: ignore[arg-type]
    ],
)  # fmt: skip
def test_what_is_asked_wrongly_is_told(go: Callable[[], object], kind: type[Exception], told: str) -> None:
    with pytest.raises(kind) as caught:
        go()
    assert isinstance(caught.value, ia.InertanceError)
    assert told in str(caught.value)


def test_unknown_names_are_also_what_python_calls_them() -> None:
    with pytest.raises(KeyError):
        run()["mass.x"]
    assert not hasattr(oscillator(), "sprng")
    with pytest.raises(FileNotFoundError):
        ia.load_table("none.csv")


def test_patterns_choose_the_columns_of_a_table() -> None:
    table = run().to_dataframe("mass.*", "spring.f")
    of_mass = ["mass.flange.s", "mass.flange.f", "mass.s", "mass.v", "mass.a", "mass.kinetic"]
    assert list(table.columns) == [*of_mass, "spring.f"]
    assert table.attrs["units"]["mass.v"] == "m/s"


@pytest.mark.parametrize("found", [None, "small", [1.0]])
def test_a_measure_that_is_no_number_is_told(found: Any) -> None:
    def size(dae: ia.DAE, /, *, parameters: Any) -> Any:
        return found

    bounds = {"spring.k": (50.0, 200.0)}
    for go in (
        lambda: tune(oscillator(), size, bounds),
        lambda: scatter(oscillator(), size, {"spring.k": 0.1}),
    ):
        with pytest.raises(ia.ModelError, match="measure 'size' must return a number, got"):
            go()


def test_an_error_of_a_measure_is_told_with_the_parameters() -> None:
    def size(dae: ia.DAE, /, *, parameters: Any) -> float:
        return 1.0 / (float(parameters["spring.k"]) - 125.0)

    with pytest.raises(ia.ModelError, match=r"measure 'size' failed at spring\.k = 125: ZeroDivisionError"):
        tune(oscillator(), size, {"spring.k": (50.0, 200.0)})


def test_a_sweep_without_any_result_is_an_error_that_keeps_the_table() -> None:
    def wrong(dae: ia.DAE, values: Any) -> float:
        raise RuntimeError(f"no spring of {values['spring.k']}")

    with pytest.raises(
        ia.SimulationError, match=r"none of the 2 points .* RuntimeError: no spring of 1"
    ) as caught:
        sweep(oscillator(), {"spring.k": [1.0, 2.0]}, wrong, workers=0)
    assert len(caught.value.result.failed) == 2  # type: ignore[attr-defined]


@pytest.mark.parametrize(
    ("time", "values", "told"),
    [
        (np.arange(10.0), {"F": np.arange(9.0)}, "'F' has 9 samples, time has 10"),
        (np.arange(10.0), {"F": np.full(10, np.nan)}, "'F' is nan at sample 0"),
        (np.arange(10.0)[::-1], {"F": np.arange(10.0)}, "time does not increase at sample 1"),
        (np.arange(10.0) ** 2, {"F": np.arange(10.0)}, "samples are not evenly spaced"),
        (np.arange(10.0), {"F": "force"}, "'F' must be a column of numbers, got 'force'"),
        (np.arange(10.0), [1.0], "values map channels to columns"),
    ],
)
def test_a_record_of_columns_that_do_not_fit_is_told(time: Any, values: Any, told: str) -> None:
    with pytest.raises(ia.ModelError) as caught:
        Record("record", time, values)
    assert told in str(caught.value)


@pytest.mark.parametrize("solver", ["auto", "compiled"])
def test_a_run_that_is_far_too_long_for_its_machine_ends_soon(solver: str) -> None:
    began = time.process_time()
    with pytest.raises(ia.SimulationError, match=r"or a shorter run than 1e\+12 s"):
        run(stop=1e12, inputs={"push.f": ca.sin}, solver=solver)
    assert time.process_time() - began < 30.0


def test_a_machine_that_comes_to_rest_may_run_for_very_long() -> None:
    net = ia.Network(
        "damped", wall=ia.Fixed(), strut=ia.SpringDamper(k=1.0, d=1.0), mass=ia.Mass(m=1.0, v=1.0)
    )
    net.connect(net.wall.flange, net.strut.flange_a).connect(net.strut.flange_b, net.mass.flange)
    assert abs(net.simulate(1e12)["mass.s"][-1]) < 1e-6


@pytest.mark.parametrize(
    ("body", "position", "speed"),
    [
        (ia.Mass(m=2.0, v=3.0), "s", "v"),
        (rotational.Inertia(J=2.0, w=3.0), "phi", "w"),
        (ia.DiskFlywheel(m=1.0, R=1.0, w=3.0), "flange.phi", "w"),
        (PitchingBody(m=1.0, J=1.0, l_f=1.0, l_r=1.0, v=3.0), "s", "v"),
    ],
)
def test_a_body_may_float_freely(body: ia.Component, position: str, speed: str) -> None:
    free = ia.Network("free", body=body).simulate(2.0)
    assert free[f"body.{position}"][-1] == pytest.approx(6.0)
    assert free[f"body.{speed}"][-1] == pytest.approx(3.0)


def test_a_free_body_beside_others_keeps_to_itself() -> None:
    net = oscillator().add(other=ia.Mass(m=1.0, v=1.0), rod=ia.Rod(L=2.0))
    net.connect(net.mass.flange, net.rod.flange_a)
    found = net.simulate(1.0, inputs={"push.f": 100.0})
    assert found["other.s"][-1] == pytest.approx(1.0)
    assert found["rod.flange_b.s"] == pytest.approx(found["mass.s"] + 2.0)
    assert found["mass.s"].max() == pytest.approx(2.0, rel=1e-3)


def test_the_free_end_of_a_spring_is_said_on_purpose() -> None:
    net = oscillator().add(probe=ia.Spring(k=1.0, s_rel0=0.5))
    net.connect(net.mass.flange, net.probe.flange_a)
    with pytest.raises(
        ia.ModelError, match=r"'probe': flange_b is not connected; .* alone if its end is free\)"
    ):
        net.dae()
    found = net.connect(net.probe.flange_b).simulate(1.0, inputs={"push.f": 1.0})
    assert found["probe.flange_b.s"] == pytest.approx(found["mass.s"] + 0.5)


def test_a_rod_alone_is_singular_and_said_to_be() -> None:
    with pytest.raises(ia.ModelError) as caught:
        ia.Network("rod", rod=ia.Rod()).dae()
    (told,) = caught.value.problems
    assert told.startswith("nothing determines where the node of rod.flange_a and of rod.flange_b is")


def test_positions_of_bodies_that_only_turn_are_refused() -> None:
    net = ia.Network(
        "shaft", wall=rotational.Fixed(), spring=rotational.Spring(c=1.0), disc=rotational.Inertia(J=1.0)
    )
    net.connect(net.wall.flange, net.spring.flange_a).connect(net.spring.flange_b, net.disc.flange)
    with pytest.raises(ia.ModelError, match=r"no mass that slides.*name its angles, disc\.phi"):
        body_positions(net)


LINES = "time,push.f\n" + "\n".join(f"{k / 10},{k % 7}" for k in range(40)) + "\n"


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le-bom"])
def test_tables_are_read_in_utf_8_and_utf_16(encoding: str, tmp_path: Path) -> None:
    path = tmp_path / "data.csv"
    text = LINES if encoding != "utf-16-le-bom" else "\ufeff" + LINES
    path.write_bytes(text.encode(encoding.removesuffix("-bom")))
    assert ia.load_table(path)["push.f"].iloc[3] == 3.0
    assert load_signal(path).values[3] == 3.0
    channel = Channel("push.f", True, "N", "N")
    assert read_record(path, {"push.f": channel}).values["push.f"][3] == 3.0


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("0.3,3\n", "0.3,n/a\n", "line 5, column 'push.f': 'n/a' is no number; correct or remove it"),
        ("0.3,3\n", "0.3\n", "line 5: 1 cells under 2 names; complete or cut the line"),
        ("0.3,3\n", "\n", "line 5: 0 cells under 2 names; complete or cut the line"),
        ("time,push.f", "push.f,push.f", "line 1: two columns are called 'push.f'; rename one"),
        ("time,push.f", "0,1", "line 1: numbers instead of names; put a line of column names on top"),
        (LINES, "", "the file is empty"),
    ],
)
def test_a_bad_table_is_told_alike_wherever_it_is_read(
    old: str, new: str, told: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("data.csv").write_text(LINES.replace(old, new))
    rig = "ia.Network('rig', push=ia.Force(), m=ia.Mass(m=1.0))"
    Path("rig.py").write_text(
        f"import inertance as ia\n\n\ndef build():\n    net = {rig}\n"
        "    return net.connect(net.push.flange, net.m.flange)\n"
    )
    channels = {"push.f": Channel("push.f", True, "N", "N")}
    messages = []
    for read in (ia.load_table, load_signal, lambda path: read_record(path, channels)):
        with pytest.raises(ia.ModelError) as caught:
            read("data.csv")
        messages.append(str(caught.value))
    ran = CliRunner().invoke(app, ["run", "rig.py:build", "--input", "data.csv"])
    assert ran.exit_code == 2
    messages.append(ran.stderr.removeprefix("error: ").strip())
    assert set(messages) == {f"data.csv{',' if told.startswith('line') else ':'} {told}"}


def test_what_is_no_text_is_told_with_its_line(tmp_path: Path) -> None:
    path = tmp_path / "data.csv"
    path.write_bytes(b"time,push.f\n0,1\n1,\xb5\n")
    for read in (ia.load_table, load_signal):
        with pytest.raises(ia.ModelError, match=r"data\.csv: not a text file in UTF-8 \(line 3, byte 0xb5"):
            read(path)


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (
            b"import sys\n\n\ndef build():\n    sys.exit(3)\n",
            "model.py, line 5: the model ends Python (sys.exit(3))",
        ),
        (b"def build():\n    return 1 / 0\n", "model.py, line 2: ZeroDivisionError"),
        (
            "def build():\n    pass\n".encode("utf-16"),
            "model.py: Python reads UTF-8, and this file is UTF-16",
        ),
        (b"def build():\n    return 3\n", "returned int"),
    ],
)
def test_what_a_model_of_the_user_does_wrong_is_told(content: bytes, told: str, tmp_path: Path) -> None:
    path = tmp_path / "model.py"
    path.write_bytes(content)
    for go in (
        lambda: sweep(f"{path}:build", {"x": [1.0]}, max, workers=0),
        lambda: Campaign(f"{path}:build", {}, {}, []),
    ):
        with pytest.raises(ia.ModelError) as caught:
            go()
        assert told in str(caught.value)


class Power(ia.Compliant):
    """f = k z |z|^(n-1), which has no slope at z = 0 as CasADi takes it."""

    k = ia.parameter("N/m", "stiffness", min=0)
    n = ia.parameter("1", "exponent", above=0)

    def equations(self) -> Any:
        yield self.f == self.k * self.s_rel * ca.fabs(self.s_rel) ** (self.n - 1)


def powered(n: float) -> ia.Network:
    net = ia.Network(
        "power", wall=ia.Fixed(), first=ia.Spring(k=1.0), law=Power(k=1.0, n=n), mass=ia.Mass(m=1.0)
    )
    net.connect(net.wall.flange, net.first.flange_a, net.law.flange_a)
    return net.connect(net.first.flange_b, net.law.flange_b, net.mass.flange)


@pytest.mark.parametrize(
    ("n", "solver", "what"),
    [
        (0.5, "auto", "value"),
        (0.5, "compiled", "value"),
        (1.5, "rosenbrock", "slope"),
        (1.5, "idas", "slope"),
    ],
)
def test_an_equation_without_value_or_slope_is_named(n: float, solver: str, what: str) -> None:
    with pytest.raises(ia.SimulationError) as caught:
        powered(n).simulate(1.0, solver=solver)
    told = str(caught.value)
    assert f"Power 'law' has no finite {what} of `(f-((k*s_rel)*pow(fabs(s_rel),(n-1)))) == 0`" in told
    assert "s_rel = 0" in told
    assert "`inertance docs write-your-own-component` says how" in told
    assert "Spring" not in told
    with pytest.raises(ia.ModelError, match=f"Power 'law' has no finite {what}"):
        linearise(powered(n))


def test_an_input_that_ceases_to_be_a_number_is_named() -> None:
    with pytest.raises(ia.SimulationError, match=r"input 'push\.f' is nan at t = 0\.50\d s"):
        run(inputs={"push.f": lambda t: ca.sqrt(0.5 - t)})


def test_a_formula_of_a_parameter_that_fails_is_named() -> None:
    for formula in (lambda net: math.sqrt(net.mass.m), lambda net: 1 / 0):
        net = oscillator().with_values(spring=ia.Spring(k=formula))
        with pytest.raises(ia.ModelError, match="Spring 'spring': k cannot be computed: "):
            net.dae()
