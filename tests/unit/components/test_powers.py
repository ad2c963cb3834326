"""Laws with powers, whose slope in the exponent is not defined at zero, start there under sampled inputs."""

import inertance as ia
import numpy as np
import pytest
from inertance import rotational

TIME = np.linspace(0.0, 2.0, 501)
PUSH = ia.Sampled(TIME, np.sin(3 * TIME) * TIME)


@pytest.mark.parametrize(
    "element",
    [ia.ElastoGap(k=1e3, d=10.0, s_rel0=-1e-3), ia.BoucWen(k=50.0, alpha=0.1, beta=10.0, gamma=10.0, n=1.5)],
)
def test_translational_elements_start_where_their_powers_vanish(element: ia.Component) -> None:
    net = ia.Network("rig", wall=ia.Fixed(), spring=ia.Spring(k=20.0), mass=ia.Mass(m=1.0), push=ia.Force())
    net.add(element=element)
    net.connect(net.wall.flange, net.spring.flange_a, net.element.flange_a)
    net.connect(net.spring.flange_b, net.element.flange_b, net.mass.flange, net.push.flange)
    run = net.simulate(2.0, inputs={"push.f": PUSH})
    assert 1e-3 < np.abs(run["element.s_rel"]).max() < 1.0
    assert run["element.f"][0] == 0.0
    assert np.abs(run["element.f"]).max() > 0.01


def test_a_turning_hysteretic_spring_starts_where_its_power_vanishes() -> None:
    net = ia.Network("rig", wall=rotational.Fixed(), disk=rotational.Inertia(J=1.0), push=rotational.Torque())
    net.add(element=rotational.BoucWen(c=50.0, alpha=0.1, beta=10.0, gamma=10.0, n=1.5))
    net.connect(net.wall.flange, net.element.flange_a)
    net.connect(net.element.flange_b, net.disk.flange, net.push.flange)
    run = net.simulate(2.0, inputs={"push.tau": PUSH})
    assert run["element.tau"][0] == 0.0
    assert np.abs(run["element.tau"]).max() > 0.01
