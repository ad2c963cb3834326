"""What a notebook shows: well-formed, escaped, drawn from the numbers, and short for large networks."""

import re
import xml.etree.ElementTree as ET
from html.parser import HTMLParser
from itertools import combinations, pairwise
from typing import Any

import inertance as ia
import pytest

VOID = {"br", "hr"}


class Balance(HTMLParser):
    """Fails on a tag that is closed out of order."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []

    def handle_starttag(self, tag: str, attrs: Any) -> None:
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


def shown(thing: Any) -> str:
    """Return the HTML of a network or a result, checked for balance."""
    html = str(thing._repr_html_())
    balance = Balance()
    balance.feed(html)
    balance.close()
    assert balance.open == []
    return html


def drawings(html: str) -> list[ET.Element]:
    return [ET.fromstring(svg) for svg in re.findall(r"<svg.*?</svg>", html, re.DOTALL)]


def texts(html: str) -> list[str]:
    return [text for drawing in drawings(html) for text in drawing.itertext()]


def oscillator(name: str = "oscillator", **spring: float) -> ia.Network:
    net = ia.Network(
        name,
        wall=ia.Fixed(),
        spring=ia.Spring(**(spring or {"k": 100.0})),
        rub=ia.CoulombFriction(f_c=1.0),
        mass=ia.Mass(m=1.0, s=0.5),
        push=ia.Force(),
    )
    net.connect(net.wall.flange, net.spring.flange_a, net.rub.flange_a)
    net.connect(net.mass.flange, net.spring.flange_b, net.rub.flange_b, net.push.flange)
    return net


@pytest.fixture(scope="module")
def run() -> ia.Result:
    return oscillator().simulate(20.0, step=0.01, inputs={"push.f": 0.0})


def test_result_is_told_in_numbers(run: ia.Result) -> None:
    html = shown(run)
    for told in ("oscillator", "0 to 20 s", f"{run.stats['events']} events", *run.dae.state_names):
        assert told in html
    assert f"{run['mass.s'].min():.5g}" in html
    assert "stuck → backward" in html


def test_result_draws_its_states(run: ia.Result) -> None:
    charts = drawings(shown(run))
    assert len(charts) == 2  # m and m/s
    line = charts[0].find("polyline")
    assert line is not None
    points = [tuple(map(float, point.split(","))) for point in line.attrib["points"].split()]
    assert 100 < len(points) < 600 < len(run.time)
    values = run[run.dae.state_names[0]]
    heights = [y for _, y in points]
    assert points[heights.index(min(heights))][0] == pytest.approx(
        62 + run.time[values.argmax()] / 20 * 270, abs=0.2
    )
    low = (values - values.min()) / (values.max() - values.min())
    assert points[-1][1] == pytest.approx(max(heights) - low[-1] * (max(heights) - min(heights)), abs=0.2)


def test_a_state_that_stays_put_is_a_line() -> None:
    run = oscillator().simulate(1.0, start={"mass.s": 0.0}, inputs={"push.f": 0.0})
    assert all(chart.find("polyline") is not None for chart in drawings(shown(run)))


def test_network_shows_components_and_values() -> None:
    html = shown(oscillator())
    for told in ("k = 100 N/m", "s = 0.5 m at the start", "CoulombFriction", "5 components"):
        assert told in html


def test_names_are_escaped() -> None:
    net = oscillator("<script>alert(1)</script>")
    for html in (shown(net), shown(net.simulate(0.1, inputs={"push.f": 0.0}))):
        assert "<script>" not in html
        assert "&lt;script&gt;" in html


def test_a_wrong_network_is_shown_with_what_is_wrong() -> None:
    html = shown(oscillator(c=1.0))
    assert "has no parameter &#x27;c&#x27;" in html
    assert "k [N/m] (stiffness) must be given" in html


def test_parts_of_composites_fold_away() -> None:
    strut = ia.series(ia.Spring(k=4e4), ia.parallel(ia.Inerter(b=130.0), ia.Damper(d=260.0)))
    html = shown(ia.Network("strut", strut=strut))
    assert html.count("<details>") == 2
    assert "d = 260 N·s/m" in html


def test_values_handed_down_to_parts_are_shown() -> None:
    guide = ia.MassWithStopAndFriction(m=2.0, s_min=-1.0, s_max=1.0, f_c=3.0)
    html = shown(ia.Network("guide", guide=guide))
    assert html.count("m = 2 kg") == 2
    assert html.count("f_c = 3 N") == 2
    assert "follows from others" in html


def boxes(html: str) -> dict[str, tuple[float, float, float, float]]:
    """Return the rectangle of each component in a sketch: left, top, right, bottom."""
    found = {}
    children = list(drawings(html)[0])
    for box, label in pairwise(children):
        if box.tag == "rect":
            x, y, w, h = (float(box.attrib[key]) for key in ("x", "y", "width", "height"))
            found[str(label.text)] = x, y, x + w, y + h
    return found


def test_sketch_places_components_from_the_ground_to_the_right() -> None:
    places = boxes(shown(oscillator()))
    assert set(places) == {"wall", "spring", "rub", "mass", "push"}
    left = {name: place[0] for name, place in places.items()}
    assert left["wall"] < min(left["spring"], left["rub"])
    assert max(left["spring"], left["rub"]) < min(left["mass"], left["push"])


def test_boxes_of_a_sketch_do_not_overlap() -> None:
    net = ia.Network("web", **{f"spring_{i}": ia.Spring(k=1.0) for i in range(8)})
    for i, j in [(0, 1), (1, 2), (2, 0), (3, 4), (0, 5), (5, 6), (6, 2)]:
        net.connect(getattr(net, f"spring_{i}").flange_b, getattr(net, f"spring_{j}").flange_a)
    places = boxes(shown(net))
    assert len(places) == 8
    for a, b in combinations(places.values(), 2):
        assert a[2] <= b[0] or b[2] <= a[0] or a[3] <= b[1] or b[3] <= a[1]


def test_lines_of_a_sketch_tell_the_ports() -> None:
    told = "wall.flange — spring.flange_a — rub.flange_a"
    assert texts(shown(oscillator()))[:3] == [told] * 3


def test_connections_that_share_a_port_are_one_node() -> None:
    net = ia.Network("node", a=ia.Mass(m=1.0), b=ia.Mass(m=1.0), c=ia.Mass(m=1.0))
    net.connect(net.a.flange, net.b.flange)
    net.connect(net.b.flange, net.c.flange)
    sketch = drawings(shown(net))[0]
    assert len(sketch.findall("circle")) == 1
    assert len(sketch.findall("path")) == 3


def test_a_signal_is_a_dashed_line() -> None:
    net = ia.Network("loop", gain=ia.signals.Gain(k=2.0), push=ia.Force(), mass=ia.Mass(m=1.0))
    net.connect(net.gain.y, net.push.f)
    net.connect(net.push.flange, net.mass.flange)
    lines = drawings(shown(net))[0].findall("path")
    assert [("stroke-dasharray" in line.attrib) for line in lines] == [True, False]


def test_a_large_network_stays_short() -> None:
    html = shown(ia.Network("chain", **{f"mass_{i}": ia.Mass(m=1.0) for i in range(1000)}))
    assert len(html) < 20_000
    assert "no sketch of so many" in html
    assert "and 960 more" in html


def test_an_empty_network() -> None:
    assert "0 components" in shown(ia.Network("empty"))


def test_summary_tells_starts_events_and_statistics(run: ia.Result) -> None:
    text = run.summary()
    for decision in run.initial:
        assert decision.name in text
        assert decision.reason in text
    assert f"{run.stats['steps']} steps" in text
    assert f"and {len(run.events) - 12} more events" in text


def test_summary_of_many_states_is_short() -> None:
    net = ia.Network("many", wall=ia.Fixed())
    for i in range(15):
        net.add(**{f"spring_{i}": ia.Spring(k=1.0), f"mass_{i}": ia.Mass(m=1.0)})
        spring, mass = getattr(net, f"spring_{i}"), getattr(net, f"mass_{i}")
        net.connect(net.wall.flange, spring.flange_a)
        net.connect(spring.flange_b, mass.flange)
    assert "and 10 more states" in net.simulate(1.0).summary()
