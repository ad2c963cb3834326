"""A cart between a spring and a damper, pushed by a shaker.

Input `push.f` [N], output `cart.s` [m]. Paths where something may be missing: `cart`, `spring`, `damper`;
channels `F`, `x`.
"""

from inertance import Damper, Fixed, Force, Mass, Network, Spring


def build() -> Network:
    """Return the rig: wall, spring, damper, cart, shaker."""
    net = Network(
        "oscillator",
        wall=Fixed(),
        spring=Spring(k=800.0),
        damper=Damper(d=8.0),
        cart=Mass(m=2.0),
        push=Force(),
    )
    net.connect(net.wall.flange, net.spring.flange_a, net.damper.flange_a)
    net.connect(net.spring.flange_b, net.damper.flange_b, net.cart.flange, net.push.flange)
    return net
