"""A three-storey shear frame on a shaking table, with a tuned inerter damper in its lowest storey.

Input `table.s_ref` [m], outputs `floor_1.a`, `floor_2.a`, `floor_3.a` [m/s2]. Paths where something may
be missing: `storey_1`, `storey_2`, `storey_3` (each floor against the one below), `floor_1`, `floor_2`,
`floor_3`, `link` (table against the inner end of the inerter), `inerter` (that end against floor 1);
channels `g`, `a1`, `a2`, `a3`.
"""

from inertance import Inerter, Mass, Network, Position, SpringDamper


def build() -> Network:
    """Return the frame: table, three storeys, link and inerter."""
    net = Network(
        "frame",
        table=Position(),
        storey_1=SpringDamper(k=1.8e5, d=120.0),
        floor_1=Mass(m=100.0),
        storey_2=SpringDamper(k=1.8e5, d=120.0),
        floor_2=Mass(m=100.0),
        storey_3=SpringDamper(k=1.8e5, d=120.0),
        floor_3=Mass(m=100.0),
        link=SpringDamper(k=2.4e4, d=500.0),
        inerter=Inerter(b=60.0),
    )
    net.connect(net.table.flange, net.storey_1.flange_a, net.link.flange_a)
    net.connect(net.link.flange_b, net.inerter.flange_a)
    net.connect(net.storey_1.flange_b, net.floor_1.flange, net.inerter.flange_b, net.storey_2.flange_a)
    net.connect(net.storey_2.flange_b, net.floor_2.flange, net.storey_3.flange_a)
    net.connect(net.storey_3.flange_b, net.floor_3.flange)
    return net
