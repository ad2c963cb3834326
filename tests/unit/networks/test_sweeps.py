"""Sweeps: every point once, whatever happens on the way."""

import multiprocessing
import os
import signal
import subprocess
import sys
import textwrap
import time
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
import pandas as pd
import pytest
from inertance.sweeps import SweepInterruptedError


def swing() -> ia.Network:
    strut = ia.parallel(ia.Spring(k=1.0), ia.Damper(d=0.1))
    net = ia.Network("swing", wall=ia.Fixed(), strut=strut, mass=ia.Mass(m=1.0))
    net.connect(net.wall.flange, net.strut.flange_a)
    return net.connect(net.strut.flange_b, net.mass.flange)


def static(dae: ia.DAE, values: dict[str, Any]) -> dict[str, float]:
    """Stiffness of the strut at 2 rad/s, and where it was computed."""
    assert dae.parameter_values["mass.m"] == 1.0
    stiffness = abs(values["strut.spring.k"] + 2j * values["strut.damper.d"])
    return {"stiffness": stiffness, "process": float(os.getpid())}


def square(values: dict[str, Any]) -> float:
    return float(values["x"]) ** 2


def picky(values: dict[str, Any]) -> float:
    if values["x"] == 3:
        raise ValueError("three is too much")
    return float(values["x"])


def fragile(values: dict[str, Any]) -> float:
    """Kill the process that computes 5, the first time; a file remembers."""
    mark = Path(values["mark"])
    if values["x"] == 5 and not mark.exists():
        mark.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return float(values["x"])


def deadly(values: dict[str, Any]) -> float:
    if values["x"] == 5:
        os.kill(os.getpid(), signal.SIGKILL)
    return float(values["x"])


# Designs


def test_a_grid_has_all_combinations() -> None:
    design = ia.sweeps.grid({"a": [1, 2], "b": np.array([0.5, 0.6, 0.7])})
    assert design.points == ((1, 0.5), (1, 0.6), (1, 0.7), (2, 0.5), (2, 0.6), (2, 0.7))


def test_a_latin_hypercube_has_one_point_a_slice() -> None:
    design = ia.sweeps.latin_hypercube({"a": (0.0, 50.0), "b": (-1.0, 1.0)}, 50, seed=3)
    a, b = np.array(design.points).T
    assert sorted(np.floor(a)) == list(range(50))
    assert sorted(np.floor((b + 1) * 25)) == list(range(50))


def test_a_sobol_sequence_is_balanced() -> None:
    points = np.array(ia.sweeps.sobol_sequence({"a": (0.0, 1.0), "b": (0.0, 1.0)}, 64).points)
    for half in (points[:, 0] < 0.5, points[:, 1] < 0.5, (points < 0.5).all(axis=1)):
        assert half.sum() in (32, 16)
    with pytest.raises(ia.ModelError, match="take 128, not 100"):
        ia.sweeps.sobol_sequence({"a": (0.0, 1.0)}, 100)


def test_monte_carlo_follows_its_distributions() -> None:
    from scipy.stats import norm

    points = np.array(ia.sweeps.monte_carlo({"a": norm(5.0, 0.1), "b": (2.0, 3.0)}, 4000, seed=1).points)
    assert points.mean(axis=0) == pytest.approx([5.0, 2.5], abs=0.02)
    assert points.std(axis=0) == pytest.approx([0.1, 1 / np.sqrt(12)], rel=0.05)
    again = np.array(ia.sweeps.monte_carlo({"a": norm(5.0, 0.1), "b": (2.0, 3.0)}, 4000, seed=1).points)
    assert (points == again).all()
    with pytest.raises(ia.ModelError, match="'a': a range is"):
        ia.sweeps.monte_carlo({"a": (3.0, 2.0)}, 5)


# Running


@pytest.mark.parametrize("workers", [0, 2])
def test_every_point_has_its_row_in_order(workers: int) -> None:
    design = ia.sweeps.grid({"strut.spring.k": [1.0, 2.0, 3.0], "strut.damper.d": [0.0, 0.5]})
    done = ia.sweeps.sweep(swing, design, static, workers=workers)
    assert done.table["stiffness"].tolist() == [abs(k + 2j * d) for k, d in design.points]
    assert list(done.table.columns[:2]) == list(design.names)
    assert (os.getpid() in done.table["process"].tolist()) == (workers == 0)
    assert done.table.index.tolist() == list(range(6))
    assert done.table["error"].tolist() == [""] * len(done.table)


def test_a_network_is_simulated_at_every_point() -> None:
    def last(dae: ia.DAE, values: dict[str, Any]) -> float:
        return float(ia.simulate(dae, 1.0, parameters=values, start={"mass.s": 1.0})["mass.s"][-1])

    done = ia.sweeps.sweep(swing(), {"mass.m": [0.5, 1.0, 2.0], "strut.damper.d": [0.0]}, last, workers=0)
    expected = [np.cos(1 / np.sqrt(m)) for m in (0.5, 1.0, 2.0)]
    assert done.table["value"].to_numpy() == pytest.approx(expected, abs=1e-5)


def test_a_model_is_named_by_file_and_function(tmp_path: Path) -> None:
    text = """
        import inertance as ia
        def build():
            net = ia.Network("n", wall=ia.Fixed(), spring=ia.Spring(k=7.0), mass=ia.Mass(m=1.0))
            net.connect(net.wall.flange, net.spring.flange_a)
            return net.connect(net.spring.flange_b, net.mass.flange)
    """
    file = tmp_path / "model.py"
    file.write_text(textwrap.dedent(text))

    def stiffness(dae: ia.DAE, values: dict[str, Any]) -> float:
        return dae.parameter_values["spring.k"] * float(values["mass.m"])

    done = ia.sweeps.sweep(f"{file}:build", {"mass.m": [1.0, 2.0]}, stiffness, workers=0)
    assert done.table["value"].tolist() == [7.0, 14.0]
    with pytest.raises(ia.ModelError, match="has no function 'biuld'"):
        ia.sweeps.sweep(f"{file}:biuld", {"mass.m": [1.0]}, stiffness)


def test_an_error_is_a_row() -> None:
    done = ia.sweeps.sweep(None, {"x": [1, 2, 3, 4]}, picky, workers=0)
    assert done.table["error"].tolist() == ["", "", "ValueError: three is too much", ""]
    assert done.failed.index.tolist() == [2]
    assert np.isnan(done.table["value"][2])


def noted_swing(mark: Path) -> ia.Network:
    with mark.open("a") as file:
        file.write("assembled\n")
    return swing()


def test_forked_processes_take_over_the_equations(tmp_path: Path) -> None:
    if multiprocessing.get_start_method() != "fork":
        pytest.skip("processes are started anew here")
    mark = tmp_path / "mark"
    design = ia.sweeps.grid({"strut.spring.k": np.linspace(1, 9, 30), "strut.damper.d": [0.1]})
    done = ia.sweeps.sweep(partial(noted_swing, mark), design, static, workers=2)
    assert not len(done.failed)
    assert mark.read_text().splitlines() == ["assembled"]


def test_unknown_parameters_are_told_at_once() -> None:
    with pytest.raises(ia.ModelError, match=r"did you mean 'strut\.spring\.k'"):
        ia.sweeps.sweep(swing(), {"strut.spring.kk": [1.0]}, static)


def test_points_given_twice_are_computed_once() -> None:
    seen: list[float] = []

    def noted(values: dict[str, Any]) -> float:
        seen.append(values["x"])
        return float(values["x"])

    done = ia.sweeps.sweep(None, {"x": [1.0, 2.0, 1.0]}, noted, workers=0)
    assert seen == [1.0, 2.0]
    assert done.table["value"].tolist() == [1.0, 2.0, 1.0]


def test_an_executor_of_ones_own() -> None:
    with ThreadPoolExecutor(2) as executor:
        done = ia.sweeps.sweep(None, {"x": range(50)}, square, executor=executor)
    assert done.table["value"].tolist() == [n**2 for n in range(50)]
    with pytest.raises(ia.ModelError, match="an executor is one of"):
        ia.sweeps.sweep(None, {"x": range(5)}, square, executor=object())


# What goes wrong on the way


def test_points_of_a_killed_process_are_done_again(tmp_path: Path) -> None:
    design = ia.sweeps.grid({"mark": [str(tmp_path / "mark")], "x": range(40)})
    done = ia.sweeps.sweep(None, design, fragile, workers=2, path=tmp_path / "out.csv")
    assert (tmp_path / "mark").exists()
    assert done.table["value"].tolist() == list(range(40))
    assert len(pd.read_csv(tmp_path / "out.csv")["key"].unique()) == 40


def test_a_point_that_kills_its_process_is_found() -> None:
    done = ia.sweeps.sweep(None, {"x": range(20)}, deadly, workers=2)
    assert done.failed.index.tolist() == [5]
    assert "died 2 times" in done.table["error"][5]
    assert done.table["value"].drop(5).tolist() == [n for n in range(20) if n != 5]


@pytest.mark.parametrize("ending", ["csv", "parquet"])
def test_a_sweep_goes_on_where_it_stopped(tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"out.{ending}"
    seen = tmp_path / "seen"
    seen.touch()
    values = [1 / 3, 2.0, 3, 4.0, 5.0]

    def noted(values: dict[str, Any]) -> float:
        with seen.open("a") as file:
            file.write(f"{values['x']}\n")
        if values["x"] == 4.0 and len(seen.read_text().splitlines()) == 4:
            raise KeyboardInterrupt
        return 1 / float(values["x"])

    with pytest.raises(SweepInterruptedError, match="3 of 5 points are done") as caught:
        ia.sweeps.sweep(None, {"x": values}, noted, workers=0, path=path)
    assert len(caught.value.sweep.table) == 3
    done = ia.sweeps.sweep(None, {"x": values}, noted, workers=0, path=path)
    assert done.resumed == 3
    assert done.table["value"].tolist() == [1 / x for x in values]
    assert [float(line) for line in seen.read_text().split()] == [1 / 3, 2.0, 3.0, 4.0, 4.0, 5.0]
    more = ia.sweeps.sweep(None, {"x": [*values, 8.0]}, noted, workers=0, path=path)
    assert (more.resumed, more.table["value"].iloc[-1]) == (5, 0.125)
    assert sorted(p.name for p in tmp_path.iterdir()) == [f"out.{ending}", "seen"]


def test_a_file_of_another_sweep_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "out.csv"
    ia.sweeps.sweep(None, {"x": [1.0]}, square, workers=0, path=path)
    with pytest.raises(ia.ModelError, match="holds another sweep"):
        ia.sweeps.sweep(None, {"x": [1.0]}, picky, workers=0, path=path)
    with pytest.raises(ia.ModelError, match=r"go to \.parquet or \.csv"):
        ia.sweeps.sweep(None, {"x": [1.0]}, square, workers=0, path=tmp_path / "out.npz")


def test_errors_are_kept_and_read_back(tmp_path: Path) -> None:
    path = tmp_path / "out.parquet"
    first = ia.sweeps.sweep(None, {"x": [1, 2, 3, 4]}, picky, workers=0, path=path)
    again = ia.sweeps.sweep(None, {"x": [1, 2, 3, 4]}, picky, workers=0, path=path)
    assert again.resumed == 4
    pd.testing.assert_frame_equal(first.table, again.table)


HANGING = 120.0
SCRIPT = """
import pathlib, sys, time
import inertance as ia

def slow(values):
    while values["x"] > 20 and not pathlib.Path(sys.argv[2]).exists():
        time.sleep(0.05)
    return values["x"] + 0.5

if __name__ == "__main__":
    done = ia.sweeps.sweep(None, {"x": range(120)}, slow, workers=2, path=sys.argv[1])
    print(done.resumed, done.table["value"].tolist() == [n + 0.5 for n in range(120)])
"""


@pytest.fixture
def script(tmp_path: Path) -> list[str]:
    file = tmp_path / "script.py"
    file.write_text(SCRIPT)
    return [sys.executable, str(file), str(tmp_path / "out.csv"), str(tmp_path / "again")]


def _is_alive(group: int) -> bool:
    """Tell whether a process of a group is left."""
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    return True


def stopped_by(how: int, script: list[str]) -> int:
    """Stop a sweep once some rows are in its journal; return how many were there."""
    journal = Path(f"{script[2]}.journal")
    running = subprocess.Popen(script, stderr=subprocess.DEVNULL, start_new_session=True)
    until = time.monotonic() + HANGING
    while not (journal.exists() and len(journal.read_text().splitlines()) > 3):
        assert time.monotonic() < until
        assert running.poll() is None
        time.sleep(0.01)
    running.send_signal(how)
    assert running.wait(HANGING) != 0
    while _is_alive(running.pid):
        assert time.monotonic() < until
        time.sleep(0.01)
    file = Path(script[2]) if how == signal.SIGINT else journal
    return len(file.read_text().splitlines()) - (how == signal.SIGINT)


@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGKILL])
def test_nothing_done_is_lost_when_the_sweep_is_stopped(script: list[str], how: int) -> None:
    kept = stopped_by(how, script)
    assert 3 < kept <= 21
    Path(script[3]).touch()
    told = subprocess.run(script, capture_output=True, text=True, check=True).stdout
    assert told.split() == [str(kept), "True"]


# Engines and indices


def test_dask_with_a_killed_worker(tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed", reason="needs dask.distributed")
    import warnings

    def fragile_too(values: dict[str, Any]) -> float:  # sent as code: its file is not on the workers' path
        mark = Path(values["mark"])
        if values["x"] == 5 and not mark.exists():
            mark.touch()
            os.kill(os.getpid(), signal.SIGKILL)
        return float(values["x"])

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        cluster = distributed.LocalCluster(
            n_workers=3, threads_per_worker=1, processes=True, dashboard_address=None, silence_logs=50
        )
        with cluster, distributed.Client(cluster) as client:
            design = ia.sweeps.grid({"mark": [str(tmp_path / "mark")], "x": range(60)})
            done = ia.sweeps.sweep(None, design, fragile_too, executor=client, path=tmp_path / "out.csv")
    assert (tmp_path / "mark").exists()
    assert done.table["value"].tolist() == list(range(60))
    assert len(pd.read_csv(tmp_path / "out.csv")) == 60


def ishigami(values: dict[str, Any]) -> float:
    x1, x2, x3 = values.values()
    return float(np.sin(x1) + 7 * np.sin(x2) ** 2 + 0.1 * x3**4 * np.sin(x1))


def test_sobol_indices_of_the_ishigami_function() -> None:
    pytest.importorskip("SALib", reason="needs SALib")
    design = ia.sweeps.saltelli(dict.fromkeys(("x1", "x2", "x3"), (-np.pi, np.pi)), 2048, seed=1)
    assert len(design) == 2048 * 5
    indices = ia.sweeps.sobol_indices(ia.sweeps.sweep(None, design, ishigami, workers=0))
    variance = 49 / 8 + 0.1 * np.pi**4 / 5 + 0.01 * np.pi**8 / 18 + 0.5
    v1, v13 = 0.5 * (1 + 0.1 * np.pi**4 / 5) ** 2, 0.01 * np.pi**8 * (1 / 18 - 1 / 50)
    assert indices["S1"].tolist() == pytest.approx([v1 / variance, 49 / 8 / variance, 0.0], abs=0.03)
    assert indices["ST"].tolist() == pytest.approx(
        [(v1 + v13) / variance, 49 / 8 / variance, v13 / variance], abs=0.03
    )
    with pytest.raises(ia.ModelError, match="points of saltelli"):
        ia.sweeps.sobol_indices(ia.sweeps.sweep(None, {"x": [1.0]}, square, workers=0))


# Files


def test_a_sweep_that_ended_before_its_first_row_can_be_resumed(tmp_path: Path) -> None:
    def interrupted(values: dict[str, Any]) -> float:
        if not (tmp_path / "again").exists():
            raise KeyboardInterrupt
        return float(values["x"])

    with pytest.raises(SweepInterruptedError, match="0 of 3 points"):
        ia.sweeps.sweep(None, {"x": [1.0, 2.0, 3.0]}, interrupted, workers=0, path=tmp_path / "o.csv")
    (tmp_path / "again").touch()
    done = ia.sweeps.sweep(None, {"x": [1.0, 2.0, 3.0]}, interrupted, workers=0, path=tmp_path / "o.csv")
    assert done.table["value"].tolist() == [1.0, 2.0, 3.0]


def test_two_sweeps_do_not_write_one_file(tmp_path: Path) -> None:
    path = tmp_path / "o.csv"

    def nested(values: dict[str, Any]) -> float:
        with pytest.raises(ia.ModelError, match=r"o\.csv' is being written by another process"):
            ia.sweeps.sweep(None, {"x": [1.0]}, square, workers=0, path=path)
        return float(values["x"])

    done = ia.sweeps.sweep(None, {"x": [1.0, 2.0]}, nested, workers=0, path=path)
    assert done.table["value"].tolist() == [1.0, 2.0]
    assert [file.name for file in tmp_path.iterdir()] == ["o.csv"]


FULL = """
import resource, sys
import inertance as ia

resource.setrlimit(resource.RLIMIT_FSIZE, (1500, 1500))  # as a disk that is full after 1500 bytes


def square(values):
    return values["x"] ** 2


try:
    ia.sweeps.sweep(None, {"x": range(200)}, square, workers=0, path=sys.argv[1], progress=False)
except ia.InertanceError as error:
    print(error)
"""


def test_a_full_disk_is_told_by_name_and_costs_no_rows(tmp_path: Path) -> None:
    path = tmp_path / "o.csv"
    script = [sys.executable, "-c", FULL, str(path)]
    told = subprocess.run(script, capture_output=True, text=True, check=True).stdout
    assert f"'{path}" in told
    assert "cannot be written: file too large" in told
    (kept,) = tmp_path.iterdir()  # the table, or the journal where that is too long for it
    assert len(kept.read_text().splitlines()) > 3
    resumed = subprocess.run(
        [sys.executable, "-c", FULL.replace("resource.set", "# resource.set"), str(path)],
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert resumed.stdout == ""
    table = pd.read_csv(path)
    assert table["value"].tolist() == [x**2 for x in table["x"]]
    assert len(table) == 200
    assert [file.name for file in tmp_path.iterdir()] == ["o.csv"]
