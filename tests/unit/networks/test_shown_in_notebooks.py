"""What notebooks show of linear systems, tunings, sweeps, fits, starts and figures; patterns of names."""

import re
from collections.abc import Mapping
from html.parser import HTMLParser
from typing import Any

import inertance as ia
import matplotlib as mpl
import numpy as np
import pytest
from inertance.analysis import StateSpace, linearise, plot_modes, tune
from inertance.identification import Campaign, Record
from inertance.sweeps import sweep
from matplotlib import pyplot


class Cells(HTMLParser):
    """Gathers the rows of tables; fails on a tag that is closed out of order."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.rows: list[list[str]] = []

    def handle_starttag(self, tag: str, attrs: Any) -> None:
        self.open.append(tag)
        if tag == "tr":
            self.rows.append([])
        elif tag in ("td", "th"):
            self.rows[-1].append("")

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if self.open[-1] in ("td", "th"):
            self.rows[-1][-1] += data


def rows(thing: Any) -> list[list[str]]:
    """Return the rows of the tables that a notebook shows of something."""
    cells = Cells()
    cells.feed(thing._repr_html_())
    cells.close()
    assert cells.open == []
    return cells.rows


def oscillator(k: float = 100.0) -> ia.Network:
    net = ia.Network(
        "a < b", wall=ia.Fixed(), spring=ia.Spring(k=k), damper=ia.Damper(d=2.0), mass=ia.Mass(m=1.0),
        push=ia.Force(),
    )  # fmt: skip
    net.connect(net.wall.flange, net.spring.flange_a, net.damper.flange_a)
    return net.connect(net.spring.flange_b, net.damper.flange_b, net.mass.flange, net.push.flange)


def test_a_linear_system_shows_its_poles_once_a_pair() -> None:
    """w_0 = 10 rad/s, zeta = 0.1."""
    head, pole = rows(linearise(oscillator(), inputs=["push.f"], outputs=["mass.s"]))
    assert head == ["pole [rad/s]", "frequency [Hz]", "damping ratio"]
    assert pole == ["-1+9.9499j", f"{10 / (2 * np.pi):.4g}", "0.1"]


def test_an_integrator_and_many_poles_are_shown() -> None:
    one, none = np.eye(1), np.zeros((1, 1))
    assert rows(StateSpace(none, one, one, none))[1] == ["0+0j", "0", "-"]
    many = StateSpace(-np.diag(np.arange(1.0, 31.0)), np.ones((30, 1)), np.ones((1, 30)), none)
    assert len(rows(many)) == 21
    assert "and 10 more" in many._repr_html_()


def test_a_tuning_shows_values_and_which_are_at_a_bound() -> None:
    def measure(dae: Any, *, parameters: Mapping[str, float]) -> float:
        return (parameters["spring.k"] - 50.0) ** 2 + parameters["damper.d"]

    found = tune(oscillator(), measure, {"spring.k": (10.0, 90.0), "damper.d": (1.0, 5.0)}, starts=1)
    assert rows(found)[1:] == [["spring.k", "50", ""], ["damper.d", "1", "at a bound"]]


def test_a_sweep_shows_its_first_rows() -> None:
    done = sweep(oscillator(), {"spring.k": np.linspace(1.0, 30.0, 30)}, stiffness, workers=1)
    head, first, *others = rows(done)
    assert head[:2] == ["spring.k", "stiffness"]
    assert first[:2] == ["1", "2"]
    assert len(others) == 19
    assert "30 of 30 points, 0 failed" in done._repr_html_()
    assert "and 10 more" in done._repr_html_()


def stiffness(dae: Any, parameters: dict[str, float]) -> dict[str, float]:
    return {"stiffness": 2 * parameters["spring.k"]}


def test_a_fit_shows_what_its_table_tells() -> None:
    time = np.arange(0, 5, 0.02)
    push = np.sin(7 * time) * 10
    inputs = {"push.f": ia.Sampled(time, push)}
    run = oscillator(130.0).simulate(time[-1], step=0.02, inputs=inputs, start={"mass.s": 0.0})
    record = Record("one & only", time, {"F": push, "x": np.interp(time, run.time, run["mass.s"])})
    channels = {"F": {"input": "push.f"}, "x": {"output": "mass.s"}}
    campaign = Campaign(
        oscillator(), channels=channels, parameters={"spring.k": {"rel": 0.5}}, train=[{"record": record}],
        noise={"x": 1e-4},
    )  # fmt: skip
    found = ia.fit(campaign)
    shown = rows(found)
    assert shown[0] == ["parameter", "fitted", "std. error", "started at", "unit"]
    assert shown[1][0] == "spring.k"
    assert float(shown[1][1]) == pytest.approx(130.0, rel=1e-3)
    assert shown[3][0] == "one & only"
    for row in shown:
        assert re.search(r"\s+".join(map(re.escape, filter(None, row))), found.table())


def test_start_values_are_a_table() -> None:
    run = oscillator().simulate(0.1, inputs={"push.f": 0.0}, start={"mass.v": -1.5, "mass.s": 0.25})
    head, *told = [line.split() for line in str(run.initial).splitlines()]
    assert head == ["state", "start", "unit", "decided"]
    assert sorted(told) == [["mass.s", "0.25", "m", "fixed"], ["mass.v", "-1.5", "m/s", "fixed"]]
    assert sorted(rows(run.initial)[1:]) == sorted(told)


@pytest.fixture
def run() -> ia.Result:
    return oscillator().simulate(0.5, inputs={"push.f": 0.0})


def figures(run: ia.Result) -> list[Any]:
    system = linearise(oscillator(), inputs=["push.f"], outputs=["mass.s"])
    return [run.plot("mass.s"), system.plot_bode(), system.plot_nyquist(), plot_modes(system.modes())]


def test_a_figure_is_shown_once(run: ia.Result, monkeypatch: pytest.MonkeyPatch) -> None:
    """As the value of a cell it is no more among those that pyplot shows at the end of the cell."""
    mpl.use("Agg")
    drawn, count = figures(run), len(pyplot.get_fignums())
    assert count >= len(drawn)
    for figure in drawn:
        with pytest.raises(NotImplementedError):  # so a notebook shows it as any figure
            figure._ipython_display_()
    assert len(pyplot.get_fignums()) == count
    monkeypatch.setattr(pyplot, "get_backend", lambda: "module://matplotlib_inline.backend_inline")
    for figure in drawn:
        with pytest.raises(NotImplementedError):
            figure._ipython_display_()
    assert len(pyplot.get_fignums()) == count - len(drawn)


def test_patterns_name_signals_at_equal_steps(run: ia.Result) -> None:
    table = run.resample(0.1, "mass.*", "spring.f", "mass.s")
    assert sorted(table.columns) == [
        "mass.a",
        "mass.flange.f",
        "mass.flange.s",
        "mass.kinetic",
        "mass.s",
        "mass.v",
        "spring.f",
    ]
    assert table.attrs["units"]["mass.v"] == "m/s"
    recorded = ia.Recorded(run.to_dataframe("mass.s", "mass.v", "spring.f"))
    assert list(recorded.resample(0.1, "mass.*").columns) == ["mass.s", "mass.v"]
    assert "time" not in run.resample(0.1, "*").columns
    for signals in (run, recorded):
        with pytest.raises(ia.UnknownNameError, match=r"has no variable like 'rotor\.\*'"):
            signals.resample(0.1, "rotor.*")
