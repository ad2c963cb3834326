# ruff: noqa: E501  (tables of messages)
"""Odd campaigns, which are read but hold what no machine does: told, or fitted and diagnosed, never a crash."""

from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from inertance.cli import app
from numpy.typing import NDArray
from typer.testing import CliRunner

Array = NDArray[np.float64]
RIG = """import inertance as ia
def build():
    net = ia.Network("rig", wall=ia.Fixed(), spring=ia.Spring(k=800.0), guide=ia.Damper(d=6.0))
    net.add(carriage=ia.Mass(m=2.0), push=ia.Force())
    net.connect(net.wall.flange, net.spring.flange_a, net.guide.flange_a)
    return net.connect(net.carriage.flange, net.spring.flange_b, net.guide.flange_b, net.push.flange)
"""
CAMPAIGN = """model = "rig.py:build"
[channels]
F = { input = "push.f", unit = "N" }
x = { output = "carriage.s", unit = "m" }
[parameters]
"spring.k" = { rel = 0.1 }
"guide.d" = { rel = 0.3 }
[[train]]
file = "train.csv"
[[test]]
file = "test.csv"
[noise]
x = 1e-5
"""
REL, NOISE, TRAIN, X = (
    "{ rel = 0.1 }",
    "[noise]\nx = 1e-5\n",
    'file = "train.csv"',
    '"carriage.s", unit = "m"',
)
VERDICTS = "none", "parameters", "effect", "ambiguous", "partial", "law", "unknown", "interrupted"


@cache
def record(seed: int, duration: float = 0.6, rate: float = 200.0) -> Array:
    """Return time, force and motion of the machine with a spring of 820 N/m, from rest, with noise."""
    random, t = np.random.default_rng(seed), np.arange(0.0, duration, 1 / rate)
    tones = [np.sin(2 * np.pi * f * t + random.uniform(0, 6)) for f in (0.7, 1.9, 3.1, 5.3)]
    force = 5.0 * np.sum(tones, axis=0) * np.minimum(1.0, t / 0.2)
    made: dict[str, Any] = {}
    exec(RIG.replace("800.0", "820.0"), made)
    run = made["build"]().simulate(float(t[-1]), step=1 / rate, inputs={"push.f": (t, force)})
    x = run["carriage.s"][np.searchsorted(run.time, t + 1e-7, side="right") - 1]
    return np.column_stack([t, force, x + 1e-5 * random.standard_normal(len(t))])


def written(path: Path, table: Array) -> None:
    names = ["time", "F", "x", "y"][: table.shape[1]]
    np.savetxt(path, table, "%.12g", ",", header=",".join(names), comments="")


def told_by(folder: Path, command: str, *options: str) -> tuple[int, str]:
    """Return exit code and output of a command on the campaign of a folder, once it is seen not to crash."""
    done = CliRunner().invoke(app, [command, str(folder / "campaign.toml"), *options])
    assert done.exception is None or isinstance(done.exception, SystemExit), done.exception
    assert "Traceback" not in done.output
    return done.exit_code, done.output.replace("\n", " ")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "rig.py").write_text(RIG)
    (tmp_path / "campaign.toml").write_text(CAMPAIGN)
    written(tmp_path / "train.csv", record(1))
    written(tmp_path / "test.csv", record(2))
    return tmp_path


REFUSED = {
    "noise far below numbers": ("x = 1e-5", "x = 1e-30", "noise.x: 1e-30 m is less than any sensor's beside"),
    "noise without a reciprocal": ("x = 1e-5", "x = 5e-324", "noise.x: 4.94066e-324 m is less than any"),
    "noise above all": ("x = 1e-5", "x = 1e30", "noise.x: 1e+30 m is more than all that was measured"),
    "noise is nan": ("x = 1e-5", "x = nan", "noise.x: the standard deviation must be above 0 m, got nan"),
    "prior of no width": ("rel = 0.1", "rel = 1e-300", 'parameters."spring.k": rel 1e-300 leaves no freedom'),
    "prior beyond numbers": ("rel = 0.1", "rel = 1e300", 'parameters."spring.k": rel 1e+300 is beyond any'),
    "bounds beyond numbers": (REL, "{ min = -1e300, max = 1e300 }", "max 1e+300 is beyond any machine"),
    "bound is nan": (REL, "{ min = nan, max = 3.0 }", "min must be a finite number, got nan"),
    "prior of nothing": ("spring.k", "spring.s_rel0", "rel of a value that is 0 leaves no freedom; give min"),
    "record twice": ("[[test]]", f"[[train]]\n{TRAIN}\n[[test]]", "[[train]] 2: 'train.csv' is also [[train]] 1"),
    "offset of nothing": (TRAIN, f'{TRAIN}\noffset = ["y"]', "offset: there is no output channel 'y'"),
    "output is a drive": (X, '"push.f", unit = "N"', "'push.f' is channel 'F' already, once as input and once"),
    "output is time": (X, '"time", unit = "s"', "channels.x: 'time' is what records are told by, and no sensor measures it"),
    "unit of heat": ('unit = "m"', 'unit = "degC"', "channels.x: 'degC' measures K"),
    "paths in brackets": ('input = "push.f"', 'input = ["push.f"]', "channels.F: input must be a text in quotes"),
    "campaign as record": ("train.csv", "campaign.toml", "tables end in .csv, .txt, .parquet, .npz, .mat, .at2"),
    "folder as model": ("rig.py:build", ".:build", "model"),
    "FMU that is not there": ("rig.py:build", "rig.fmu", "rig.fmu"),
    "letters of other alphabets": ("rig.py", "räg µ.py", "did you mean 'rig.py'?"),
}  # fmt: skip


@pytest.mark.parametrize("command", ["fit", "diagnose"])
@pytest.mark.parametrize(("old", "new", "told"), REFUSED.values(), ids=REFUSED)
def test_what_no_campaign_can_be_is_refused(
    folder: Path, command: str, old: str, new: str, told: str
) -> None:
    assert old in CAMPAIGN
    (folder / "campaign.toml").write_text(CAMPAIGN.replace(old, new), encoding="utf-8")
    code, output = told_by(folder, command)
    assert code == 2
    assert told in output


OPTIONS = {
    "budget of nothing": (["--budget", "0"], "budget must be above 0 s, got 0"),
    "budget below nothing": (["--budget", "-1"], "budget must be above 0 s, got -1"),
    "budget is nan": (["--budget", "nan"], "budget must be a finite number [s], got nan"),
    "jobs below nothing": (["--jobs", "-1"], "--jobs must be at least 0, got -1"),
    "unknown solver": (["--solver", "euler"], "solver must be"),
}


@pytest.mark.parametrize(("options", "told"), OPTIONS.values(), ids=OPTIONS)
def test_what_no_option_can_be_is_refused(folder: Path, options: list[str], told: str) -> None:
    code, output = told_by(folder, "diagnose", *options)
    assert code == 2
    assert told in output


def scaled(column: int, factor: float) -> Callable[[Array], Array]:
    return lambda table: table * np.where(np.arange(table.shape[1]) == column, factor, 1.0)


def moved(change: Callable[[Array], Array]) -> Callable[[Array], Array]:
    return lambda table: np.column_stack([table[:, :2], change(table[:, 2])])


STOPPED = RIG.replace("push=ia.Force()", "push=ia.Force(), stop=ia.HardStop(s_min=-0.004)").replace(
    "    return", "    net.connect(net.wall.flange, net.stop.flange_a)\n    net.connect(net.carriage.flange, net.stop.flange_b)\n    return"
)  # fmt: skip
MODELS = {
    "stiff": RIG.replace("800.0", "1e6"),
    "stiffer than any machine": RIG.replace("800.0", "1e12"),
    "soft as nothing": RIG.replace("800.0", "1e-12"),
    "blowing up": RIG.replace("ia.Spring(k=800.0)", "ia.CubicSpring(k=1.0, k3=-1e9)"),
    "light as nothing": RIG.replace("m=2.0", "m=1e-9"),
    "heavy as a mountain": RIG.replace("m=2.0", "m=1e12"),
    "with shocks": STOPPED,
}  # fmt: skip
RECORDS: dict[str, Callable[[Array], Array]] = {
    "in other units": scaled(2, 1e3),
    "huge": scaled(2, 1e5),
    "tiny": scaled(2, 1e-9),
    "with the other sign": scaled(2, -1.0),
    "in another unit of time": scaled(0, 30.0),
    "in no time": scaled(0, 1e-6),
    "before time": lambda table: table - np.array([100.0, 0.0, 0.0]),
    "as short as may be": lambda table: table[:32],
    "a step": moved(np.sign),
    "with a spike": moved(lambda x: x + (np.arange(len(x)) == 100)),
    "saturated": moved(lambda x: np.clip(x, -3e-3, 3e-3)),
    "nothing but noise": moved(lambda x: np.random.default_rng(3).standard_normal(len(x))),
    "with an offset": moved(lambda x: x + 0.5),
}
PRIORS = {
    "hardly any freedom": "{ rel = 1e-9 }",
    "nothing known": "{ rel = 1e9 }",
    "narrow": "{ min = 799.9999999, max = 800.0000001 }",
    "wide": "{ min = 1e-12, max = 1e12 }",
    "at a bound": "{ min = 800.0, max = 900.0 }",
    "at the wrong bound": "{ min = 700.0, max = 800.0 }",
    "of both signs": "{ min = -900.0, max = 900.0 }",
}


def ends_well(folder: Path) -> None:
    """Check that both commands fit and diagnose a campaign, or tell why not."""
    for command, *options in (["fit"], ["diagnose", "--jobs", "1", "--budget", "0.2", "--report", "r.html"]):
        if options:
            options[-1] = str(folder / options[-1])
        code, output = told_by(folder, command, *options)
        verdicts = any(f"{verdict}: " in output for verdict in VERDICTS)
        assert "error: " in output if code in (1, 2) else verdicts or "std. error" in output


@pytest.mark.parametrize("model", MODELS.values(), ids=MODELS)
def test_odd_models(folder: Path, model: str) -> None:
    (folder / "rig.py").write_text(model)
    (folder / "campaign.toml").write_text(CAMPAIGN.replace(f'"spring.k" = {REL}\n', ""))
    ends_well(folder)


@pytest.mark.parametrize("change", RECORDS.values(), ids=RECORDS)
def test_odd_records(folder: Path, change: Callable[[Array], Array]) -> None:
    (folder / "campaign.toml").write_text(CAMPAIGN.replace(NOISE, ""))
    for seed, name in ((1, "train.csv"), (2, "test.csv")):
        written(folder / name, change(record(seed)))
    ends_well(folder)


@pytest.mark.parametrize("prior", PRIORS.values(), ids=PRIORS)
def test_odd_priors(folder: Path, prior: str) -> None:
    (folder / "campaign.toml").write_text(CAMPAIGN.replace(REL, prior))
    ends_well(folder)


def test_a_channel_that_no_parameter_moves(folder: Path) -> None:
    text = CAMPAIGN.replace(X, '"push.flange.f", unit = "N"').replace(NOISE, "")
    (folder / "campaign.toml").write_text(text)
    ends_well(folder)


@pytest.mark.parametrize("rates", [(2.0, 2.0), (20e3, 20e3), (1000.0, 50.0)])
def test_odd_rates(folder: Path, rates: tuple[float, float]) -> None:
    for seed, rate, name in zip((1, 2), rates, ("train.csv", "test.csv"), strict=True):
        written(folder / name, record(seed, 20.0 if rate < 50 else 0.7, rate))
    ends_well(folder)


def test_a_model_far_faster_than_its_record_is_told(folder: Path) -> None:
    """It read "max_steps = 20000 grants no more", which no campaign can change."""
    (folder / "rig.py").write_text(RIG.replace("800.0", "1e9"))
    code, output = told_by(folder, "diagnose", "--jobs", "1")
    assert code == 1
    assert "train.csv: 'rig' moves far faster than the record: more than 50 steps" in output


@pytest.mark.parametrize("command", ["fit", "diagnose"])
def test_shocks_are_told(folder: Path, command: str) -> None:
    (folder / "rig.py").write_text(MODELS["with shocks"])
    code, output = told_by(folder, command)
    assert code == 2
    assert "'rig' has shocks" in output
