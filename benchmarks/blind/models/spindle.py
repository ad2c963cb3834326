"""A spindle that turns freely: a rotor drives a wheel through a belt.

Input `torque.tau` [N.m], outputs `rotor.w`, `wheel.w` [rad/s]. Paths where something may be missing: `rotor`,
`front_bearing` (rotor against ground), `belt` (rotor against wheel), `wheel`, `rear_bearing` (wheel against
ground); channels `m`, `w1`, `w2`.
"""

from inertance import Network, rotational


def build() -> Network:
    """Return the spindle: torque, rotor, belt, wheel, both bearings."""
    net = Network(
        "spindle",
        ground=rotational.Fixed(),
        torque=rotational.Torque(),
        rotor=rotational.Inertia(J=4.0e-3),
        front_bearing=rotational.Damper(d=0.01),
        belt=rotational.SpringDamper(c=20.0, d=0.02),
        wheel=rotational.Inertia(J=0.01),
        rear_bearing=rotational.Damper(d=0.02),
    )
    net.connect(net.torque.flange, net.rotor.flange, net.front_bearing.flange_b, net.belt.flange_a)
    net.connect(net.belt.flange_b, net.wheel.flange, net.rear_bearing.flange_b)
    net.connect(net.ground.flange, net.front_bearing.flange_a, net.rear_bearing.flange_a)
    return net
