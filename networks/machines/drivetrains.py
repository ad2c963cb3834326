"""The drivetrain of a passenger car, from the engine through a slipping clutch to the road."""

from __future__ import annotations

from ...components import Component, Force, Mass, RollingWheel, rotational
from ..network import Network


def clutch_drivetrain(
    clutch: Component,
    *,
    J_e: float = 0.2,
    J_d: float = 0.02,
    ratio: float = 13.0,
    c: float = 9000.0,
    d: float = 20.0,
    R: float = 0.3,
    m: float = 1400.0,
) -> Network:
    """Return engine, clutch, gearbox, drive shafts, wheels and car: `engine_torque`, `engine`, ..., `car`.

    Inputs are `engine_torque.tau`, `clutch.f_normalized`, the pedal, and `drag.f` on the car, 0 if not given.
    Where friction falls with slip, by mu' per rad/s, the slipping clutch feeds the vibration of the shafts,
    judder: it grows once -mu' cgeo fn ratio^2 exceeds d (1 + ratio^2 J_d/(m R^2))^2, for weak damping.

    Args:
        clutch: from the engine (`flange_a`) to the gearbox, such as `rotational.Clutch(...)`, its pedal open.
        J_e: inertia of engine and flywheel [kg.m2].
        J_d: inertia of the clutch disc and the gearbox, at the clutch [kg.m2].
        ratio: turns of the clutch for one of the wheels.
        c: stiffness of the drive shafts, at the wheels [N.m/rad].
        d: damping constant of the drive shafts, at the wheels [N.m.s/rad].
        R: radius of the wheels [m].
        m: mass of the car [kg].

    Source: Crowther, Zhang, Liu & Jeyakumaran, Analysis and simulation of clutch engagement judder and
    stick-slip in automotive powertrain systems, Proc. IMechE D 218 (2004) 1427-1446: a linear chain with
    one slipping clutch.
    """
    train = Network(
        "clutch drivetrain",
        engine_torque=rotational.Torque(),
        engine=rotational.Inertia(J=J_e),
        clutch=clutch,
        disc=rotational.Inertia(J=J_d),
        gearbox=rotational.IdealGear(ratio=ratio),
        shafts=rotational.SpringDamper(c=c, d=d),
        wheels=RollingWheel(R=R),
        car=Mass(m=m),
        drag=Force(f=0.0),
    )
    train.connect(train.engine_torque.flange, train.engine.flange, train.clutch.flange_a)
    train.connect(train.clutch.flange_b, train.disc.flange, train.gearbox.flange_a)
    train.connect(train.gearbox.flange_b, train.shafts.flange_a)
    train.connect(train.shafts.flange_b, train.wheels.flange_r)
    return train.connect(train.wheels.flange_t, train.car.flange, train.drag.flange)
