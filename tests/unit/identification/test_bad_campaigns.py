# ruff: noqa: E501  (tables of messages)
"""Bad campaigns: both commands tell the thing, the place and the remedy, without a traceback, exit code 2."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.cli import app
from inertance.identification import Campaign, Record
from inertance.identification.records.columns import clipped
from inertance.machines import Sinusoid
from typer.testing import CliRunner

BUILD = """    net = ia.Network("rig", table=ia.Position(), spring=ia.SpringDamper(k=1000.0, d=4.0), mass=ia.Mass(m=2.0))
    net.connect(net.table.flange, net.spring.flange_a)
    net.connect(net.spring.flange_b, net.mass.flange)
    return net
"""
MODEL = f"import inertance as ia\ndef build():\n{BUILD}"
CAMPAIGN = """
model = "rig.py:build"
[channels]
x = { input = "table.s_ref", unit = "mm" }
F = { output = "spring.f", unit = "N" }
[parameters]
"spring.k" = { rel = 0.1 }
"spring.d" = { min = 0.0, max = 20.0 }
[[train]]
file = "train.csv"
[[test]]
file = "test.csv"
[noise]
F = 0.01
"""
Table = list[list[float]]


def rows(frequency: float) -> Table:
    t = np.arange(201) / 200
    x, force = 2 * np.sin(2 * np.pi * frequency * t), 3 * np.sin(2 * np.pi * frequency * t + 0.3)
    return [[float(v) for v in row] for row in zip(t, x, force, strict=True)]


ROWS = rows(2.0)


def csv(table: Table = ROWS, header: str = "time [s],x [mm],F [N]") -> str:
    return "\n".join([header, *(",".join(f"{v:.9g}" for v in row) for row in table)]) + "\n"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    files = {"rig.py": MODEL, "campaign.toml": CAMPAIGN, "train.csv": csv(), "test.csv": csv(rows(3.0))}
    for name, text in files.items():
        (tmp_path / name).write_text(text)
    return tmp_path


def refused(folder: Path, *told: str) -> None:
    """Check that both commands end with exit code 2 and tell all of this."""
    for command in ("fit", "diagnose"):
        done = CliRunner().invoke(app, [command, str(folder / "campaign.toml")])
        assert isinstance(done.exception, SystemExit)
        assert done.exit_code == 2
        assert "Traceback" not in done.output
        for part in told:
            assert part in done.output


X, F, TRAIN = (
    'x = { input = "table.s_ref", unit = "mm" }',
    'F = { output = "spring.f", unit = "N" }',
    'file = "train.csv"',
)
TEXTS = {
    "model file missing": ("rig.py:build", "rag.py:build", "rag.py'; did you mean 'rig.py'?"),
    "function missing": ("rig.py:build", "rig.py:biuld", "has no function 'biuld'; did you mean 'build'?"),
    "model without function": ("rig.py:build", "rig.py", "model is 'path/to/file.py:function', got 'rig.py'"),
    "model is a number": ('"rig.py:build"', "3", "model must be a text in quotes, got 3"),
    "no TOML": ("model =", "model", "this is not TOML (Expected '=' after a key in a key/value pair (at line 2, column 7))"),
    "unknown key": ("[noise]", "[nosie]", "there is no key 'nosie'; did you mean 'noise'?"),
    "no record to fit": (f"[[train]]\n{TRAIN}", "", "train: tables [[train]] must be given"),
    "train with one bracket": ("[[train]]", "[train]", "train must be tables [[train]], got {'file': 'train.csv'}"),
    "channels with two brackets": ("[channels]", "[[channels]]", "channels must be a table [channels]"),
    "channel is a text": (X, 'x = "table.s_ref"', 'channels.x: give either input = "path" or output = "path"'),
    "input and output in one": ('input = "table.s_ref"', 'input = "table.s_ref", output = "mass.s"', "channels.x: give either input"),
    "input and output in two": ('output = "spring.f", unit = "N"', 'output = "table.s_ref"', "channels.F: 'table.s_ref' is channel 'x' already, once as input and once as output"),
    "two channels drive one input": (F, f'{F}\ny = {{ input = "table.s_ref" }}', "channels.y: 'table.s_ref' is driven by channel 'x' already"),
    "no outputs": (F, "", "channels: no output is measured, so there is nothing to compare"),
    "no inputs": (X, "", "channels: input 'table.s_ref' [m] has no signal; measure it or bind it"),
    "unknown input": ("table.s_ref", "table.s_rel", "channels.x: the model has no input 'table.s_rel'; did you mean 'table.s_ref'?"),
    "unknown output": ('"spring.f"', '"sprnig.f"', "'sprnig.f'; did you mean 'spring.f'?"),
    "output is a number": ('"spring.f"', "3", "channels.F: output must be a text in quotes, got 3"),
    "output is a parameter": ('"spring.f"', '"spring.k"', "channels.F: 'spring.k' is a parameter, which no sensor measures"),
    "unknown unit": ('"mm"', '"mn"', "channels.x: there is no unit 'mn'; did you mean"),
    "unit of another quantity": ('"mm"', '"kN"', "channels.x: 'kN' measures N, the quantity of the model is in m; give one of m, mm"),
    "unit against the file": ('"mm"', '"m"', "train.csv, line 1, column 'x': the file says [mm], the campaign unit = 'm'; correct one"),
    "key of a channel misspelt": ('unit = "mm"', 'unti = "mm"', "channels.x: there is no key 'unti'; did you mean 'unit'?"),
    "column missing": (X, X.replace("x =", "y ="), "train.csv: there is no column 'y'; its columns are time, x, F"),
    "unknown parameter": ('"spring.k"', '"spring.kk"', "has no parameter 'spring.kk'; did you mean 'spring.k'?"),
    "parameter is a signal": ('"spring.k"', '"spring.f"', "has no parameter 'spring.f'"),
    "parameter is a number": ("{ rel = 0.1 }", "0.1", 'parameters."spring.k": give rel (relative standard deviation), or min and max'),
    "rel negative": ("rel = 0.1", "rel = -0.1", 'parameters."spring.k": rel must be above 0, got -0.1'),
    "rel is a text": ("rel = 0.1", 'rel = "a"', "rel must be a finite number, got 'a'"),
    "rel infinite": ("rel = 0.1", "rel = inf", "rel must be a finite number, got inf"),
    "another key for rel": ("rel = 0.1", "sd = 0.1", 'parameters."spring.k": give rel'),
    "bounds reversed": ("max = 20.0", "max = -1.0", 'parameters."spring.d": min 0 must be below max -1'),
    "start out of bounds": ("max = 20.0", "max = 3.0", 'parameters."spring.d": the model\'s value 4 is outside 0 to 3'),
    "bound misspelt": ("max = 20.0", "maxx = 3.0", 'parameters."spring.d": there is no key \'maxx\'; did you mean \'max\'?'),
    "file missing": (TRAIN, 'file = "trian.csv"', "trian.csv'; did you mean 'train.csv'?"),
    "file is a number": (TRAIN, "file = 3", "[[train]] 1: file must be the name of a file in quotes, got 3"),
    "file of another format": (TRAIN, 'file = "train.xls"', "tables end in .csv, .txt, .parquet, .npz, .mat, .at2"),
    "no file": (TRAIN, 'initial = "rest"', '[[train]] 1: file = "..." must be given'),
    "test is train": ('file = "test.csv"', 'file = "train.csv"', "[[test]] 1: 'train.csv' is also [[train]] 1; what was fitted tests nothing"),
    "test overlaps train": (f'{TRAIN}\n[[test]]\nfile = "test.csv"', f"{TRAIN}\nwindow = [0.0, 0.6]\n[[test]]\n{TRAIN}\nwindow = [0.5, 1.0]", "what was fitted tests nothing"),
    "initial": (TRAIN, f'{TRAIN}\ninitial = "fitt"', "initial is 'fit' or 'rest', got 'fitt'; did you mean 'fit'?"),
    "window too short": (TRAIN, f"{TRAIN}\nwindow = [0.2, 0.25]", "train.csv: 11 samples in the window 0.2 to 0.25 s, from 0 to 1 s; at least 32 are needed"),
    "window outside the record": (TRAIN, f"{TRAIN}\nwindow = [5, 9]", "train.csv: 0 samples in the window 5 to 9 s, from 0 to 1 s"),
    "window reversed": (TRAIN, f"{TRAIN}\nwindow = [0.8, 0.1]", "window must be [from, to] in s, from before to, got [0.8, 0.1]"),
    "window is a number": (TRAIN, f"{TRAIN}\nwindow = 3", "window must be [from, to] in s, from before to, got 3"),
    "window misspelt": (TRAIN, f"{TRAIN}\nwindwo = [0.2, 0.9]", "there is no key 'windwo'; did you mean 'window'?"),
    "pieces without samples": (TRAIN, f"{TRAIN}\nshooting = 1e-6", "shooting: pieces of 1e-06 s hold 0.0002 samples at 200 Hz; at least 10 are needed"),
    "pieces from rest": (TRAIN, f'{TRAIN}\nshooting = 0.2\ninitial = "rest"', "shooting needs initial = 'fit'"),
    "offset of an input": (TRAIN, f'{TRAIN}\noffset = ["x"]', "offset: there is no output channel 'x'"),
    "offset is a text": (TRAIN, f'{TRAIN}\noffset = "F"', 'offset must be texts in brackets, such as ["a", "b"], got \'F\''),
    "repeat of an unknown record": (TRAIN, f'{TRAIN}\nrepeat_of = "tset.csv"', "train.csv: repeat_of: no record of the campaign is 'tset.csv'; did you mean 'test.csv'?"),
    "repeat of itself": (TRAIN, f"{TRAIN}\nrepeat_of = \"train.csv\"", "train.csv: repeat_of names the record itself"),
    "repeat of another excitation": (TRAIN, f'{TRAIN}\nrepeat_of = "test.csv"', "train.csv: repeat_of: input 'x' differs from that of 'test.csv' by 141%; repeats have one excitation"),
    "temperature column missing": (TRAIN, f'{TRAIN}\ntemperature = "T"', "train.csv: there is no column 'T'; its columns are time, x, F"),
    "noise of an unknown channel": ("F = 0.01", "G = 0.01", "noise.G: there is no output channel 'G'"),
    "noise zero": ("F = 0.01", "F = 0.0", "noise.F: the standard deviation must be above 0 N, got 0.0"),
    "noise negative": ("F = 0.01", "F = -1", "noise.F: the standard deviation must be above 0 N, got -1"),
    "noise in another unit": ("F = 0.01", "F = 10.0", "noise.F: 10 N is more than all that was measured (2.12 N, standard deviation); correct it or its unit"),
    "stage of an unknown parameter": ("[noise]", '[[stage]]\nparameters = ["spring.kk"]\n[noise]', "[[stage]] 1: parameters: there is no 'spring.kk'; did you mean 'spring.k'?"),
    "stage of an unknown record": ("[noise]", "[[stage]]\ntrain = [2]\n[noise]", "[[stage]] 1: train: there is no '2'; there are 1"),
    "stage of nothing": ("[noise]", "[[stage]]\nchannels = []\n[noise]", "[[stage]] 1: channels must be texts in brackets"),
    "stage with one bracket": ("[noise]", '[stage]\nparameters = ["spring.k"]\n[noise]', "stage must be tables [[stage]]"),
    "filter above the sampling rate": ("[noise]", "[[stage]]\nfilter = { cutoff = 150 }\n[noise]", "[[stage]] 1: filter: cutoff 150 Hz is not below half the sampling rate, 200 Hz"),
    "filter below the record": ("[noise]", "[[stage]]\nfilter = { cutoff = 0.001 }\n[noise]", "filter: cutoff 0.001 Hz has no whole cycle in the 1.005 s of train.csv"),
    "filter misspelt": ("[noise]", "[[stage]]\nfilter = { cutof = 15 }\n[noise]", "filter: there is no key 'cutof'; did you mean 'cutoff'?"),
}  # fmt: skip


@pytest.mark.parametrize(("old", "new", "told"), TEXTS.values(), ids=TEXTS)
def test_what_is_wrong_in_the_file_is_told(folder: Path, old: str, new: str, told: str) -> None:
    assert old in CAMPAIGN
    (folder / "campaign.toml").write_text(CAMPAIGN.replace(old, new))
    refused(folder, told)


def changed(column: int, row: int, value: float) -> str:
    table = [list(line) for line in ROWS]
    table[row][column] = value
    return csv(table)


RECORDS = {
    "empty": ("", "train.csv: the file is empty"),
    "header only": ("time,x,F\n", "train.csv: 0 samples; at least 32 are needed"),
    "too short": (csv(ROWS[:20]), "train.csv: 20 samples, from 0 to 0.095 s; at least 32 are needed"),
    "no header": (csv(header="1,2,3"), "train.csv, line 1: numbers instead of names; put a line of column names on top"),
    "no column of time": (csv(header="when,x,F"), "train.csv: there is no column of time among when, x, F"),
    "duplicate columns": (csv(header="time,x,x"), "train.csv, line 1: two columns are called 'x'; rename one"),
    "text in a column": (csv().replace(f"{ROWS[10][2]:.9g}", "n/a", 1), "train.csv, line 12, column 'F': 'n/a' is no number; correct or remove it"),
    "a cell is empty": (csv().replace(f"{ROWS[10][2]:.9g}", "", 1), "line 12, column 'F': nan is no usable number (1 such in this column); fill or cut it out"),
    "a line is cut": (csv() + "1.005,2\n", "train.csv, line 203: 2 cells under 3 names; complete or cut the line"),
    "not text": (b"\x00\xff\xfe\x81" * 99, "train.csv: not a text file in UTF-8"),
    "NaN": (changed(2, 10, np.nan), "line 12, column 'F': nan is no usable number (1 such"),
    "infinite": (changed(1, 10, np.inf), "line 12, column 'x': inf is no usable number (1 such"),
    "beyond any machine": (changed(2, 10, 1e300), "line 12, column 'F': 1e+300 is beyond any machine; correct it, or the unit of the column"),
    "NaN in time": (changed(0, 10, np.nan), "line 12, column 'time': nan is no usable number (1 such"),
    "unsorted": (changed(0, 10, 0.01), "line 12, column 'time': 0.01 comes after 0.045; sort the lines by time"),
    "an instant twice": (changed(0, 10, ROWS[9][0]), "line 12, column 'time': 0.045 stands there twice (1 such); keep one line of each instant"),
    "a gap": (csv(ROWS[:50] + ROWS[70:]), "line 52, column 'time': a gap of 0.105 s before 0.35 s, where samples are 0.005 s apart"),
    "two sampling rates": (csv([[t if t < 0.5 else 2 * t - 0.5, x, f] for t, x, f in ROWS]), "column 'time': samples are not evenly spaced (0.005 to 0.01 s); resample the record"),
    "saturated sensor": (csv([[t, x, min(f, 1.0)] for t, x, f in ROWS]), "column 'F': stays at 1, an extreme, as if the sensor were saturated; measure with a larger range"),
    "unknown unit": (csv(header="time,x [furlong],F"), "train.csv, line 1, column 'x': there is no unit 'furlong'"),
    "time in millimetres": (csv(header="time [mm],x,F"), "train.csv, line 1, column 'time': 'mm' measures m, the quantity of the model is in s; give one of s, ms, us, min"),
    "a copy of the test record": (csv(rows(3.0)), "[[test]] 1: 'test.csv' is also [[train]] 1"),
}  # fmt: skip


def test_a_coarse_sensor_that_turns_gently_is_not_saturated() -> None:
    """A sine of 320 levels stays at its extremes, and mostly moves by one level."""
    time = np.arange(6000) * 2e-3
    force, other = np.sin(9 * time), np.sin(9 * time + 0.7)
    step = np.ptp(force) / 320
    assert clipped(step * np.round(force / step), [other]) is None
    assert clipped(step * np.round(np.clip(force, -0.8, 0.8) / step), [other]) is not None
    for seed in range(6):  # noise makes steps to and fro where it turns
        noisy = force + 0.2 * step * np.random.default_rng(seed).standard_normal(len(time))
        assert clipped(step * np.round(noisy / step), [other]) is None
        assert clipped(step * np.round(np.clip(noisy, -0.8, 0.8) / step), [other]) is not None


@pytest.mark.parametrize(("content", "told"), RECORDS.values(), ids=RECORDS)
def test_what_is_wrong_in_a_record_is_told(folder: Path, content: str | bytes, told: str) -> None:
    (folder / "train.csv").write_bytes(content if isinstance(content, bytes) else content.encode())
    refused(folder, "[[train]] 1" if "copy" not in told else "", told)


def test_a_dead_sensor_is_told(folder: Path) -> None:
    (folder / "train.csv").write_text(csv([[t, x, 0.0] for t, x, _ in ROWS]))
    refused(folder, "channels.F: it is 0 N throughout all training records; is the sensor connected?")


@pytest.mark.parametrize("ending", [".mat", ".npz", ".parquet"])
def test_a_damaged_file_is_told(folder: Path, ending: str) -> None:
    (folder / f"train{ending}").write_bytes(b"not what it says")
    (folder / "campaign.toml").write_text(CAMPAIGN.replace("train.csv", f"train{ending}"))
    refused(folder, f"train{ending}: cannot be read as a {ending} file")


def test_a_temperature_that_is_missing_at_times_is_told(folder: Path) -> None:
    table = csv([[*row, 20.0 if n != 7 else np.nan] for n, row in enumerate(ROWS)], "time,x,F,T")
    (folder / "train.csv").write_text(table)
    (folder / "campaign.toml").write_text(CAMPAIGN.replace(TRAIN, f'{TRAIN}\ntemperature = "T"'))
    refused(folder, "line 9, column 'T': nan is no usable number")


MODELS = {
    "raises": ('import inertance as ia\ndef build():\n    raise ValueError("no data sheet")\n', "rig.py, line 3: ValueError: no data sheet"),
    "leaves": ("raise SystemExit(3)\n", "rig.py, line 1: the model ends Python (sys.exit(3)); let it return a Network"),
    "does not parse": ("def build(:\n", "rig.py, line 1: SyntaxError"),
    "imports what is not there": ("import inertanse\n", "rig.py, line 1: ModuleNotFoundError: No module named 'inertanse'"),
    "needs arguments": (MODEL.replace("build()", "build(k)"), "TypeError: build() missing 1 required positional argument: 'k'"),
    "returns no network": ("def build():\n    return 1.0\n", "rig.py:build returned float, but model returns a Network"),
    "is no function": ("build = 3\n", "rig.py has no function 'build'"),
    "has a value out of range": (MODEL.replace("m=2.0", "m=-2.0"), "Mass 'mass': m must be above 0 kg, got -2.0"),
    "is not connected": (MODEL.replace("    net.connect(net.spring.flange_b, net.mass.flange)\n", ""), "SpringDamper 'spring': flange_b is not connected"),
    "has two drives at a node": (MODEL.replace("    return", "    net.add(hand=ia.Position())\n    net.connect(net.hand.flange, net.table.flange)\n    return"), "each prescribe the motion of the node of table.flange, spring.flange_a, hand.flange; keep one"),
}  # fmt: skip


@pytest.mark.parametrize(("source", "told"), MODELS.values(), ids=MODELS)
def test_what_is_wrong_in_the_model_is_told(folder: Path, source: str, told: str) -> None:
    (folder / "rig.py").write_text(source)
    refused(folder, told)


def test_all_that_is_wrong_is_told_at_once(folder: Path) -> None:
    text = (
        CAMPAIGN.replace("rel = 0.1", "rel = 0.0").replace('"mm"', '"lbf"').replace("test.csv", "tests.csv")
    )
    (folder / "campaign.toml").write_text(text)
    refused(folder, "channels.x: 'lbf' measures N", "rel must be above 0, got 0", "did you mean 'test.csv'?")


def test_a_campaign_that_is_not_there_is_told(folder: Path) -> None:
    for command in ("fit", "diagnose"):
        done = CliRunner().invoke(app, [command, str(folder / "campaing.toml")])
        assert done.exit_code == 2
        assert "did you mean 'campaign.toml'?" in done.output


def test_nothing_to_fit_is_told(folder: Path) -> None:
    text = CAMPAIGN.replace('"spring.k" = { rel = 0.1 }', "").replace(
        '"spring.d" = { min = 0.0, max = 20.0 }', ""
    )
    (folder / "campaign.toml").write_text(text)
    done = CliRunner().invoke(app, ["fit", str(folder / "campaign.toml")])
    assert done.exit_code == 2
    assert "no parameter is uncertain, so there is nothing to fit" in done.output


FAILING = f"""
import casadi as ca
import inertance as ia

class Cable(ia.Compliant):
    k = ia.parameter("N/m", "stiffness")

    def equations(self):
        yield self.f == self.k * ca.sqrt(1e-3 + self.s_rel)

def build():
{BUILD.replace("    return net", "    net.add(cable=Cable(k=5.0))" + chr(10) + "    net.connect(net.cable.flange_a, net.table.flange)" + chr(10) + "    net.connect(net.cable.flange_b, net.mass.flange)" + chr(10) + "    return net")}
"""


@pytest.mark.parametrize("command", ["fit", "diagnose"])
def test_a_model_that_cannot_be_run_is_told_with_instant_and_state(folder: Path, command: str) -> None:
    (folder / "rig.py").write_text(FAILING)
    done = CliRunner().invoke(app, [command, str(folder / "campaign.toml")])
    assert isinstance(done.exception, SystemExit)
    assert done.exit_code == 1
    assert "Traceback" not in done.output
    assert " s" in done.output


def recorded(frequency: float, until: float = 1.0) -> Record:
    model: dict[str, Callable[[], ia.Network]] = {}
    exec(MODEL, model)
    drive = ia.identification.sampled(Sinusoid(2e-3, frequency), stop=until, rate=200.0, fade=0.3)
    run = model["build"]().simulate(until, step=5e-3, inputs={"table.s_ref": drive})
    force = run["spring.f"] + np.random.default_rng(0).normal(0, 0.01, len(run.time))
    return Record("run", drive.time, {"x": drive.values, "F": force})


def test_what_can_still_be_said_without_a_test_record_is_said(folder: Path) -> None:
    record = recorded(2.0)
    (folder / "train.csv").write_text(csv([[t, 1e3 * x, f] for t, x, f in zip(record.time, record.values["x"], record.values["F"], strict=True)]))  # fmt: skip
    (folder / "campaign.toml").write_text(CAMPAIGN.replace('[[test]]\nfile = "test.csv"\n', ""))
    done = CliRunner().invoke(app, ["fit", str(folder / "campaign.toml")])
    assert done.exit_code == 0
    assert "spring.k" in done.output


def test_a_record_that_cannot_be_run_leaves_the_others_standing(folder: Path) -> None:
    (folder / "rig.py").write_text(FAILING)
    source: dict[str, Any] = {}
    exec(FAILING, source)
    quiet, wild = recorded(2.0), recorded(3.0)
    quiet.values["x"] *= 1e-2
    campaign = Campaign(
        source["build"](),
        channels={"x": {"input": "table.s_ref"}, "F": {"output": "spring.f"}},
        parameters={"spring.k": {"rel": 0.1}},
        train=[{"record": quiet, "initial": "rest"}],
        test=[{"record": Record("wild", wild.time, wild.values), "initial": "rest"}],
    )
    found = ia.fit(campaign, solver="rosenbrock")
    assert found.values["spring.k"] > 0
    assert any(warning.startswith("wild: ") for warning in found.warnings)
