"""Files of results: what is read back is what was saved, units included."""

import importlib.util
from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
import pytest

ENDINGS = pytest.mark.parametrize("ending", [".csv", ".parquet", ".npz", ".CSV"])


@pytest.fixture(scope="module")
def run() -> ia.Result:
    net = ia.Network("swing", wall=ia.Fixed(), spring=ia.Spring(k=100.0), mass=ia.Mass(m=3.0))
    net.connect(net.wall.flange, net.spring.flange_a)
    net.connect(net.mass.flange, net.spring.flange_b)
    return net.simulate(2.0, start={"mass.s": 0.1}, step=0.1)


@ENDINGS
def test_numbers_and_units_come_back_exactly(run: ia.Result, tmp_path: Path, ending: str) -> None:
    names = ("mass.s", "mass.a", "spring.f", "spring.k")
    path = run.save(tmp_path / f"run{ending}", *names)
    table = ia.load_table(path)
    assert list(table.columns) == list(names)
    assert table.attrs["units"] == {"mass.s": "m", "mass.a": "m/s2", "spring.f": "N", "spring.k": "N/m"}
    assert table.index.name == "time"
    assert np.array_equal(table.index, run.time)
    assert all(np.array_equal(table[name], run[name]) for name in names)


@ENDINGS
def test_states_are_saved_when_nothing_is_named(run: ia.Result, tmp_path: Path, ending: str) -> None:
    table = ia.load_table(run.save(str(tmp_path / f"run{ending}")))
    assert list(table.columns) == run.dae.state_names


def test_a_star_stands_for_any_part_of_a_name(run: ia.Result, tmp_path: Path) -> None:
    table = ia.load_table(run.save(tmp_path / "run.csv", "mass.flange.*", "spring.f"))
    assert list(table.columns) == ["mass.flange.s", "mass.flange.f", "spring.f"]


def test_instants_before_and_after_an_event_are_both_kept(tmp_path: Path) -> None:
    net = ia.Network("ball", ground=ia.Fixed(), stop=ia.HardStop(e=0.5), ball=ia.Mass(m=1.0, s=1.0, v=-1.0))
    net.connect(net.ground.flange, net.stop.flange_a)
    net.connect(net.stop.flange_b, net.ball.flange)
    run = net.simulate(2.0)
    table = ia.load_table(run.save(tmp_path / "run.parquet", "ball.v", "stop.mode"))
    assert table["ball.v"].loc[run.events[0].time].tolist() == pytest.approx([-1.0, 0.5])
    assert table.attrs["units"]["stop.mode"] == ""


def test_csv_is_plain(run: ia.Result, tmp_path: Path) -> None:
    lines = run.save(tmp_path / "run.csv", "mass.s").read_text().splitlines()
    assert lines[0] == "time [s],mass.s [m]"
    assert lines[1] == "0.0,0.1"
    assert len(lines) == 1 + len(run.time)


def test_refusals_when_saving(run: ia.Result, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"ends in '\.xlsx'; tables end in \.csv, \.parquet, \.npz"):
        run.save(tmp_path / "run.xlsx")
    with pytest.raises(FileNotFoundError, match=r"no folder .*nowhere' to write 'run\.csv' into"):
        run.save(tmp_path / "nowhere" / "run.csv")
    with pytest.raises(KeyError, match=r"did you mean 'mass\.s'"):
        run.save(tmp_path / "run.csv", "mas.s")
    assert not list(tmp_path.iterdir())


def test_parquet_without_pyarrow(run: ia.Result, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    find = importlib.util.find_spec

    def without_pyarrow(name: str, *rest: Any) -> Any:
        return None if name == "pyarrow" else find(name, *rest)

    monkeypatch.setattr("inertance.base.tables.find_spec", without_pyarrow)
    with pytest.raises(ModuleNotFoundError, match=r"pip install 'inertance\[parquet\]'"):
        run.save(tmp_path / "run.parquet")


def test_measured_csv(tmp_path: Path) -> None:
    """As a spreadsheet writes it: a byte order mark, spaces, no units, blank lines at the end."""
    path = tmp_path / "measured.csv"
    path.write_bytes(b"\xef\xbb\xbftime, force [kN] ,x\r\n0, 1,nan\r\n0.5, 2.25,3\r\n\r\n")
    table = ia.load_table(path)
    assert table.attrs["units"] == {"force": "kN", "x": ""}
    assert table.index.tolist() == [0.0, 0.5]
    assert table["force"].tolist() == [1.0, 2.25]
    assert np.isnan(table["x"].iloc[0])


@pytest.mark.parametrize(
    "text",
    [
        "# bench 3\nt;force (kN);x\n0;1;\n0,5;2,25;3\n",
        'Time [s]\t"force [kN]"\tx\n0\t1\t\n0.5\t2.25\t3\n',
        "time, force [kN], x\n0, 1,\n0.5, 2.25, 3\n",
    ],
    ids=["semicolons", "tabs", "commas"],
)
def test_csv_of_any_country(tmp_path: Path, text: str) -> None:
    path = tmp_path / "measured.csv"
    path.write_text(text)
    table = ia.load_table(path)
    assert table.attrs["units"] == {"force": "kN", "x": ""}
    assert table.index.tolist() == [0.0, 0.5]
    assert table["force"].tolist() == [1.0, 2.25]
    assert np.isnan(table["x"].iloc[0])
    assert table["x"].iloc[1] == 3.0


def test_time_in_another_unit_is_converted(tmp_path: Path) -> None:
    path = tmp_path / "measured.csv"
    path.write_text("time [ms],x [g]\n0,1\n500,2\n")
    table = ia.load_table(path)
    assert (table.index.tolist(), table.attrs["units"]) == ([0.0, 0.5], {"x": "g"})


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "the file is empty"),
        ("when,x\n0,1\n", "no column of time among when, x; name one 'time'"),
        ("time [mm],x\n0,1\n", r"line 1, column 'time': 'mm' measures m, .* in s; give one of s, ms, us"),
        ("time,x [m],x [m]\n0,1,2\n", "line 1: two columns are called 'x'"),
        ("time,x\n0,1\n1,abc\n", "line 3, column 'x': 'abc' is no number"),
        ("time;x\n0;1\n1;1,5,2\n", "line 3, column 'x': '1,5,2' is no number"),
        ("time,x\n0,1\n\n1,2\n", "line 3: 0 cells under 2 names"),
        ("time,x\n0,1,2\n", "line 2: 3 cells under 2 names"),
    ],
)
def test_bad_csv_is_told_by_line_and_column(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "bad.csv"
    path.write_text(text)
    with pytest.raises(ValueError, match=message) as told:
        ia.load_table(path)
    assert str(path) in str(told.value)


def test_other_bad_files(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match=r"there is no file '.*none\.csv'"):
        ia.load_table(tmp_path / "none.csv")
    with pytest.raises(ValueError, match=r"ends in '\.xlsx'; tables end in \.csv, \.txt"):
        ia.load_table(tmp_path / "none.xlsx")
    (tmp_path / "binary.csv").write_bytes(b"time,x\n\xff\xfe,1\n")
    with pytest.raises(ValueError, match="not a text file in UTF-8"):
        ia.load_table(tmp_path / "binary.csv")
    np.savez(tmp_path / "other.npz", time="noon")
    with pytest.raises(ValueError, match="there are no columns of numbers in it, only time"):
        ia.load_table(tmp_path / "other.npz")
    for broken in ("broken.npz", "broken.parquet"):
        (tmp_path / broken).write_bytes(b"not what the name says")
        with pytest.raises(ValueError, match=f"{broken}: cannot be read"):
            ia.load_table(tmp_path / broken)


def test_foreign_parquet(tmp_path: Path) -> None:
    pandas = pytest.importorskip("pandas")
    foreign = pandas.DataFrame({"time": [0.0, 1.0], "x": [2.0, 3.0]})
    foreign.to_parquet(tmp_path / "foreign.parquet")
    table = ia.load_table(tmp_path / "foreign.parquet")
    assert table["x"].to_dict() == {0.0: 2.0, 1.0: 3.0}
    assert table.attrs["units"] == {"x": ""}
    foreign[["x"]].to_parquet(tmp_path / "timeless.parquet")
    with pytest.raises(ValueError, match="no column of time among x"):
        ia.load_table(tmp_path / "timeless.parquet")
