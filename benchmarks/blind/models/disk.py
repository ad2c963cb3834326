"""A disk inerter on a shaker: a carriage between a spring and a rigid ball screw that turns a disk.

Input `shaker.f` [N], outputs `carriage.s` [m] and `carriage.a` [m/s2]. Paths where something may be missing:
`carriage`, `spring`, `guide` (carriage against frame), `inerter.screw` (carriage against frame, and in series
with the disk), `inerter.flywheel` (the disk against the frame); channels `u`, `s`, `a`.
"""

from inertance import Damper, DiskFlywheel, Fixed, Force, Mass, Network, NutScrew, Spring
from inertance.machines import BallScrewInerter


def build() -> Network:
    """Return the rig: frame, spring, guide, inerter, carriage, shaker."""
    inerter = BallScrewInerter(screw=NutScrew(lead=0.010), flywheel=DiskFlywheel(m=0.60, R=0.040, J_s=2.8e-5))
    net = Network(
        "disk",
        frame=Fixed(),
        spring=Spring(k=6.0e4),
        guide=Damper(d=900.0),
        inerter=inerter,
        carriage=Mass(m=25.0),
        shaker=Force(),
    )
    net.connect(net.frame.flange, net.spring.flange_a, net.guide.flange_a, net.inerter.flange_b)
    net.connect(
        net.carriage.flange, net.spring.flange_b, net.guide.flange_b, net.inerter.flange_a, net.shaker.flange
    )
    return net
