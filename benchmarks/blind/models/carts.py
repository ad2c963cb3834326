"""Two carts on a rail, each on a spring to its wall and both joined by a third; the first is pushed.

Input `push.f` [N], outputs `cart_1.s`, `cart_2.s` [m]. Paths where something may be missing: `spring_1`,
`spring_2` (each cart against the rail), `link` (cart against cart), `cart_1`, `cart_2`; channels `F`, `x1`,
`x2`.
"""

from inertance import Fixed, Force, Mass, Network, SpringDamper


def build() -> Network:
    """Return the rig: rail, carts, springs, shaker."""
    net = Network(
        "carts",
        rail=Fixed(),
        spring_1=SpringDamper(k=1500.0, d=6.0),
        cart_1=Mass(m=3.0),
        link=SpringDamper(k=900.0, d=4.0),
        cart_2=Mass(m=1.5),
        spring_2=SpringDamper(k=1500.0, d=6.0),
        push=Force(),
    )
    net.connect(net.rail.flange, net.spring_1.flange_a, net.spring_2.flange_a)
    net.connect(net.spring_1.flange_b, net.cart_1.flange, net.link.flange_a, net.push.flange)
    net.connect(net.link.flange_b, net.cart_2.flange, net.spring_2.flange_b)
    return net
