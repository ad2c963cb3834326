"""The matrix of a step leaves out states that merely follow another one."""

import inertance as ia
from inertance.networks.csource.reduction import Reduction


def row(count: int) -> ia.Network:
    """Masses in a row, on springs."""
    net = ia.Network("row", wall=ia.Fixed())
    last = net.wall.flange
    for k in range(count):
        net.add(**{f"spring{k}": ia.Spring(k=1e4), f"mass{k}": ia.Mass(m=1.0)})
        spring, mass = getattr(net, f"spring{k}"), getattr(net, f"mass{k}")
        net.connect(last, spring.flange_a).connect(spring.flange_b, mass.flange)
        last = mass.flange
    return net


def test_positions_follow_speeds() -> None:
    dae = row(5).dae()
    reduction = Reduction(dae)
    names = dae.state_names
    assert {names[i]: names[j] for i, j in reduction.led_by.items()} == {
        f"mass{k}.s": f"mass{k}.v" for k in range(5)
    }
    assert [names[k] for k in reduction.kept] == [f"mass{k}.v" for k in range(5)]
    assert reduction.pattern.nnz() == 13
    assert len(reduction.places) == reduction.slopes.nnz()


def test_what_follows_nothing_is_kept() -> None:
    net = ia.Network("slide", push=ia.Speed(v_ref=lambda t: t), mass=ia.Mass(m=1.0))
    dae = net.connect(net.push.flange, net.mass.flange).dae()
    assert Reduction(dae).led_by == {}
    assert Reduction(dae).kept == list(range(dae.x.numel() + dae.z.numel()))
