"""Campbell diagram: gyroscopic frequencies and critical speeds in closed form, modes that cross."""

from math import pi, sqrt
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance import rotational
from inertance.analysis import Campbell, campbell
from matplotlib import pyplot

J_T, J_P, C = 0.8, 0.5, 2000.0


class Gyroscope(ia.Component):
    """A disc that tilts about two axes while it spins at w: J_t a_x + J_p w w_y = tau_x and so on."""

    x = ia.RotationalFlange("tilt about x")
    y = ia.RotationalFlange("tilt about y")
    J_t = ia.parameter("kg.m2", "inertia about a diameter", above=0)
    J_p = ia.parameter("kg.m2", "inertia about the axis", min=0)
    w = ia.parameter("rad/s", "spin", default=0.0)
    w_x = ia.variable("rad/s", "tilting rate about x")
    w_y = ia.variable("rad/s", "tilting rate about y")

    def equations(self) -> Any:
        yield self.w_x == ia.der(self.x.phi)
        yield self.w_y == ia.der(self.y.phi)
        yield self.J_t * ia.der(self.w_x) + self.J_p * self.w * self.w_y == self.x.tau
        yield self.J_t * ia.der(self.w_y) - self.J_p * self.w * self.w_x == self.y.tau


def rotor(c_y: float = C) -> ia.Network:
    net: Any = ia.Network(
        "rotor",
        ground=rotational.Fixed(),
        disc=Gyroscope(J_t=J_T, J_p=J_P),
        stiff_x=rotational.Spring(c=C),
        stiff_y=rotational.Spring(c=c_y),
    )
    net.connect(net.ground.flange, net.stiff_x.flange_a, net.stiff_y.flange_a)
    net.connect(net.stiff_x.flange_b, net.disc.x)
    built: ia.Network = net.connect(net.stiff_y.flange_b, net.disc.y)
    return built


def test_whirl_of_a_disc_in_closed_form() -> None:
    """w = sqrt(c/J_t + (J_p W/(2 J_t))^2) +- J_p W/(2 J_t)."""
    diagram = campbell(rotor(), "disc.w", np.linspace(0.0, 200.0, 21))
    half = J_P * diagram.speed / (2 * J_T)
    root = np.sqrt(C / J_T + half**2)
    assert 2 * pi * diagram.frequency[0] == pytest.approx(root - half, rel=1e-9)
    assert 2 * pi * diagram.frequency[1] == pytest.approx(root + half, rel=1e-9)
    assert diagram.damping == pytest.approx(0.0, abs=1e-9)


def test_critical_speeds_are_exact_whatever_the_grid() -> None:
    """The order n meets at W = sqrt(c/(J_t n^2 -+ J_p n)), forward and backward."""
    diagram = campbell(rotor(), "disc.w", [1.0, 30.0, 97.0, 200.0])
    for order in (1.0, 2.0):
        exact = [sqrt(C / (J_T * order**2 + side * J_P * order)) for side in (1, -1)]
        found = diagram.crossings(order)
        assert [speed for speed, _ in found] == pytest.approx(exact, rel=1e-9)
        assert [f for _, f in found] == pytest.approx([order * w / (2 * pi) for w in exact], rel=1e-9)
    assert diagram.crossings(0.01) == []


def test_modes_that_cross_keep_their_names() -> None:
    """Two oscillators side by side, one stiffened by the speed: the curves go through each other."""

    class Stiffened(ia.Compliant):
        """f = (k + m w^2) s_rel: a spring that the speed of a rotor stiffens."""

        w = ia.parameter("rad/s", "speed", default=0.0)

        def equations(self) -> Any:
            yield self.f == (100.0 + self.w**2) * self.s_rel

    net: Any = ia.Network(
        "pair", wall=ia.Fixed(), one=ia.Mass(m=1.0), two=ia.Mass(m=1.0), rising=Stiffened(),
        steady=ia.Spring(k=400.0),
    )  # fmt: skip
    net.connect(net.wall.flange, net.rising.flange_a, net.steady.flange_a)
    net.connect(net.rising.flange_b, net.one.flange).connect(net.steady.flange_b, net.two.flange)
    diagram = campbell(net, "rising.w", np.linspace(0.0, 40.0, 17))
    rising, steady = 2 * pi * diagram.frequency
    assert rising == pytest.approx(np.sqrt(100.0 + diagram.speed**2), rel=1e-9)
    assert steady == pytest.approx(20.0, rel=1e-9)


def test_a_speed_may_be_a_start_value_or_an_input() -> None:
    """Centrifugal pendulum: its frequency is an order, w sqrt(R/l), of a rotor that coasts or is driven."""

    class Pendulum(ia.Component):
        """Small swing phi of a pendulum of length l at radius R on a rotor: phi'' + w^2 R/l phi = 0."""

        rotor = ia.RotationalFlange("rotor")
        w = ia.variable("rad/s", "speed of the rotor")
        phi = ia.variable("rad", "swing")
        rate = ia.variable("rad/s", "its rate")

        def equations(self) -> Any:
            yield self.w == ia.der(self.rotor.phi)
            yield self.rate == ia.der(self.phi)
            yield ia.der(self.rate) == -(self.w**2) * 2.25 * self.phi
            yield self.rotor.tau == 0.0

    coasting: Any = ia.Network("absorber", shaft=rotational.Inertia(J=1.0), absorber=Pendulum())
    coasting.connect(coasting.shaft.flange, coasting.absorber.rotor)
    driven: Any = ia.Network("absorber", shaft=rotational.Speed(), absorber=Pendulum())
    driven.connect(driven.shaft.flange, driven.absorber.rotor)
    for net, name in ((coasting, "shaft.w"), (driven, "shaft.w_ref")):
        diagram = campbell(net, name, [10.0, 50.0, 90.0])
        assert 2 * pi * diagram.frequency[-1] == pytest.approx(1.5 * diagram.speed, rel=1e-9)


def test_the_diagram_is_drawn_with_units_and_its_crossings() -> None:
    pyplot.switch_backend("Agg")
    figure = campbell(rotor(), "disc.w", np.linspace(0.0, 200.0, 11)).plot(orders=[1, 2])
    (ax,) = figure.axes
    assert ax.get_xlabel() == "disc.w [rad/s]"
    assert ax.get_ylabel() == "damped natural frequency [Hz]"
    dots = [line for line in ax.lines if line.get_marker() == "o"]
    assert len(dots) == 4
    pyplot.close(figure)


@pytest.mark.parametrize(
    ("speed", "speeds", "told"),
    [
        ("disc.v", [0.0, 1.0], "did you mean"),
        ("disc.J_t", [0.0, 1.0], "'disc.J_t' of 'rotor' is in kg.m2, a speed is in rad/s"),
        ("disc.w", [1.0, 1.0], "rising speeds"),
        ("disc.w", [1.0], "2 to 10000 rising speeds"),
        ("disc.w", [0.0, -1.0], "at least 0 rad/s"),
    ],
)
def test_what_is_no_speed_is_told(speed: str, speeds: list[float], told: str) -> None:
    with pytest.raises(ia.InertanceError, match=told):
        campbell(rotor(), speed, speeds)


def test_what_does_not_oscillate_is_told() -> None:
    net = ia.Network("coasting", rotor=rotational.Inertia(J=1.0))
    with pytest.raises(ia.ModelError, match="nothing in 'coasting' oscillates"):
        campbell(net, "rotor.w", [0.0, 1.0])


def test_a_diagram_is_what_the_face_shows() -> None:
    assert isinstance(campbell(rotor(), "disc.w", [0.0, 1.0]), Campbell)


def test_a_mode_that_stops_oscillating_leaves_a_gap() -> None:
    """A brake whose damping rises with speed: beyond 2 sqrt(J c) the rotor creeps, below it is followed."""

    class Braked(rotational.CompliantWithSpeed):
        """tau = w_0 w_rel: a damper as strong as some speed."""

        w_0 = ia.parameter("rad/s", "speed", default=0.0)

        def equations(self) -> Any:
            yield self.tau == self.w_0 * self.w_rel

    net: Any = ia.Network(
        "braked", wall=rotational.Fixed(), rotor=rotational.Inertia(J=1.0), spring=rotational.Spring(c=25.0),
        brake=Braked(),
    )  # fmt: skip
    net.connect(net.wall.flange, net.spring.flange_a, net.brake.flange_a)
    net.connect(net.spring.flange_b, net.brake.flange_b, net.rotor.flange)
    diagram = campbell(net, "brake.w_0", np.linspace(0.0, 14.0, 15))
    (curve,) = diagram.frequency
    under = diagram.speed < 10.0
    assert 2 * pi * curve[under] == pytest.approx(np.sqrt(25.0 - diagram.speed[under] ** 2 / 4), rel=1e-9)
    assert np.isnan(curve[~under]).all()
    assert diagram.damping[0][under] == pytest.approx(diagram.speed[under] / 10, rel=1e-9)
    pyplot.switch_backend("Agg")
    pyplot.close(diagram.plot())
