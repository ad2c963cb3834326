"""A quarter car on a road simulator, its strut with a tuned inerter damper in parallel.

Input `road.s_ref` [m], outputs `body.a`, `wheel.a` [m/s2] and `travel.s_rel` [m]. Paths where something
may be missing: `tyre` (road against wheel), `wheel`, `body`, `spring`, `damper` (wheel against body),
`link` (wheel against the inner end of the inerter), `inerter` (that end against the body); channels `z`,
`ab`, `aw`, `st`.
"""

from inertance import (
    Damper,
    Inerter,
    Mass,
    Network,
    Position,
    RelativePositionSensor,
    Spring,
    SpringDamper,
)


def build() -> Network:
    """Return the car: road, tyre, wheel, strut, body."""
    net = Network(
        "car",
        road=Position(),
        tyre=SpringDamper(k=1.5e5, d=150.0),
        wheel=Mass(m=35.0),
        spring=Spring(k=2.2e4),
        damper=Damper(d=1100.0),
        link=SpringDamper(k=2.4e4, d=900.0),
        inerter=Inerter(b=90.0),
        body=Mass(m=250.0),
        travel=RelativePositionSensor(),
    )
    net.connect(net.road.flange, net.tyre.flange_a)
    lower = (net.spring.flange_a, net.damper.flange_a, net.link.flange_a, net.travel.flange_a)
    upper = (net.spring.flange_b, net.damper.flange_b, net.inerter.flange_b, net.travel.flange_b)
    net.connect(net.tyre.flange_b, net.wheel.flange, *lower)
    net.connect(net.link.flange_b, net.inerter.flange_a)
    net.connect(net.body.flange, *upper)
    return net
