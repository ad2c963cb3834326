"""A picture of a component in text: its symbol between its ports."""

from __future__ import annotations

from collections.abc import Iterator

from ..components import Component, RealInput, RealOutput
from ..components.language import Domain, Port

SYMBOLS = {  # by the class that has it; what derives from that has it, too, unless it has one of its own
    "Mass": "[ m ]", "Inertia": "( J )", "Disc": "( J )", "Fixed": "/////", "Rod": "=====",
    "Spring": "/\\/\\/\\", "CubicSpring": "/\\/\\/\\ ^3", "BilinearSpring": "/\\/\\/",
    "BumpStop": "/\\|  |/\\",
    "Dissipative": "--[|--", "SpringDamper": "/\\/\\ || [|", "Inerter": "-(o)-", "BoucWen": "/\\/\\ || ~",
    "Iwan": "/\\/\\=~= ||",
    "Friction": "=~~~=", "DahlFriction": "=~~~=", "Jenkins": "/\\/\\=~=", "Brake": "=]~[=", "Clutch": "=]|[=",
    "OneWayClutch": "=]>[=", "HardStop": "--| |--", "ElastoGap": "/\\| |/\\", "Backlash": "--[ ]/\\",
    "ElastoBacklash": "--[ ]/\\", "ElasticFlanks": "--[ ]/\\", "IdealGear": "O:o", "LossyGear": "O:o",
    "Gearbox": "O:o --[ ]/\\", "IdealPlanetary": "(o)", "GearMesh": "O/\\o", "Lever": "--^--",
    "LargeAngleLever": "--^--", "NutScrew": "~~~#~~~", "RollingWheel": "(+)__", "DrivenFlange": "==>",
    "Vehicle": "_/o--o\\_", "HeatCapacitor": "[ C ]", "ThermalConductor": "~~~>",
    "TabulatedSpring": "/\\/\\/\\ ::", "TabulatedDamper": "--[|-- ::", "MapSpringDamper": "/\\ || [| ::",
    "LuGreFriction": "=~~~=", "SupportFriction": "=~~~=", "BearingFriction": "=~~~=",
    "RollingResistance": "(+)~~", "Maxwell": "/\\/\\--[|--", "Relaxing": "/\\/\\--[|--",
    "Zener": "/\\/\\--[|-- || /\\/\\",
    "FractionalDamper": "/\\ [| /\\ [|", "WireRope": "/\\/\\ || =~=", "ObliqueSprings": "/\\>--</\\",
    "Rope": "- - /\\ - -", "AirSpring": "--[ gas |--", "MonotubeDamper": "--[ gas | oil ||--",
    "BoucWenDamper": "--[| ~ i", "SpencerDamper": "--[| ~ i", "VoiceCoil": "--UUU--",
    "FluidInerter": "--[| @@@", "MassWithLength": "[== m ==]", "ModalRod": "=(~)=",
    "LumpedRod": "=[m]/\\[m]=", "ModalShaft": "=(~)=", "LumpedShaft": "=(J)/\\(J)=", "DCMotor": "( M )",
    "ShuntedMotor": "( M )", "EddyCurrentBrake": "=]~[=", "LeadScrew": "~~~#~~~",
    "CompliantNutScrew": "~~~#~~~ /\\/\\", "WormGear": "###O", "HarmonicDrive": "O:o /\\/\\",
    "BeltDrive": "(o====o)", "UniversalJoint": "--X--", "Differential": "O:o -<",
    "SliderCrank": "(o/--[]", "Cam": "(o>--[]", "Tyre": "(o)__", "RigidRingTyre": "((o))__",
    "DiskFlywheel": "( J )", "FixedTemperature": "/////", "BallScrewInerter": "~~~#~~~( J )",
    "Gyroscope": "(<|>)", "RackPinionInerter": "(+)__( J )", "GyroInerter": "(+)__(<|>)",
    "CrankInerter": "(o/--[]( J )",
    "MechatronicInerter": "~~~#~~~( J )( M )",
}  # fmt: skip
LEFT = ("flange_a", "flange_r", "flangeR", "sun", "bracket", "front", "port_a")


def sketch(kind: type[Component]) -> str:
    """Return lines that draw a component: ports left and right of its symbol, supports and heat below."""
    fields = list(kind.fields.values())
    ports = [f for f in fields if isinstance(f, Port)]
    below = [p for p in ports if p.optional or (p.when and not isinstance(p.domain, Domain))]
    ends = [p.name for p in ports if p not in below]
    left = [name for name in ends if name in LEFT] or (ends[:1] if len(ends) > 1 else [])
    right = [name for name in ends if name not in left]
    before = [f"{f.name} >" for f in fields if isinstance(f, RealInput)] + [f"{name} o" for name in left]
    after = [f"o {name}" for name in right] + [f"> {f.name}" for f in fields if isinstance(f, RealOutput)]
    return "\n".join(_lines(before, symbol(kind), after, [p.name for p in below]))


def symbol(kind: type[Component]) -> str:
    """Return what stands for a component: its class's symbol, that of what it derives from, or its name."""
    known = (SYMBOLS[base.__name__] for base in kind.__mro__ if base.__name__ in SYMBOLS)
    return next(known, f"[ {kind.__name__} ]")


def _lines(before: list[str], middle: str, after: list[str], below: list[str]) -> Iterator[str]:
    height = max(len(before), len(after), 1)
    width, row = max(map(len, before), default=0), (height - 1) // 2
    leads, tails = (_centred(texts, height) for texts in (before, after))
    for k, (lead, tail) in enumerate(zip(leads, tails, strict=True)):
        own = k == row
        joint = "--" if lead else "  "
        shown = middle if own else f"{'+' if lead else ' '}{'':{len(middle) - 2}}{'+' if tail else ' '}"
        yield f"  {lead:>{width}}{joint}{shown}{'--' if tail else ''}{tail}".rstrip()
    centre = 2 + width + 2 + len(middle) // 2
    if below:
        told = ", ".join(below)
        yield " " * centre + "|"
        yield " " * max(0, centre - len(told) // 2) + told


def _centred(texts: list[str], height: int) -> list[str]:
    above = (height - len(texts)) // 2
    return [""] * above + texts + [""] * (height - above - len(texts))
