"""A motor that turns a load through a stiff screw: input `drive.tau` [N.m], outputs `motor.w`, `load.phi`."""

from inertance import Network, rotational


def build() -> Network:
    """Return the rig."""
    net = Network("screw", frame=rotational.Fixed(), motor=rotational.Inertia(J=0.02))
    net.add(bearing=rotational.Damper(d=0.12), coupling=rotational.SpringDamper(c=6000.0, d=0.6))
    net.add(load=rotational.Inertia(J=0.03), brake=rotational.Damper(d=0.1), drive=rotational.Torque())
    net.connect(net.frame.flange, net.bearing.flange_a, net.brake.flange_a)
    net.connect(net.bearing.flange_b, net.motor.flange, net.coupling.flange_a, net.drive.flange)
    return net.connect(net.coupling.flange_b, net.load.flange, net.brake.flange_b)
