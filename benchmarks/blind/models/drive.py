"""A two-mass drive: a motor turns a load through an elastic shaft and a gear.

Input `torque.tau` [N.m], outputs `motor.w`, `load.w` [rad/s]. Paths where something may be missing: `motor`,
`bearing` (motor against ground), `shaft` (motor against gear), `gear`, `load`, `load_bearing` (load against
ground), `spiral` (the load's centring spring); channels `m`, `wm`, `wl`.
"""

from inertance import Network, rotational


def build() -> Network:
    """Return the drive: torque, motor, shaft, gear, load, both bearings and a centring spring."""
    net = Network(
        "drive",
        ground=rotational.Fixed(),
        torque=rotational.Torque(),
        motor=rotational.Inertia(J=2.0e-3),
        bearing=rotational.Damper(d=4.0e-3),
        shaft=rotational.SpringDamper(c=60.0, d=0.03),
        gear=rotational.IdealGear(ratio=5.0),
        load=rotational.Inertia(J=0.08),
        load_bearing=rotational.Damper(d=0.15),
        spiral=rotational.Spring(c=4.0),
    )
    net.connect(net.torque.flange, net.motor.flange, net.bearing.flange_b, net.shaft.flange_a)
    net.connect(net.shaft.flange_b, net.gear.flange_a)
    net.connect(net.gear.flange_b, net.load.flange, net.load_bearing.flange_b, net.spiral.flange_b)
    net.connect(net.ground.flange, net.bearing.flange_a, net.load_bearing.flange_a, net.spiral.flange_a)
    return net
