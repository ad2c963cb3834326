"""Progress: a bar where somebody looks, of the outermost computation, gone at the end."""

import sys
import types
from typing import Any

import inertance as ia
import pytest
from inertance.networks.simulation.progress import Progress
from inertance.sweeps import sweep


@pytest.fixture
def cell(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Return what a notebook's cell shows, one after the other."""
    told: list[str] = []
    shell = type("ZMQInteractiveShell", (), {})()
    showing = types.SimpleNamespace(update=told.append)
    ipython, inner = types.ModuleType("IPython"), types.ModuleType("IPython.display")
    vars(ipython)["get_ipython"] = lambda: shell
    vars(inner).update(HTML=str, display=lambda html, display_id: showing)
    monkeypatch.setitem(sys.modules, "IPython", ipython)
    monkeypatch.setitem(sys.modules, "IPython.display", inner)
    return told


def test_a_notebook_shows_a_bar_that_fills_and_goes(cell: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    now = 0.0
    monkeypatch.setattr("time.perf_counter", lambda: now)
    with Progress("<run>", 1.0, 5.0, None) as show:
        show.at(1.5)
        assert cell == []  # not before a second
        now = 1.5
        show.at(2.0)
        now = 4.5
        show.at(3.0)
    assert "&lt;run&gt;" in cell[0]
    assert 'value="0.2500"' in cell[0]
    assert "2.00/4.00 s simulated, 3 s left" in cell[1]
    assert cell[2:] == [""]


def test_nothing_is_shown_where_nobody_looks(capsys: pytest.CaptureFixture[str]) -> None:
    with Progress("run", 0.0, 1.0, None) as show:
        assert not show.wanted
    assert Progress.outermost is None


def test_a_sweep_shows_one_bar_and_none_of_its_runs(cell: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    ticks = iter(range(10**6))
    monkeypatch.setattr("time.perf_counter", lambda: float(next(ticks)))
    net = ia.Network("swing", wall=ia.Fixed(), spring=ia.Spring(k=90.0), mass=ia.Mass(m=1.0, s=0.1))
    net.connect(net.wall.flange, net.spring.flange_a).connect(net.spring.flange_b, net.mass.flange)

    def last(dae: ia.DAE, values: dict[str, Any]) -> float:
        return float(ia.simulate(dae, 1.0, parameters=values)["mass.s"][-1])

    sweep(net, {"spring.k": [80.0, 90.0]}, last, workers=0)
    assert cell
    assert all("points" in html for html in cell[:-1])
    assert Progress.outermost is None


def test_a_run_that_fails_leaves_no_bar(cell: list[str]) -> None:
    with pytest.raises(ia.SimulationError), Progress("run", 0.0, 1.0, True):
        raise ia.SimulationError("over")
    assert Progress.outermost is None
