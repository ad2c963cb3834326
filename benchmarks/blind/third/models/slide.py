"""A block on a rail, on a spring to the wall, pushed: input `push.f` [N], output `block.s` [m]."""

from inertance import Fixed, Force, Mass, Network, SpringDamper


def build() -> Network:
    """Return the rig."""
    net = Network("slide", wall=Fixed(), spring=SpringDamper(k=900.0, d=9.0), block=Mass(m=1.6), push=Force())
    net.connect(net.wall.flange, net.spring.flange_a)
    return net.connect(net.spring.flange_b, net.block.flange, net.push.flange)
