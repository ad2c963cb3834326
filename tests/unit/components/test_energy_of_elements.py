"""What elements store, lose and are supplied with, against integrals written apart."""

from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance import rotational
from scipy.integrate import cumulative_trapezoid, quad

CURVE = ((-0.03, -500.0), (-0.01, -90.0), (0.0, 20.0), (0.02, 300.0))
GRID = tuple((s, v, 800 * s + 20 * v + 2e3 * s * v) for s in (-0.02, 0.0, 0.03) for v in (-1.0, -0.2, 1.0))


def driven(element: Any, motion: Any, **options: Any) -> ia.Result:
    net = ia.Network("driven", wall=ia.Fixed(), element=element, drive=ia.Position(s_ref=motion))
    net.connect(net.wall.flange, net.element.flange_a).connect(net.element.flange_b, net.drive.flange)
    return net.simulate(4.5, begin=0.5, step=1e-3, rtol=1e-10, atol=1e-13, **options)


@pytest.mark.parametrize("interpolation", ["linear", "smooth"])
@pytest.mark.parametrize("map_", [False, True])
def test_a_curve_stores_its_area(map_: bool, interpolation: Any) -> None:
    kind, table = (ia.MapSpringDamper, GRID) if map_ else (ia.TabulatedSpring, CURVE)
    element: Any = kind(table=table, interpolation=interpolation, s_rel0=0.002)
    slow = driven(element, lambda t: 0.02 * (t - 2.5))  # from -0.04 to 0.04 m, beyond both ends
    at_rest = [
        driven(element, lambda t, s=s: s + 0 * t)["element.f"][-1] for s in slow["element.s_rel"][::100]
    ]
    stored = slow["element.potential"][::100]
    s = slow["element.s_rel"][::100] - 0.002
    corners = sorted({row[0] for row in table})

    def force(at: float) -> float:
        return float(np.interp(at, s, at_rest))

    near = int(np.argmin(np.abs(s)))
    for k in range(0, len(s), 5):
        area = quad(force, s[near], s[k], points=corners, limit=400)[0]
        assert stored[k] - stored[near] == pytest.approx(area, abs=5e-3)
    assert driven(element, lambda t: 0.002 + 0 * t)["element.potential"][-1] == 0


def test_an_amplifier_supplies_its_voltage_times_the_current_also_at_its_limit() -> None:
    motor = rotational.DCMotor(k=0.1, R=0.5, L=2e-3, u_max=24.0, i_max=20.0)
    net = ia.Network("drive", motor=motor, rotor=rotational.Inertia(J=1e-3, w=-50.0))
    net.connect(net.motor.flange, net.rotor.flange)
    run = net.simulate(1.2, begin=0.2, step=1e-4, inputs={"motor.u": lambda t: 60 * np.cos(5 * t)})
    book = run.energy()
    assert book.closes < 1e-6
    i, w = run["motor.i"], run["motor.w"]
    mechanical = cumulative_trapezoid(0.1 * i * w, x=run.time, initial=0)
    lost = cumulative_trapezoid(0.5 * i**2, x=run.time, initial=0)
    expected = mechanical + lost + 1e-3 * (i**2 - i[0] ** 2)
    assert book.supplied["motor"] == pytest.approx(expected, abs=1e-4 * np.abs(expected).max())
    free = np.abs(i) < 20.0 - 1e-9
    voltage = np.clip(60 * np.cos(5 * run.time), -24, 24)
    assert run["motor.supplyPower"][free] == pytest.approx((voltage * i)[free], abs=1e-3)
    assert 0.1 < free.mean() < 0.9
    assert run.unit("supplyPower") == "W"


def test_an_actuator_pulls_the_masses_of_a_flywheel_in() -> None:
    """Nothing turns it from outside: its momentum is kept, and what it gains the actuator puts in."""
    net = ia.Network("flywheel", wall=ia.Fixed(), inerter=ia.VariableInerter(b=4.0, b_u=-3.0, T=0.1))
    net.add(mass=ia.Mass(m=1e-6, v=2.0)).connect(net.wall.flange, net.inerter.flange_a)
    net.connect(net.inerter.flange_b, net.mass.flange)
    run = net.simulate(2.0, inputs={"inerter.u": lambda t: 1.0 + 0 * t}, rtol=1e-10, atol=1e-12)
    book = run.energy()
    assert book.stored[0] == pytest.approx(8.0, rel=1e-6)
    assert book.stored[-1] == pytest.approx(32.0, rel=1e-5)
    assert book.supplied["inerter"][-1] == pytest.approx(24.0, rel=1e-5)


@pytest.mark.parametrize("far", [0.05, 30.0])
def test_a_tyre_stores_the_area_below_its_force(far: float) -> None:
    """Its wheel spins against a car that is held: slip grows without end, nothing is lost on the road."""
    values: dict[str, Any] = {"mu": 0.9, "F_z": 800.0, "B": 10.0, "C": 1.6, "E": 0.3}
    net = ia.Network(
        "spin", tyre=ia.Tyre(R=0.3, sigma=0.3, **values), car=ia.Fixed(), rim=rotational.Position()
    )
    net.connect(net.tyre.flange_t, net.car.flange).connect(net.rim.flange, net.tyre.flange_r)
    run = net.simulate(1.0, inputs={"rim.phi_ref": lambda t: far * t**2}, rtol=1e-10)

    def force(kappa: float) -> float:
        x = 10.0 * kappa
        return float(0.9 * 800.0 * np.sin(1.6 * np.arctan(x - 0.3 * (x - np.arctan(x)))))

    kappa = run["tyre.kappa"][-1]
    assert kappa == pytest.approx(far, rel=1e-6)
    stored = 0.3 * quad(force, 0, kappa, points=[kappa / 100, kappa / 10], epsrel=1e-12, limit=200)[0]
    assert run["tyre.potential"][-1] == pytest.approx(stored, rel=1e-8)
    assert np.abs(run["tyre.lossPower"]).max() == 0
    assert run.energy().supplied["rim"][-1] == pytest.approx(stored, rel=1e-5)


@pytest.mark.parametrize("n", [1.0, 1.0 + 1e-9, 1.4])
def test_a_gas_stores_the_work_that_compressed_it(n: float) -> None:
    air = ia.AirSpring(A=1e-3, p_0=3e5, V_0=1e-4, n=n)
    run = driven(air, lambda t: 0.06 * np.sin(t))

    def force(e: float) -> float:
        return float(-1e-3 * (3e5 * (1e-4 / (1e-4 + 1e-3 * e)) ** n - 101325))

    for k in range(0, len(run.time), 400):
        assert run["element.potential"][k] == pytest.approx(
            quad(force, 0, run["element.s_rel"][k])[0], abs=1e-7
        )


@pytest.mark.parametrize("rtol", [1e-6, 1e-10, 1e-12])
def test_what_is_lost_within_a_microsecond_is_in_the_book(rtol: float) -> None:
    """v = v_0/(1 + c v_0 t/m): nearly all is lost long before the first point after the start."""
    net = ia.Network("stopped", wall=ia.Fixed(), oil=ia.QuadraticDamper(c=3e6), mass=ia.Mass(m=1.0, v=-2.0))
    net.connect(net.wall.flange, net.oil.flange_a).connect(net.oil.flange_b, net.mass.flange)
    book = net.simulate(1.5, begin=0.5, step=2e-3, rtol=rtol).energy()
    speed = 2.0 / (1 + 3e6 * 2.0 * (book.time - 0.5))
    assert book.dissipated["oil"] == pytest.approx(2.0 - speed**2 / 2, abs=2e-4)
    assert book.closes < 1e-4
