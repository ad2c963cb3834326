"""Models in Python files: what stands beside one is imported in every command and process, by it alone."""

import sys
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from importlib import import_module
from multiprocessing import get_context
from pathlib import Path

import inertance as ia
import numpy as np
import pytest
from inertance.cli import app
from inertance.identification import Multisine
from inertance.networks import UserCodeError, load_model
from typer.testing import CliRunner

HELPER = """
import inertance as ia
from parts.law import Law

STIFFNESS = {k}
"""
LAW = """
import inertance as ia


class Law(ia.Compliant):
    '''Linear spring whose equation imports what stands beside it only when it is asked for.'''

    k = ia.parameter("N/m", "stiffness", min=0)

    def equations(self):
        from later import unit

        yield self.f == unit(self.k) * self.s_rel
"""
BUILD = """
    net = ia.Network("rig", wall=ia.Fixed(), push=ia.Force())
    net.add(spring=helper.Law(k=helper.STIFFNESS), damper=ia.Damper(d=6.0), mass=ia.Mass(m=2.0))
    net.connect(net.wall.flange, net.spring.flange_a, net.damper.flange_a)
    net.connect(net.mass.flange, net.push.flange)
    return net.connect(net.mass.flange, net.spring.flange_b, net.damper.flange_b)
"""
AT_THE_TOP = f"import inertance as ia\nimport helper\ndef build():{BUILD}"
INSIDE = f"import inertance as ia\ndef build():\n    import helper{BUILD}"
MEASURE = "def stiffness(dae, values):\n    return dae.parameter_values['spring.k'] + values['mass.m']\n"
CAMPAIGN = """
model = "rig.py:build"
[channels]
F = { input = "push.f", unit = "N" }
x = { output = "mass.s", unit = "m" }
[parameters]
"spring.k" = { rel = 0.2 }
[noise]
x = 1e-4
[[train]]
file = "1.csv"
initial = "rest"
[[test]]
file = "2.csv"
initial = "rest"
"""
PLACES = pytest.mark.parametrize("source", [AT_THE_TOP, INSIDE], ids=["top", "inside"])


def written(folder: Path, source: str, k: float = 800.0) -> str:
    """Write a rig with its helpers into a folder and return it as a model."""
    (folder / "parts").mkdir(parents=True)
    (folder / "parts/__init__.py").write_text("")
    (folder / "parts/law.py").write_text(LAW)
    (folder / "later.py").write_text("def unit(k):\n    return 1.0 * k\n")
    (folder / "helper.py").write_text(HELPER.format(k=k))
    (folder / "rig.py").write_text(source)
    return f"{folder / 'rig.py'}:build"


def campaign(folder: Path, source: str) -> Path:
    """Write a campaign on the rig, measured on one that rubs, and return its file."""
    net = load_model(written(folder, source))
    net.add(rail=ia.CoulombFriction(f_c=0.8)).connect(net.wall.flange, net.rail.flange_a)
    net.connect(net.rail.flange_b, net.mass.flange)
    t = np.linspace(0.0, 2.0, 201)
    for number in (1, 2):
        drive = ia.identification.sampled(
            Multisine(rms=5.0, low=0.5, high=8.0, period=2.0, seed=number), 2.0, 100.0, fade=0.5
        )
        seen = net.simulate(2.0, inputs={"push.f": drive}, step=0.01, parameters={"spring.k": 820.0})
        x = np.interp(t, seen.time, seen["mass.s"]) + np.random.default_rng(number).normal(0, 1e-4, len(t))
        table = np.c_[t, drive.values[: len(t)], x]
        np.savetxt(folder / f"{number}.csv", table, delimiter=",", header="time,F,x", comments="")
    (folder / "campaign.toml").write_text(CAMPAIGN)
    return folder / "campaign.toml"


def ran(*arguments: object) -> str:
    result = CliRunner().invoke(app, [str(a) for a in arguments])
    assert result.exit_code == 0, result.output
    return result.output


@pytest.fixture
def spawned() -> ProcessPoolExecutor:
    return ProcessPoolExecutor(1, mp_context=get_context("spawn"))


@pytest.fixture
def stiffness(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[..., float]]:
    """A measure that other processes can import, from wherever the tests were started."""
    (tmp_path / "measures").mkdir()
    (tmp_path / "measures/measure_of_stiffness.py").write_text(MEASURE)
    monkeypatch.syspath_prepend(tmp_path / "measures")
    yield import_module("measure_of_stiffness").stiffness
    del sys.modules["measure_of_stiffness"]


@PLACES
def test_run_imports_what_stands_beside_a_model(tmp_path: Path, source: str) -> None:
    written(tmp_path / "here", source)
    (tmp_path / "u.csv").write_text("time,push.f\n0,0\n1,1\n2,0\n3,0\n")
    assert "rig" in ran("run", tmp_path / "here/rig.py:build", "--input", tmp_path / "u.csv")


def test_fit_imports_what_stands_beside_a_model(tmp_path: Path) -> None:
    file = campaign(tmp_path / "here", AT_THE_TOP)
    assert "spring.k" in ran("fit", file, "--starts", 2, "--workers", 2)


def test_diagnose_imports_what_stands_beside_a_model(tmp_path: Path) -> None:
    file = campaign(tmp_path / "here", INSIDE)
    assert "friction" in ran("diagnose", file, "--jobs", 2, "--solver", "cvodes")


@PLACES
@pytest.mark.parametrize("given", ["by name", "as a network"])
def test_a_sweep_imports_what_stands_beside_a_model(
    tmp_path: Path,
    source: str,
    given: str,
    spawned: ProcessPoolExecutor,
    stiffness: Callable[..., float],
) -> None:
    name = written(tmp_path / "version 1.0", source)
    model = name if given == "by name" else load_model(name)
    with spawned:
        done = ia.sweeps.sweep(model, {"mass.m": [1.0, 2.0]}, stiffness, executor=spawned)
    assert list(done.table["value"]) == [801.0, 802.0]
    assert list(ia.sweeps.sweep(model, {"mass.m": [3.0]}, stiffness, workers=1).table["value"]) == [803.0]


@PLACES
def test_helpers_of_one_name_in_two_folders_stay_apart(tmp_path: Path, source: str) -> None:
    models = [written(tmp_path / name, source, k) for name, k in (("a", 10.0), ("b", 20.0))]
    before = set(sys.modules), list(sys.path)
    nets = [load_model(model) for model in (*models, *models)]
    assert [net.dae().parameter_values["spring.k"] for net in nets] == [10.0, 20.0, 10.0, 20.0]
    assert not {"helper", "parts", "later", "rig"} & (set(sys.modules) - before[0])
    assert sys.path == before[1]


def test_what_a_script_has_imported_itself_is_no_model_s_helper(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    written(tmp_path / "a", INSIDE, 10.0)
    model = written(tmp_path / "b", INSIDE, 20.0)
    monkeypatch.syspath_prepend(tmp_path / "a")
    try:
        import helper  # type: ignore[import-not-found]

        assert load_model(model).dae().parameter_values["spring.k"] == 20.0
        own = load_model(f"{tmp_path / 'a/rig.py'}:build")
        assert type(own.spring) is helper.Law
    finally:
        for name in ("helper", "parts", "parts.law", "later"):
            sys.modules.pop(name, None)


def test_a_file_beside_a_model_does_not_replace_python_s_own(tmp_path: Path) -> None:
    model = written(
        tmp_path, f"import time\n{AT_THE_TOP}".replace("def build():", "def build():\n    time.time()")
    )
    (tmp_path / "time.py").write_text("")
    (tmp_path / "numpy").mkdir()
    (tmp_path / "inertance").mkdir()
    (tmp_path / "inertance/__init__.py").write_text("raise ImportError")
    assert load_model(model).name == "rig"


def test_an_import_that_is_not_there_is_told_with_its_line(tmp_path: Path) -> None:
    model = written(tmp_path, "\nimport helperr\n")
    with pytest.raises(UserCodeError, match=r"rig\.py, line 2: ModuleNotFoundError: .*'helperr'"):
        load_model(model)
