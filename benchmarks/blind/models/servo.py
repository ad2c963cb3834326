"""A position-controlled arm: a motor under a PI controller with speed feedback, an elastic shaft, an arm.

Input `error.u1`, the setpoint [rad], outputs `motor.phi` [rad] and `drive.tau` [N.m]. Paths where something
may be missing: `motor`, `shaft` (motor against arm), `arm`, `bearing` (arm against ground); channels `r`,
`phi`, `tau`. The controller's gains are known.
"""

from inertance import Network, rotational, signals


def build() -> Network:
    """Return the servo: controller, motor, shaft, arm, and the sensors of the controller."""
    net = Network(
        "servo",
        ground=rotational.Fixed(),
        error=signals.Add(k2=-1.0),
        proportional=signals.Gain(k=60.0),
        integral=signals.Integrator(k=100.0),
        braking=signals.Gain(k=-1.5),
        wanted=signals.Add(),
        command=signals.Add(),
        angle=rotational.AngleSensor(),
        speed=rotational.SpeedSensor(),
        drive=rotational.Torque(),
        motor=rotational.Inertia(J=0.01),
        shaft=rotational.SpringDamper(c=300.0, d=0.3),
        arm=rotational.Inertia(J=0.05),
        bearing=rotational.Damper(d=0.2),
    )
    net.connect(net.angle.phi, net.error.u2)
    net.connect(net.error.y, net.proportional.u, net.integral.u)
    net.connect(net.proportional.y, net.wanted.u1)
    net.connect(net.integral.y, net.wanted.u2)
    net.connect(net.speed.w, net.braking.u)
    net.connect(net.wanted.y, net.command.u1)
    net.connect(net.braking.y, net.command.u2)
    net.connect(net.command.y, net.drive.tau)
    sensors = (net.angle.flange, net.speed.flange)
    net.connect(net.drive.flange, net.motor.flange, net.shaft.flange_a, *sensors)
    net.connect(net.shaft.flange_b, net.arm.flange, net.bearing.flange_b)
    net.connect(net.ground.flange, net.bearing.flange_a)
    return net
