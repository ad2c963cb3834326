"""A specimen on a test bench that prescribes its stroke and measures its force; there are no states.

Input `actuator.s_ref` [m], output `load_cell.f` [N]. Paths where something may be missing: `specimen`
(slider against frame), `slider`; channels `x`, `F`.
"""

from inertance import Fixed, ForceSensor, Mass, Network, Position, SpringDamper


def build() -> Network:
    """Return the bench: actuator, load cell, slider, specimen, frame."""
    net = Network(
        "bench",
        frame=Fixed(),
        specimen=SpringDamper(k=2.0e4, d=900.0),
        slider=Mass(m=1.2),
        load_cell=ForceSensor(),
        actuator=Position(),
    )
    net.connect(net.actuator.flange, net.load_cell.flange_a)
    net.connect(net.load_cell.flange_b, net.slider.flange, net.specimen.flange_b)
    net.connect(net.frame.flange, net.specimen.flange_a)
    return net
