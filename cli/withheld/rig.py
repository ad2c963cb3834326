"""The planetary flywheel inerter on its rig, as its builder would model it: no clearance, screw friction.

Input `actuator.s_ref` [m], output `load_cell.f` [N]. Paths where something may be missing:
`inerter.screw` (rod against housing), `inerter.screw.contact` (nut against screw), `inerter.screw.nut`,
`inerter.screw.thread`, `inerter.screw.friction`, `inerter.flywheel` (screw against housing); channels
`x`, `F`.

Values: Ge & Wang, Modeling, Testing, and Characteristic Analysis of a Planetary Flywheel Inerter, tables
1-3.
"""

from inertance import (
    CompliantNutScrew,
    Fixed,
    ForceSensor,
    IdealPlanetaryFlywheel,
    Network,
    Position,
    rotational,
)
from inertance.machines import PlanetaryFlywheelInerter


def build() -> Network:
    """Return the rig: frame, inerter, load cell, actuator that prescribes the motion of the rod."""
    friction = rotational.StribeckFriction(tau_c=0.1975, tau_s=0.2231, w_s=5.437e8, d=2.703e-3)
    screw = CompliantNutScrew(lead=0.010, m_r=1.701, k=1.168e7, d=1.223e3, friction=friction)
    flywheel = IdealPlanetaryFlywheel(N=4, R=0.050, r=0.017, J_s=3.17e-4, J_p=1.66e-5, J_r=1.02e-4)
    net = Network(
        "pfi",
        frame=Fixed(),
        inerter=PlanetaryFlywheelInerter(screw=screw, flywheel=flywheel),
        load_cell=ForceSensor(),
        actuator=Position(),
    )
    net.connect(net.actuator.flange, net.load_cell.flange_a)
    net.connect(net.load_cell.flange_b, net.inerter.flange_a)
    net.connect(net.inerter.flange_b, net.frame.flange)
    return net
