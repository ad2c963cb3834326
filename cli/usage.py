"""A usage example of any component: a network in which its ports are joined, ready to run."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ..components import Component, HeatPort, RealInput, RotationalFlange, TranslationalFlange
from ..components.language import MISSING, Parameter, Part, Port
from ..networks import Network
from .catalogue import full_name

BODIES: dict[type[Port], tuple[str, str, str]] = {
    TranslationalFlange: ("Fixed()", "Mass(m=1.0)", "flange"),
    RotationalFlange: ("rotational.Fixed()", "rotational.Inertia(J=1.0)", "flange"),
    HeatPort: ("thermal.FixedTemperature()", "thermal.HeatCapacitor(C=1.0)", "port"),
}


def usage(kind: type[Component]) -> str:
    """Return Python lines that put a component into a network and run it."""
    own = _own_name(kind)
    parts, joins = {own: _call(kind)}, []
    ports = [f for f in kind.fields.values() if isinstance(f, Port) and not f.optional and not f.when]
    for number, port in enumerate(ports):
        ground, body, joint = BODIES[type(port)]
        if number == 0 and len(ports) > 1:
            parts = {"ground": ground, **parts}
            joins.append(f"net.connect(net.ground.{joint}, net.{own}.{port.name})")
        else:
            name = f"body_{number}" if len(ports) > 2 else "body"
            parts[name] = body
            joins.append(f"net.connect(net.{own}.{port.name}, net.{name}.{joint})")
    calls = [f"    {name}={call}," for name, call in parts.items()]
    used = re.findall(r"(?<![\w.])([A-Za-z]\w*)(?=[.(])", "".join(parts.values()))
    imported = sorted({"Network", *used})
    head = [
        f"from inertance import {', '.join(imported)}",
        "",
        "net = Network(",
        '    "example",',
        *calls,
        ")",
    ]
    return "\n".join([*head, *joins, "run = net.simulate(1.0)"])


def _own_name(kind: type[Component]) -> str:
    """Return the class's name as a component is named, kept apart from what a network itself has."""
    name = re.sub(r"(?<=[a-z])(?=[A-Z])", "_", kind.__name__).lower()
    return f"the_{name}" if hasattr(Network, name) else name


def _call(kind: type[Component]) -> str:
    """Return the call that makes a component, required values filled in."""
    return f"{full_name(kind)}({', '.join(_arguments(kind))})"


def _arguments(kind: type[Component]) -> Iterator[str]:
    for name, field in kind.fields.items():
        if isinstance(field, Parameter) and field.default is MISSING:
            yield f"{name}={_allowed(field):g}"
        elif isinstance(field, RealInput) and not field.when:
            yield f"{name}=lambda t: 0.1 * t"
        elif isinstance(field, Part) and any(field.default.problems()):
            yield f"{name}={_call(type(field.default))}"


def _allowed(parameter: Parameter) -> float:
    """Return a value within the range of a parameter, 1 if it may be."""
    bounds = [b for b in (parameter.min, parameter.above, parameter.max) if b is not None]
    tried = [1.0, *(b / 2 for b in bounds), *(b + 1.0 for b in bounds), *(b - 1.0 for b in bounds)]
    return next(value for value in tried if not parameter.problem(value))
