"""`FMUModel`: an FMU as the model of a campaign."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property
from typing import Any

from ...components import FAMILIES, Domain
from ...components.language import Parameter
from ...fmu import FMU, FMUBlock, FMUError, FMUForce, FMUMotion, FMURotation, FMUTorque
from ...networks import Input, Network
from ..effects.sites import GROUND, Site
from .fmu_port import read_port


class FMUModel:
    """An FMU, of which nothing is known but what it does.

    Channels and parameters go by the names of its variables. Channels are in SI units, parameters in the unit
    that the FMU declares. Inputs that are not measured keep their start values. At its port, named by its
    variables "force", "position" and "velocity", other parts may be joined.

    Attributes:
        parameter_values: every real parameter with its value, in the unit that the FMU declares.
        inputs: what needs a signal.
        input_names: what can be driven.
        started: start values that are not the FMU's own.
        refined: communication steps between compared instants, 0 while that is not known.
    """

    def __init__(self, fmu: FMU, kind: str, port: Mapping[str, str] | None = None) -> None:
        self.fmu, self.kind, self.name = fmu, kind, fmu.name
        self.port = read_port(fmu, port) if port else None
        self.place = _identifier(fmu.name)
        self.refined = 0
        parameters = fmu.parameters
        self.parameter_values = {name: float(parameters[name].start or 0.0) for name in _scalars(parameters)}
        self.inputs: Sequence[Input] = ()  # as those of an FMU have start values
        self.input_names = _scalars(fmu.inputs)
        self.started: dict[str, Any] = {}

    def own(self, parameters: Mapping[str, float]) -> dict[str, Any]:
        """Return those of some parameters that are the FMU's."""
        return {name: value for name, value in parameters.items() if name in self.parameter_values}

    def wired(self, path: str) -> tuple[str, float]:
        """Return the FMU's variable behind the name of a channel, and its sign."""
        return path, 1.0

    def part(self, path: str) -> str:
        """Return the component of the network that a variable belongs to."""
        return self.place

    def names(self) -> Iterable[str]:
        """Return the names of all real variables."""
        return _scalars(self.fmu.variables)

    def expression(self, path: str) -> str:
        """Return the name of what can be measured."""
        variable = self.fmu.variable(path)
        if not variable.real or variable.size != 1:
            told = f"{variable.type} of size {variable.size}, no signal"
            raise FMUError(f"FMU '{self.name}': '{path}' is {told}")
        return path

    def unit(self, path: str) -> str:
        """Return the SI unit of a variable, the declared unit of a parameter."""
        if path in self.parameter_values:
            return self.fmu.unit(path)
        if self.port is not None and path in self.port.units:
            return self.port.units[path]
        if not self.fmu.unit(path):
            return ""
        return self.fmu.measure(self.fmu.variable(path)).si_name

    def field(self, path: str) -> Parameter:
        """Return what is declared of a parameter."""
        v = self.fmu.parameters[path]
        low, high = (x if abs(x) < float("inf") else None for x in (v.minimum, v.maximum))
        return Parameter(v.unit, v.text, min=low, max=high)

    @cached_property
    def network(self) -> Network:
        """The FMU in a network that does the same, to be changed, drawn and co-simulated."""
        return _network(self)

    @cached_property
    def sites(self) -> list[Site]:
        """The port, if there is one."""
        if self.port is None:
            return []
        moving, fixed = f"{self.place}.flange", GROUND
        if not self.port.takes_force:
            moving, fixed = f"{self.place}.flange_b", f"{self.place}.flange_a"
        places = frozenset({"across", "node"})
        return [Site(self.place, self.port.domain, moving, fixed, places, instant=True, grounded=True)]

    def limits(self, driven: Iterable[str]) -> list[str]:
        """Return what a diagnosis of it cannot see, in words; `driven` are its inputs that are set."""
        told = [f"'{self.fmu.name}' is an FMU, run as {self.kind}: effects inside of it are not looked for"]
        if self.port is None:
            port = "no [port] with force, position and velocity is named"
            told.append(f"{port}, so only effects on channels were tried")
        else:
            port = f"at its port '{self.port.force}'"
            told.append(f"{port} all effects were tried that answer to its motion at once")
        idle = sorted({name for name, v in self.fmu.inputs.items() if v.real} - {*driven})
        if idle:
            told.append(f"inputs that are not measured keep their start values: {', '.join(idle)}")
        return told


_FOREIGN: dict[str, Any] = {
    Domain.TRANSLATIONAL: (FMUMotion, FMUForce, ("force", "position", "velocity")),
    Domain.ROTATIONAL: (FMURotation, FMUTorque, ("torque", "angle", "speed")),
}


def _network(box: FMUModel) -> Network:
    port = box.port
    if port is None:
        return Network(box.name, **{box.place: FMUBlock(box.fmu, kind=box.kind)})
    family = FAMILIES[port.domain]
    moving, answering, names = _FOREIGN[port.domain]
    force = port.force if port.sign > 0 else f"-{port.force}"
    variables = dict(zip(names, (force, port.position, port.velocity), strict=True))
    if port.takes_force:
        body = moving(box.fmu, kind=box.kind, **variables)
        net = Network(box.name, **{box.place: body}, push=family.Force())
        return net.connect(net.push.flange, getattr(net, box.place).flange)
    if port.velocity not in box.fmu.inputs:
        del variables[names[2]]
    strut = answering(box.fmu, kind=box.kind, **variables)
    net = Network(box.name, wall=family.Fixed(), **{box.place: strut}, motion=family.Position())
    part = getattr(net, box.place)
    return net.connect(net.wall.flange, part.flange_a).connect(net.motion.flange, part.flange_b)


def _scalars(variables: Mapping[str, Any]) -> list[str]:
    """Return the names of those that are one real number."""
    return [name for name, variable in variables.items() if variable.real and variable.size == 1]


def _identifier(name: str) -> str:
    """Return a name by which a network can hold the FMU."""
    cleaned = re.sub(r"\W", "_", name).strip("_")
    taken = hasattr(Network, cleaned) or cleaned in ("push", "motion", "wall", "name") or not cleaned
    return "rig" if taken or cleaned[0].isdigit() else cleaned
