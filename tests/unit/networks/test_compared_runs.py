"""Two runs held against each other, phase portraits and power spectra, against closed forms."""

import inertance as ia
import matplotlib as mpl
import numpy as np
import pandas as pd
import pytest
from inertance.analysis import power_spectrum
from matplotlib import pyplot

mpl.use("Agg")


def oscillator(k: float = 100.0, v: float = 0.0) -> ia.Network:
    net = ia.Network("swing", wall=ia.Fixed(), spring=ia.Spring(k=k), mass=ia.Mass(m=1.0, s=0.1, v=v))
    return net.connect(net.wall.flange, net.spring.flange_a).connect(net.spring.flange_b, net.mass.flange)


def recorded(time: np.ndarray, unit: str = "m", **columns: np.ndarray) -> ia.Recorded:
    table = pd.DataFrame({name.replace("_", "."): values for name, values in columns.items()}, index=time)
    table.attrs["units"] = dict.fromkeys(table.columns, unit)
    return ia.Recorded(table, "measured")


def test_runs_are_apart_by_the_difference_of_two_cosines() -> None:
    first = oscillator().simulate(3.0, begin=1.0, step=1e-3, rtol=1e-10)
    second = oscillator(121.0).simulate(4.0, begin=1.0, step=0.7e-3, rtol=1e-10)
    table = first.compare(second, "mass.s", "spring.*")
    assert list(table.index) == ["mass.s", *[name for name in first.names() if name.startswith("spring.")]]
    t = np.linspace(1.0, 3.0, 2_000_001)
    one, other = 0.1 * np.cos(10 * (t - 1)), 0.1 * np.cos(11 * (t - 1))
    told, apart = table.loc["mass.s"], other - one
    assert told["unit"] == "m"
    assert told["rms"] == pytest.approx(np.sqrt(np.mean(one**2)), rel=1e-4)
    assert told["rms of difference"] == pytest.approx(np.sqrt(np.mean(apart**2)), rel=1e-4)
    worst = np.abs(apart).argmax()
    assert told["largest difference"] == pytest.approx(apart[worst], rel=1e-4)
    assert told["at [s]"] == pytest.approx(t[worst], abs=2e-3)


def test_a_run_is_held_against_what_was_measured_over_their_common_time() -> None:
    """Sensors that stand 1 mm off, from before the run to its middle, at few instants."""
    run = oscillator().simulate(2.0)
    time = np.linspace(-1.0, 1.0, 20001)
    measured = recorded(time, mass_s=0.1 * np.cos(10 * time) + 1e-3)
    for table, sign in ((run.compare(measured, "mass.s"), 1), (measured.compare(run), -1)):
        assert table.loc["mass.s", "rms of difference"] == pytest.approx(1e-3, rel=1e-2)
        assert table.loc["mass.s", "largest difference"] == pytest.approx(sign * 1e-3, rel=2e-2)
        assert table["at [s]"].between(0, 1).all()


def test_the_same_run_is_not_apart() -> None:
    run = oscillator(v=1.0).simulate(1.0)
    assert not run.compare(run)["largest difference"].to_numpy().any()
    assert list(run.compare(run).index) == list(run.to_dataframe().columns)


def test_what_cannot_be_compared_is_told() -> None:
    run = oscillator().simulate(1.0)
    late = oscillator().simulate(3.0, begin=2.0)
    with pytest.raises(ia.ModelError, match="'swing' and 'swing' have no time in common"):
        run.compare(late)
    with pytest.raises(ia.ModelError, match=r"'mass\.s' is in m in 'swing' and in mm in 'measured'"):
        run.compare(recorded(np.array([0.0, 1.0]), "mm", mass_s=np.zeros(2)), "mass.s")
    with pytest.raises(ia.UnknownNameError, match=r"'measured' has no column 'mass\.v'"):
        run.compare(recorded(np.array([0.0, 1.0]), mass_s=np.zeros(2)), "mass.v")
    with pytest.raises(ia.ModelError, match="other must be a OverTime"):
        run.compare({"mass.s": 0.0})  # type: ignore[arg-type]


def test_a_phase_portrait_is_an_ellipse_and_marks_the_start() -> None:
    run = oscillator().simulate(1.0)
    ax = run.plot_phase("mass.s", "mass.v").axes[0]
    curve, start = (line.get_xydata() for line in ax.get_lines())
    assert ((curve[:, 0] / 0.1) ** 2 + curve[:, 1] ** 2) == pytest.approx(np.ones(len(curve)), rel=1e-4)
    assert start.tolist() == [[0.1, 0.0]]
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("mass.s [m]", "mass.v [m/s]")
    assert run.plot_phase("mass.s", "mass.v", axes=ax) is ax.figure
    with pytest.raises(ia.UnknownNameError, match="did you mean"):
        run.plot_phase("mass.s", "mass.w")
    pyplot.close("all")


def test_the_density_of_a_sine_integrates_to_half_its_square() -> None:
    time = np.arange(0.0, 40.0, 0.005)
    signal = recorded(time, mass_s=3.0 + 2.0 * np.sin(2 * np.pi * 7.0 * time))
    found = power_spectrum(signal, "mass.s", 4.0, rate=100.0)
    assert found.frequency[found.density.argmax()] == 7.0
    assert found.density.sum() * (found.frequency[1] - found.frequency[0]) == pytest.approx(2.0, rel=1e-3)
    assert found.windows == (40 - 4) / 2 + 1
    figure = found.plot()
    assert figure.axes[0].get_ylabel() == "density [m²/Hz]"
    pyplot.close("all")


def test_white_noise_is_flat() -> None:
    random = np.random.default_rng(5)
    time = np.arange(50_000) / 100.0 - 7.0
    found = power_spectrum(
        recorded(time, mass_s=random.standard_normal(len(time))), "mass.s", 1.0, rate=100.0
    )
    middle = found.density[5:-5]
    assert middle.mean() == pytest.approx(2 / 100.0, rel=0.02)
    assert middle.std() / middle.mean() == pytest.approx(1 / np.sqrt(found.windows), rel=0.5)


def test_windows_that_do_not_fit_are_told() -> None:
    run = oscillator().simulate(1.0)
    for window, rate in ((2.0, 100.0), (0.5, 10.0)):
        with pytest.raises(ia.ModelError, match="at least 8 samples and at most as long as 'swing', 1 s"):
            power_spectrum(run, "mass.s", window, rate=rate)
