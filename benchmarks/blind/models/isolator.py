"""An isolated payload on a shaking table, with a load cell under its mount.

Input `table.s_ref` [m], outputs `load_cell.f` [N], `frame.a`, `payload.a` [m/s2]. Paths where something may
be missing: `mount` (table against frame), `frame`, `inner` (frame against payload), `payload`; channels `z`,
`F`, `a1`, `a2`.
"""

from inertance import ForceSensor, Mass, Network, Position, SpringDamper


def build() -> Network:
    """Return the rig: table, load cell, mount, frame, inner mount, payload."""
    net = Network(
        "isolator",
        table=Position(),
        load_cell=ForceSensor(),
        mount=SpringDamper(k=4.0e4, d=150.0),
        frame=Mass(m=20.0),
        inner=SpringDamper(k=2.5e4, d=60.0),
        payload=Mass(m=6.0),
    )
    net.connect(net.table.flange, net.load_cell.flange_a)
    net.connect(net.load_cell.flange_b, net.mount.flange_a)
    net.connect(net.mount.flange_b, net.frame.flange, net.inner.flange_a)
    net.connect(net.inner.flange_b, net.payload.flange)
    return net
