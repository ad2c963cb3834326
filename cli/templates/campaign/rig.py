"""The model of the rig: a body on a spring and a damper, shaken through them."""

import inertance as ia


def build() -> ia.Network:
    """Return the rig with the values that it should have by its drawing, in SI units."""
    net = ia.Network(
        "rig",
        shaker=ia.Position(),  # what it follows, shaker.s_ref, is measured
        spring=ia.Spring(k=1000.0),  # N/m, uncertain
        damper=ia.Damper(d=20.0),  # N.s/m, uncertain
        body=ia.Mass(m=10.0),  # kg, weighed
    )
    net.connect(net.shaker.flange, net.spring.flange_a, net.damper.flange_a)
    return net.connect(net.spring.flange_b, net.damper.flange_b, net.body.flange)
