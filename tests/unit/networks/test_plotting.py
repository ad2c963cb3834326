"""Plots: what is drawn is what was computed, in panels by unit."""

from collections.abc import Iterator

import inertance as ia
import matplotlib as mpl
import numpy as np
import pytest
from matplotlib import pyplot
from matplotlib.collections import LineCollection

mpl.use("Agg")


@pytest.fixture(scope="module")
def run() -> ia.Result:
    net = ia.Network(
        "rubbing",
        wall=ia.Fixed(),
        spring=ia.Spring(k=100.0),
        rub=ia.CoulombFriction(f_c=1.0),
        mass=ia.Mass(m=1.0),
    )
    net.connect(net.wall.flange, net.spring.flange_a, net.rub.flange_a)
    net.connect(net.mass.flange, net.spring.flange_b, net.rub.flange_b)
    return net.simulate(2.0, start={"mass.s": 0.1})


def chain(length: int) -> ia.Network:
    net = ia.Network("chain", mass_0=ia.Mass(m=1.0, s=1.0))
    for i in range(1, length):
        net.add(**{f"spring_{i}": ia.Spring(k=1.0), f"mass_{i}": ia.Mass(m=1.0)})
        spring = getattr(net, f"spring_{i}")
        net.connect(getattr(net, f"mass_{i - 1}").flange, spring.flange_a)
        net.connect(spring.flange_b, getattr(net, f"mass_{i}").flange)
    return net


@pytest.fixture(autouse=True)
def closed() -> Iterator[None]:
    yield
    pyplot.close("all")


def test_signals_of_one_unit_share_a_panel(run: ia.Result) -> None:
    figure = run.plot("mass.s", "spring.f", "mass.v", "rub.f", "mass.a")
    assert [ax.get_ylabel() for ax in figure.axes] == ["[m]", "[N]", "[m/s]", "[m/s²]"]
    assert [line.get_label() for line in figure.axes[1].lines] == ["spring.f", "rub.f"]


def test_lines_are_the_signals(run: ia.Result) -> None:
    line = run.plot("rub.f").axes[0].lines[0]
    assert np.array_equal(line.get_xdata(), run.time)
    assert np.array_equal(line.get_ydata(), run["rub.f"])


def test_events_are_marked_where_they_happen(run: ia.Result) -> None:
    marks = [c for c in run.plot("mass.s").axes[0].collections if isinstance(c, LineCollection)]
    drawn = [segment[0][0] for segment in marks[0].get_segments()]
    assert drawn == sorted({event.time for event in run.events})
    assert len(drawn) > 3


def test_a_smooth_run_has_no_marks() -> None:
    assert not chain(2).simulate(1.0).plot("mass_0.s").axes[0].collections


def test_a_mode_has_a_panel_with_its_names(run: ia.Result) -> None:
    _, panel = run.plot("mass.s", "rub.mode").axes
    assert [tick.get_text() for tick in panel.get_yticklabels()] == ["stuck", "forward", "backward"]


def test_states_are_drawn_when_nothing_is_named(run: ia.Result) -> None:
    labels = [line.get_label() for ax in run.plot().axes for line in ax.lines]
    assert labels == run.dae.state_names


def test_a_star_stands_for_any_part_of_a_name(run: ia.Result) -> None:
    labels = [line.get_label() for ax in run.plot("*.flange_a.f").axes for line in ax.lines]
    assert labels == ["spring.flange_a.f", "rub.flange_a.f"]


def test_many_signals_are_named_by_first_and_last() -> None:
    ax = chain(20).simulate(1.0).plot("mass_*.v").axes[0]
    assert ax.get_legend() is None
    assert ax.get_title() == "20 signals, mass_0.v to mass_19.v"


def test_given_axes_are_drawn_on(run: ia.Result) -> None:
    figure, axes = pyplot.subplots(2)
    assert run.plot("mass.s", "mass.v", axes=axes) is figure
    assert [len(ax.lines) for ax in axes] == [1, 1]
    figure, single = pyplot.subplots()
    assert run.plot("mass.s", axes=single) is figure


def test_wrong_number_of_axes(run: ia.Result) -> None:
    _, single = pyplot.subplots()
    with pytest.raises(ValueError, match=r"need 2 axes, .* \(mass\.s; mass\.v\), got 1"):
        run.plot("mass.s", "mass.v", axes=single)


def test_unknown_signals(run: ia.Result) -> None:
    with pytest.raises(KeyError, match=r"no variable 'mas\.s'; did you mean 'mass\.s'"):
        run.plot("mas.s")
    with pytest.raises(KeyError, match=r"no variable like 'rotor\.\*'"):
        run.plot("rotor.*")


def test_nothing_to_plot() -> None:
    net = ia.Network("held", wall=ia.Fixed(), rod=ia.Rod(L=1.0), load=ia.ConstantForce(f_constant=1.0))
    net.connect(net.wall.flange, net.rod.flange_a)
    net.connect(net.rod.flange_b, net.load.flange)
    run = net.simulate(1.0)
    with pytest.raises(ValueError, match="name the signals of 'held' to plot; it has no states"):
        run.plot()
    assert run.plot("load.flange.f").axes[0].lines[0].get_ydata()[0] == -1.0
