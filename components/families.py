"""Families: the elements of each domain by one name, also where the two call them differently."""

from types import SimpleNamespace
from typing import Any

from . import rotational, translational
from .language import Domain

FAMILIES: dict[str, Any] = {
    Domain.TRANSLATIONAL: SimpleNamespace(**vars(translational)),
    Domain.ROTATIONAL: SimpleNamespace(
        **vars(rotational),
        ConstantForce=rotational.ConstantTorque,
        Force=rotational.Torque,
        ForceSensor=rotational.TorqueSensor,
        Mass=rotational.Inertia,
        PositionSensor=rotational.AngleSensor,
    ),
}
