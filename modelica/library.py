"""Library: which elements of the Modelica Standard Library (MSL 4.1.0) say the same as ours."""

from __future__ import annotations

from dataclasses import dataclass, field

from ..components import Component, rotational, signals, translational
from ..components.language import Option, fields_of

SLIDING, TURNING = "Modelica.Mechanics.Translational", "Modelica.Mechanics.Rotational"
CONNECTORS = {
    "TranslationalFlange": f"{SLIDING}.Interfaces.Flange_a",
    "RotationalFlange": f"{TURNING}.Interfaces.Flange_a",
    "HeatPort": "Modelica.Thermal.HeatTransfer.Interfaces.HeatPort_a",
    "RealInput": "Modelica.Blocks.Interfaces.RealInput",
    "RealOutput": "Modelica.Blocks.Interfaces.RealOutput",
}


@dataclass(frozen=True)
class Counterpart:
    """A class of MSL that states the same equations.

    Attributes:
        name: of the class.
        renamed: names of parameters, variables and ports that differ there, by ours.
        supported: whether it has a support, held at zero until `useSupport` is set.
        fixed: modifications that make it the same.
    """

    name: str
    renamed: dict[str, str] = field(default_factory=dict)
    supported: bool = False
    fixed: dict[str, str] = field(default_factory=dict)


BODY, STIFF = {"flange": "flange_a"}, {"k": "c"}
EXACT = {"exact": "true"}
COUNTERPARTS: dict[type[Component], Counterpart] = {
    translational.Fixed: Counterpart(f"{SLIDING}.Components.Fixed"),
    translational.Mass: Counterpart(f"{SLIDING}.Components.Mass", BODY),
    translational.MassWithLength: Counterpart(f"{SLIDING}.Components.Mass"),
    translational.Rod: Counterpart(f"{SLIDING}.Components.Rod"),
    translational.Spring: Counterpart(f"{SLIDING}.Components.Spring", STIFF),
    translational.Damper: Counterpart(f"{SLIDING}.Components.Damper"),
    translational.SpringDamper: Counterpart(f"{SLIDING}.Components.SpringDamper", STIFF),
    translational.ElastoGap: Counterpart(f"{SLIDING}.Components.ElastoGap", STIFF),
    translational.Force: Counterpart(f"{SLIDING}.Sources.Force", supported=True),
    translational.ConstantForce: Counterpart(f"{SLIDING}.Sources.ConstantForce", supported=True),
    translational.Position: Counterpart(f"{SLIDING}.Sources.Position", supported=True, fixed=EXACT),
    translational.Speed: Counterpart(f"{SLIDING}.Sources.Speed", supported=True, fixed=EXACT),
    translational.Accelerate: Counterpart(f"{SLIDING}.Sources.Accelerate", supported=True),
    rotational.Fixed: Counterpart(f"{TURNING}.Components.Fixed"),
    rotational.Inertia: Counterpart(f"{TURNING}.Components.Inertia", BODY),
    rotational.Spring: Counterpart(f"{TURNING}.Components.Spring"),
    rotational.Damper: Counterpart(f"{TURNING}.Components.Damper"),
    rotational.SpringDamper: Counterpart(f"{TURNING}.Components.SpringDamper"),
    rotational.IdealGear: Counterpart(f"{TURNING}.Components.IdealGear", supported=True),
    rotational.IdealPlanetary: Counterpart(f"{TURNING}.Components.IdealPlanetary"),
    rotational.Torque: Counterpart(f"{TURNING}.Sources.Torque", supported=True),
    rotational.ConstantTorque: Counterpart(f"{TURNING}.Sources.ConstantTorque", supported=True),
    signals.Constant: Counterpart("Modelica.Blocks.Sources.Constant"),
    signals.Gain: Counterpart("Modelica.Blocks.Math.Gain"),
    signals.Add: Counterpart("Modelica.Blocks.Math.Add"),
}


def counterpart(component: Component) -> Counterpart | None:
    """Return the class of MSL for a component as its options have it, if there is one."""
    found = COUNTERPARTS.get(type(component))
    if found is None:
        return None
    plain = all(getattr(component, option.name) == option.default for option in fields_of(component, Option))
    return found if plain else None
