"""The sketch of a machine moves as the machine did."""

import re
from collections.abc import Callable
from pathlib import Path

import inertance as ia
import numpy as np
import pytest
from inertance import machines, rotational
from inertance.networks.results.animation import REACH, motions
from inertance.networks.results.motion_layout import Place, laid_out
from PIL import Image


def drive() -> ia.Network:
    net = ia.Network(
        "drive", base=rotational.Fixed(), coupling=rotational.SpringDamper(c=80.0, d=0.5),
        gear=rotational.Inertia(J=0.05, phi=0.3, w=0.0), rack=ia.RackPinion(R=0.1), table=ia.Mass(m=5.0),
        buffer=ia.Damper(d=20.0), stop=ia.Spring(k=30.0), wall=ia.Fixed(), fan=rotational.Inertia(J=0.4),
        shaft=rotational.Spring(c=50.0),
    )  # fmt: skip
    net.connect(net.base.flange, net.coupling.flange_a)
    net.connect(net.coupling.flange_b, net.gear.flange, net.rack.flange_r, net.shaft.flange_a)
    net.connect(net.rack.flange_t, net.table.flange, net.buffer.flange_b, net.stop.flange_b)
    net.connect(net.wall.flange, net.buffer.flange_a, net.stop.flange_a)
    return net.connect(net.shaft.flange_b, net.fan.flange)


def by_body(net: ia.Component) -> dict[str, Place]:
    return {body: place for place in laid_out(net)[0] for body in place.bodies}


def test_parts_stand_from_the_ground_on_and_never_in_one_place() -> None:
    places, links = laid_out(drive())
    of = by_body(drive())
    assert of["base"].held
    assert of["wall"].held
    assert not of["table"].held
    assert of["gear"].turns
    assert not of["table"].turns
    assert [of[body].column for body in ("base", "gear", "fan", "table", "wall")] == [0, 1, 2, 2, 3]
    assert {link.name for link in links} == {"coupling", "rack", "buffer", "stop", "shaft"}
    cells = [(place.x, row) for place in places for row in range(min(place.rows), max(place.rows) + 1)]
    assert len(set(cells)) == len(cells)


def test_what_slides_moves_at_one_scale_and_what_turns_by_its_angle() -> None:
    run = drive().simulate(2.0)
    times = np.linspace(0.0, 2.0, 9)
    places = laid_out(drive())[0]
    found = {place.bodies[0]: moved for place, moved in motions(run, places, times).items()}
    np.testing.assert_array_equal(found["gear"], run.at("gear.phi", times))
    table = run.at("table.s", times)
    middle, half = (table.max() + table.min()) / 2, np.ptp(table) / 2
    np.testing.assert_allclose(found["table"], REACH * (table - middle) / half, rtol=1e-12)
    assert not found["wall"].any()


def test_it_is_kept_as_a_picture_and_as_a_page_of_its_own(tmp_path: Path) -> None:
    moving = drive().simulate(1.5).animate(5, slower=2.0)
    moving.save(tmp_path / "drive.gif")
    with Image.open(tmp_path / "drive.gif") as picture:
        assert getattr(picture, "n_frames", 1) == 5
        assert abs(picture.info["duration"] - 600) <= 10  # ms: 3 s in 5 frames
    page = moving.save(tmp_path / "drive.html").read_text(encoding="utf-8")
    assert page.count('<img alt="" src="data:image/png;base64,') == 5
    assert "http" not in re.sub('src="[^"]*"', "", page)
    with pytest.raises(ia.OutputError, match=r"\.gif"):
        moving.save(tmp_path / "drive.mp4")
    assert repr(moving) == "<Motion of 'drive': 0 to 1.5 s, 5 pictures>"


@pytest.mark.parametrize("name", ["quarter_car", "half_car", "shear_frame", "bogie"])
def test_ready_machines_are_laid_out(name: str) -> None:
    given: dict[str, Callable[[], ia.Network]] = {
        "quarter_car": lambda: machines.quarter_car(machines.suspension("S4", 6e4, 3e3, 200.0)),
        "half_car": lambda: machines.half_car(*(machines.suspension("S1", 6e4, 3e3) for _ in range(2))),
        "shear_frame": lambda: machines.shear_frame([1e3] * 3, [1e6] * 3),
        "bogie": machines.bogie,
    }
    places, links = laid_out(given[name]())
    assert len(links) >= 2
    cells = [(place.x, row) for place in places for row in range(min(place.rows), max(place.rows) + 1)]
    assert len(set(cells)) == len(cells)


def test_bodies_that_nothing_joins_are_drawn_below(tmp_path: Path) -> None:
    net = ia.Network("loose", a=ia.Mass(m=1.0, v=1.0), b=ia.Mass(m=1.0, v=-1.0))
    net.connect(net.a.flange).connect(net.b.flange)
    net.simulate(1.0).animate(2).save(tmp_path / "loose.gif")


def test_what_cannot_be_drawn_is_told() -> None:
    only = ia.Network("signals", sine=ia.signals.Sine(f=1.0), gain=ia.signals.Gain(k=2.0))
    only.connect(only.sine.y, only.gain.u)
    with pytest.raises(ia.ModelError, match="nothing slides or turns"):
        only.simulate(1.0).animate()
    chain = ia.Network("chain", **{f"m{k}": ia.Mass(m=1.0) for k in range(61)})
    with pytest.raises(ia.ModelError, match="61 components are too many"):
        chain.simulate(1.0).animate()
    with pytest.raises(ia.ModelError, match="frames"):
        drive().simulate(0.1).animate(1)
