"""Two masses between walls on three springs, the first pushed: input `push.f` [N], outputs their `s` [m]."""

from inertance import Fixed, Force, Mass, Network, SpringDamper


def build() -> Network:
    """Return the rig."""
    net = Network("pair", wall=Fixed(), left=SpringDamper(k=700.0, d=7.0), first=Mass(m=1.2), push=Force())
    net.add(middle=SpringDamper(k=500.0, d=4.0), second=Mass(m=0.9), right=SpringDamper(k=800.0, d=5.0))
    net.connect(net.wall.flange, net.left.flange_a, net.right.flange_a)
    net.connect(net.left.flange_b, net.first.flange, net.middle.flange_a, net.push.flange)
    return net.connect(net.middle.flange_b, net.second.flange, net.right.flange_b)
