"""Networks so large that few of their points are evaluated at once."""

import casadi as ca
import inertance as ia
import numpy as np
import pytest
from inertance.networks.evaluation.compiled import Batch


@pytest.mark.parametrize("points", [1, 2, 3, 100])
@pytest.mark.parametrize("entries", [3, 5000, 200_000])
def test_a_function_of_many_entries_is_evaluated_at_any_number_of_points(entries: int, points: int) -> None:
    x = ca.MX.sym("x", entries)
    batch = Batch(ca.Function("ends", [x], [ca.vertcat(x[0], x[-1])]))
    given = np.random.default_rng(0).normal(size=(points, entries))
    (found,) = batch(given)
    np.testing.assert_array_equal(found[:, :, 0], given[:, [0, -1]])


def test_signals_of_a_chain_of_a_thousand_masses_can_be_read() -> None:
    net = ia.Network("chain", wall=ia.Fixed())
    last = net.wall.flange
    for k in range(1000):
        link, mass = ia.SpringDamper(k=1e4, d=5.0), ia.Mass(m=1.0, s=0.0 if k else 0.01)
        net.add(**{f"link{k}": link, f"mass{k}": mass})
        net.connect(last, link.flange_a).connect(link.flange_b, mass.flange)
        last = mass.flange
    run = net.simulate(0.01, step=0.001)
    assert run["mass0.s"][0] == 0.01
    assert run["mass0.a"][0] == pytest.approx(-200.0)
    assert run.at("link1.f", 0.0) == pytest.approx(-100.0)
