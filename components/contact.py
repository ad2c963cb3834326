"""The clearance law that gear teeth, screws and bearings share."""

import casadi as ca

from .language import Expression


def past_clearance(force: Expression, half: Expression) -> Expression:
    """Return what is left of a contact's spring and damper force behind a clearance: a dead zone.

    force - half above half, force + half below -half, zero between: continuous.

    `force` [N] is that of the contact without clearance, `half` [N] stiffness times half the clearance.

    Source: Ge & Wang on the planetary flywheel inerter (see `machines.ge_wang`), eqs. (20), (24).
    """
    return ca.fmax(force - half, 0) + ca.fmin(force + half, 0)


def clearance_energy(way: Expression, k: Expression, half: Expression) -> Expression:
    """Return what a contact's spring stores that is `way` [m] from the middle of its clearance.

    `half` [m] is half the clearance.
    """
    return k * (ca.fmax(way - half, 0) ** 2 + ca.fmin(way + half, 0) ** 2) / 2
