"""The command line: what it prints, what it writes, and how it refuses."""

import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

import inertance as ia
import matplotlib as mpl
import numpy as np
import pytest
from inertance.cli import app
from typer.testing import CliRunner, Result

mpl.use("Agg")

MODEL = """
import inertance as ia


def driven():
    net = ia.Network("driven", wall=ia.Fixed(), spring=ia.Spring(k=100.0), mass=ia.Mass(m=1.0))
    net.add(push=ia.Force())
    net.connect(net.wall.flange, net.spring.flange_a)
    return net.connect(net.spring.flange_b, net.mass.flange, net.push.flange)


def free():
    net = driven().add(zero=ia.signals.Constant(k=0.0))
    return net.connect(net.zero.y, net.push.f)


def rubbing():
    net = free()
    net.add(rub=ia.CoulombFriction(f_c=1.0))
    return net.connect(net.wall.flange, net.rub.flange_a).connect(net.rub.flange_b, net.mass.flange)


def loose():
    return ia.Network("loose", spring=ia.Spring(k=-1.0))


def diverging():
    net = ia.Network("diverging", wall=ia.Fixed(), spring=ia.CubicSpring(k=0.0, k3=-1.0), mass=ia.Mass(m=1.0))
    net.connect(net.wall.flange, net.spring.flange_a)
    return net.connect(net.spring.flange_b, net.mass.flange)


def broken():
    return undefined_name


def number():
    return 1


def demanding(size):
    return free()


constant = 5
"""


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "model.py").write_text(MODEL)
    return tmp_path


def call(*arguments: str) -> Result:
    return CliRunner().invoke(app, list(arguments))


def good(*arguments: str) -> str:
    result = call(*arguments)
    assert (result.exit_code, result.stderr) == (0, "")
    return result.stdout


def refused(code: int, *arguments: str) -> str:
    """Return the message of a command that must end with a code, without a traceback."""
    result = call(*arguments)
    assert result.exit_code == code, result.output
    assert isinstance(result.exception, SystemExit)
    assert "Traceback" not in result.output
    return result.stderr


def data(name: str, header: str = "time,push.f", **changed: str) -> str:
    """Write 21 lines of data, some of them changed (`line_5="..."`)."""
    lines = [header, *(f"{t:.1f},{np.sin(3 * t):.6f}" for t in np.linspace(1, 3, 21))]
    for key, text in changed.items():
        lines[int(key.removeprefix("line_")) - 1] = text
    Path(name).write_text("\n".join(lines) + "\n")
    return name


# the program as a whole


def test_version() -> None:
    assert good("--version") == f"inertance {version('inertance')}\n"


def test_help_teaches_by_example() -> None:
    assert "inertance run model.py:build --stop 5" in good("--help")
    assert "inertance components Spring" in good("components", "--help")
    assert "--input road.csv --out run.csv" in good("run", "--help")


def test_as_a_module() -> None:
    done = subprocess.run(
        [sys.executable, "-m", "inertance", "components", "Sprin"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2
    assert done.stderr.startswith("error: there is no component 'Sprin'; did you mean 'Spring'?")
    assert done.stdout == ""


def test_wrong_command_and_option() -> None:
    assert "No such command" in refused(2, "simulate")
    assert "No such option" in refused(2, "run", "model.py:free", "--until", "5")


def test_importing_the_library_stays_light() -> None:
    heavy = ("pandas", "matplotlib", "scipy", "rich", "typer")
    code = f"import sys, inertance; print([m for m in {heavy} if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"


def test_a_path_that_cannot_be_written(folder: Path) -> None:
    assert "model.py" in refused(2, "demo", "--out", "model.py")
    (folder / "taken.csv").mkdir()
    assert "taken.csv" in refused(2, "run", "model.py:free", "--out", "taken.csv")


# components


def listed() -> list[str]:
    lines = good("components").splitlines()
    return [line.split()[0] for line in lines if line.startswith("  ") and "(base)" not in line]


def test_all_families_are_listed_with_a_line_each() -> None:
    text = good("components")
    for family in ("machines", "rotational", "signals", "thermal", "translational", "transmission"):
        assert f"\n{family}: " in f"\n{text}"
    assert "  Spring  " in text
    assert "Linear spring: f = k (s_rel - s_rel0)." in text
    assert "  rotational.Spring  " in text
    assert "  signals.Gain  " in text
    names = listed()
    assert len(names) == len(set(names)) > 60
    for name in names:
        family, _, plain = name.rpartition(".")
        assert issubclass(getattr(getattr(ia, family) if family else ia, plain), ia.Component)


def test_bases_are_told_apart() -> None:
    text = good("components")
    assert "(base) Two flanges without mass between them" in text
    assert {"Compliant", "TwoFlanges", "Friction"}.isdisjoint(listed())
    assert "A base: derive an element from it" in good("components", "Compliant")


def test_everything_about_one_component() -> None:
    text = good("components", "MassWithStopAndFriction")
    for told in ("A mass that rubs on a support", "flange", "grounded when left", "unconnected", "m/s2"):
        assert told in text
    rows = [" ".join(line.split()) for line in text.splitlines()]
    assert "m kg required > 0 mass" in rows
    assert "f_s N f_c ≥ 0 static friction force" in rows
    assert any(row.startswith("friction StribeckFriction ") for row in rows)


def test_modes_impulses_and_inputs_of_a_component() -> None:
    text = good("components", "HardStop")
    assert "free, contact" in text
    assert "impulse of a shock" in text
    assert "e       1     0        ≥ 0, ≤ 1  coefficient of restitution" in text
    assert "builds on Compliant" in text
    assert "driving force" in good("components", "Force")


def test_names_are_found_without_capitals_and_family() -> None:
    assert good("components", "spring") == good("components", "Spring")
    assert good("components", "inertia") == good("components", "rotational.Inertia")
    assert "see also rotational.Spring" in good("components", "Spring")


def test_wrong_component() -> None:
    assert "did you mean 'Spring'?" in refused(2, "components", "sprng")
    assert "did you mean 'rotational.Inertia'?" in refused(2, "components", "rotational.Inertai")
    assert "there is no component 'zzzz'; `inertance components` lists them all" in refused(
        2, "components", "zzzz"
    )


@pytest.mark.parametrize("name", listed())
def test_the_example_of_every_component_runs(name: str) -> None:
    example = good("components", name).partition("\nexample\n")[2].partition("\nsee also")[0]
    result: dict[str, ia.Result] = {}
    exec(example, result)
    assert np.isfinite(result["run"].time[-1])
    assert result["run"].time[-1] == 1.0


# run: what it does


def test_a_run_is_told() -> None:
    text = good("run", "model.py:free", "--start", "mass.s=0.25", "--stop", "2")
    assert "driven: 0 to 2 s" in text
    assert "0.25" in text
    assert "fixed" in text
    assert "0 events" in text


def test_events_of_a_run_are_told() -> None:
    assert "CoulombFriction 'rub'" in good("run", "model.py:rubbing", "--start", "mass.s=0.25")


def test_parameters_and_start_values_are_set() -> None:
    good(
        "run", "model.py:free", "--set", "spring.k=25", "--set", "mass.m=4", "--start", "mass.s=0.1",
        "--stop", "1", "--step", "0.25", "--rtol", "1e-10", "--out", "run.csv",
        "--signals", "mass.s,spring.k",
    )  # fmt: skip
    table = ia.load_table("run.csv")
    assert table.index.tolist() == [0.0, 0.25, 0.5, 0.75, 1.0]
    assert table["spring.k"].tolist() == [25.0] * 5
    assert table["mass.s"].to_numpy() == pytest.approx(0.1 * np.cos(2.5 * table.index), abs=1e-7)


@pytest.mark.parametrize("ending", ["csv", "parquet", "npz"])
def test_signals_are_written(ending: str) -> None:
    out = f"run.{ending}"
    text = good("run", "model.py:free", "--out", out, "--signals", "mass.*,spring.f")
    assert f"wrote {out}" in text
    table = ia.load_table(out)
    assert table.columns[-1] == "spring.f"
    assert "mass.a" in table.columns
    assert table.attrs["units"]["spring.f"] == "N"
    assert table.index[-1] == 10.0


def test_plots_are_written() -> None:
    assert "wrote free.png" in good("run", "model.py:free", "--plot", "mass.s, spring.f")
    assert "wrote b.png" in good("run", "model.py:free", "--plot", "mass.s", "--out", "b.csv")
    for name in ("free.png", "b.png"):
        assert Path(name).read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize("header", ["time,push.f", "time [s],push.f [N]"])
def test_measured_input(header: str) -> None:
    good(
        "run", "model.py:driven", "--input", data("push.csv", header), "--out", "run.npz",
        "--signals", "push.f",
    )  # fmt: skip
    table = ia.load_table("run.npz")
    assert (table.index[0], table.index[-1]) == (1.0, 3.0)
    assert table["push.f"].to_numpy() == pytest.approx(np.sin(3 * table.index), abs=2e-4)


def test_measured_input_as_fit_reads_it() -> None:
    rows = [f"{1000 + k};{0.001 * k:g}".replace(".", ",") for k in range(5)]
    Path("push.txt").write_text("\n".join(["# bench 3", "t [ms];push.f (kN)", *rows]))
    good("run", "model.py:driven", "--input", "push.txt", "--out", "run.npz", "--signals", "push.f")
    table = ia.load_table("run.npz")
    assert (table.index[0], table.index[-1]) == (1.0, 1.004)
    assert table["push.f"].to_numpy() == pytest.approx(1e3 * (table.index - 1.0), abs=1e-9)


def test_a_measured_input_may_be_held() -> None:
    Path("steps.csv").write_text("time,push.f\n0,1\n0.5,-2\n1,0\n")
    asked = "run", "model.py:driven", "--input", "steps.csv"
    good(*asked, "--hold", "push*", "--out", "run.npz", "--signals", "push.f")
    assert set(ia.load_table("run.npz")["push.f"]) == {1.0, -2.0, 0.0}
    error = refused(2, *asked, "--hold", "pusch.f")
    assert "no column 'pusch.f' is there to be held; did you mean 'push.f'?" in error
    assert "give --input FILE too" in refused(2, "run", "model.py:driven", "--hold", "push.f")


def test_a_saved_result_is_an_input() -> None:
    good(
        "run", "model.py:driven", "--input", data("push.csv"), "--out", "again.parquet", "--signals", "push.f"
    )
    assert "1 to 2 s" in good("run", "model.py:driven", "--input", "again.parquet", "--stop", "2")


def test_model_may_import_its_neighbours(folder: Path) -> None:
    (folder / "models").mkdir()
    (folder / "models" / "machine_part.py").write_text(
        "import inertance as ia\nmass = ia.Mass(m=1.0, v=1.0)\n"
    )
    (folder / "models" / "machine.py").write_text(
        "import inertance as ia\nfrom machine_part import mass\n\n"
        "def build():\n    net = ia.Network('machine', mass=mass, push=ia.ConstantForce(f_constant=1.0))\n"
        "    return net.connect(net.mass.flange, net.push.flange)\n"
    )
    assert "machine: 0 to 10 s" in good("run", "models/machine.py:build")


# run: wrong use


@pytest.mark.parametrize(
    ("model", "message"),
    [
        ("model.py", "MODEL is 'path/to/file.py:function', got 'model.py'"),
        ("model.txt:build", "MODEL is 'path/to/file.py:function'"),
        ("nowhere.py:build", "there is no file 'nowhere.py'"),
        ("model.py:fre", "model.py has no function 'fre'; did you mean 'free'?"),
        ("model.py:zzz", "model.py has no function 'zzz'; it has driven, free, rubbing"),
        ("model.py:constant", "model.py has no function 'constant'"),
        ("model.py:number", "model.py:number returned int, but MODEL returns a Network"),
    ],
)
def test_wrong_model(model: str, message: str) -> None:
    assert message in refused(2, "run", model)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--set", "spring.k"], "--set takes NAME=VALUE with a number, got 'spring.k'"),
        (["--start", "mass.s=abc"], "--start takes NAME=VALUE with a number, got 'mass.s=abc'"),
        (["--set", "sprig.k=5"], "there is no parameter 'sprig.k'; did you mean 'spring.k'?"),
        (["--set", "spring.k=-5"], "'spring.k': k must be at least 0 N/m, got -5.0"),
        (["--start", "mass.z=1"], "no variable 'mass.z'"),
        (["--stop", "-1"], "stop must be after begin (0 s), got -1 s"),
        (["--step", "0"], "--step must be above 0, got 0"),
        (["--rtol", "-1e-6"], "--rtol must be above 0, got -1e-06"),
        (["--plot", "mas.s"], "no variable 'mas.s'; did you mean 'mass.s'?"),
        (["--signals", "rotor.*", "--out", "r.csv"], "no variable like 'rotor.*'"),
        (["--out", "r.xlsx"], "tables end in .csv, .parquet, .npz"),
        (["--out", "nowhere/r.csv"], "there is no folder 'nowhere' to write 'r.csv' into"),
        (["--input", "none.csv"], "there is no file 'none.csv'"),
        (["--signals", "mass.s"], "--signals says what --out writes and --json tells; give"),
    ],
)
def test_wrong_options(options: list[str], message: str, folder: Path) -> None:
    assert message in refused(2, "run", "model.py:free", *options)
    assert [path.name for path in folder.iterdir() if path.is_file()] == ["model.py"]


def test_missing_input() -> None:
    assert "no signal for 'push.f' [N]; give --input FILE.csv with the header time,push.f" in refused(
        2, "run", "model.py:driven"
    )


@pytest.mark.parametrize(
    ("header", "changed", "message"),
    [
        ("time,push.f", {"line_5": "1.3,nan"}, "line 5, column 'push.f': nan is no usable number (1 such"),
        ("time,push.f", {"line_5": "1.3,inf"}, "line 5, column 'push.f': inf is no usable number"),
        ("time,push.f", {"line_5": "nan,0"}, "line 5, column 'time': nan is no usable number"),
        ("time,push.f", {"line_5": "1.1,0"}, "line 5, column 'time': 1.1 comes after 1.2; sort"),
        ("time,push.f", {"line_5": "1.2,0"}, "line 5, column 'time': 1.2 stands there twice (1 such)"),
        ("time,push.f", {"line_5": "1.3,x"}, "line 5, column 'push.f': 'x' is no number"),
        ("time,push.f", {"line_5": "1.3"}, "line 5: 1 cells under 2 names"),
        ("when,push.f", {}, "there is no column of time among when, push.f"),
        ("time,pusch.f", {}, "line 1, column 'pusch.f': there is no such input; did you mean 'push.f'?"),
        ("time,zzz", {}, "line 1, column 'zzz': there is no such input; the inputs are push.f"),
        (
            "time,push.f [mm]",
            {},
            "line 1, column 'push.f': 'mm' measures m, the quantity of the model is in N",
        ),
        ("time [mm],push.f", {}, "line 1, column 'time': 'mm' measures m, the quantity of the model is in s"),
    ],
)
def test_bad_data_is_told_by_line_and_column(header: str, changed: dict[str, str], message: str) -> None:
    error = refused(2, "run", "model.py:driven", "--input", data("bad.csv", header, **changed))
    assert f"bad.csv{':' if message.startswith('there') else ','} {message}" in error


def test_data_that_do_not_suffice() -> None:
    Path("short.csv").write_text("time,push.f\n0,0\n1,1\n2,2\n")
    assert "short.csv: 3 rows; at least 4" in refused(2, "run", "model.py:driven", "--input", "short.csv")
    Path("missing.csv").write_text("time\n0\n1\n2\n3\n")
    assert "missing.csv, line 1: no column 'push.f' [N]" in refused(
        2, "run", "model.py:driven", "--input", "missing.csv"
    )
    late = refused(2, "run", "model.py:driven", "--input", data("push.csv"), "--stop", "5")
    assert "--stop 5 s is after the last sample of push.csv, 3 s" in late


def test_data_for_a_network_without_inputs() -> None:
    message = "column 'push.f': there is no such input; there are none"
    assert message in refused(2, "run", "model.py:free", "--input", data("push.csv"))


# run: a run that fails


def test_a_model_that_cannot_be_assembled() -> None:
    error = refused(1, "run", "model.py:loose")
    assert "Spring 'spring': k must be at least 0 N/m, got -1.0" in error
    assert "Spring 'spring': flange_a is not connected" in error


def test_a_model_that_fails_is_told_by_its_line(folder: Path) -> None:
    line = MODEL.splitlines().index("    return undefined_name") + 1
    assert f"model.py, line {line}: NameError: name 'undefined_name' is not defined" in refused(
        1, "run", "model.py:broken"
    )
    assert "TypeError: demanding() missing 1 required positional argument: 'size'" in refused(
        1, "run", "model.py:demanding"
    )
    (folder / "syntax.py").write_text("def build(:\n    pass\n")
    assert "syntax.py, line 1: SyntaxError" in refused(1, "run", "syntax.py:build")
    (folder / "imports.py").write_text("\nimport no_such_module\n")
    assert "imports.py, line 2: ModuleNotFoundError" in refused(1, "run", "imports.py:build")


def test_start_values_that_contradict_each_other() -> None:
    error = refused(1, "run", "model.py:free", "--start", "mass.s=1", "--start", "spring.s_rel=2")
    assert "mass.s" in error


def test_what_a_failed_run_computed_is_kept() -> None:
    result = call(
        "run", "model.py:diverging", "--start", "mass.s=1", "--start", "mass.v=1", "--out", "run.csv"
    )
    assert result.exit_code == 1
    assert "integration failed at t = " in result.stderr
    assert "Traceback" not in result.output
    assert 0.5 < ia.load_table("run.csv").index[-1] < 10
