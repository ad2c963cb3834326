"""`read_model` reads the model of a campaign; `FMUNetworkModel` is one of an FMU and sources beside it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import casadi as ca

from ...base import boolean, demand, instance
from ...components import ModelError, nearest
from ...components.language import Parameter
from ...fmu import FMU, FMUBlock, FMUForce, FMUMotion, FMURotation, FMUTorque
from ...identification import Machine, fmu_and_kind, read_network
from ...networks import DAE, Input, Network
from ..effects.sites import walk
from .fmu_model import FMUModel

Foreign = FMUMotion | FMURotation | FMUForce | FMUTorque
REMEDY = (
    "a diagnosis takes one FMUMotion, FMURotation, FMUForce or FMUTorque with sources and sensors on its "
    "flanges; put the rest into the FMU"
)


class FMUNetworkModel(FMUModel):
    """A network of one FMU, and sources and sensors on its flanges.

    Channels go by the names of the network, or, as parameters do, by those of the FMU after the name of its
    component: `rig.spring.k`. What the FMU takes must be one input of the network, up to its sign.
    """

    def __init__(self, network: Network, place: str, part: Foreign) -> None:
        super().__init__(part.fmu, part.kind, _port(part))
        self.name, self.place, self.network, self._part = network.name, place, network, part
        chosen = {n: float(part.fmu.converted(part.fmu.variable(n), v)) for n, v in part.chosen.items()}
        values = self.parameter_values | chosen
        self.parameter_values = {f"{place}.{name}": value for name, value in values.items()}
        self._dae: DAE = network.dae()
        self._given = {f"{place}.{g.name}": g for g in part.given}
        self._sources = self._found_sources()
        self.inputs = [i for i in self._dae.inputs if i.path not in self._given]
        self.input_names, self.started = list(self._sources), part.started

    def _found_sources(self) -> dict[str, tuple[str, float]]:
        """Return what drives the FMU: input of the network -> variable of the FMU, and the sign of it."""
        found = {}
        for taken in self._part.taken:
            if taken.order == 2:
                raise ModelError(f"'{self.name}': '{self.place}' takes an acceleration; {REMEDY}")
            if taken.order:
                continue
            source = self._linear(f"{self.place}.{taken.name}")
            if source is None or source[0].path in self._given or self._dae.states:
                told = f"what the FMU '{self.place}' takes at '{taken.input}' is not one input of the network"
                raise ModelError(f"'{self.name}': {told}; {REMEDY}")
            found[source[0].path] = taken.input, source[1] * taken.sign
        return found

    def _linear(self, path: str) -> tuple[Input, float] | None:
        """Return the one input, and its sign, that a variable of the network equals; None if it does not."""
        dae = self._dae
        value = ca.substitute(ca.SX(dae.expression(path)), dae.p, ca.DM(dae.parameters.defaults))
        slopes = ca.simplify(ca.jacobian(value, dae.u))
        offset = ca.simplify(ca.substitute(value, dae.u, ca.DM.zeros(dae.u.shape)))
        if slopes.nnz() != 1 or not slopes.is_constant() or not offset.is_zero():
            return None
        column = slopes.sparsity().get_triplet()[1][0]
        source, slope = dae.inputs[column], float(slopes[0, column])
        return (source, slope * source.sign) if abs(slope) == 1.0 else None

    def wired(self, path: str) -> tuple[str, float]:
        """Return the FMU's variable behind a name, and its sign."""
        own = self._inner(path)
        if path in self._sources:
            return self._sources[path]
        if own != path and own in self.fmu.variables:
            return own, 1.0
        source = self._linear(path)
        if source is not None and source[0].path in self._given:
            given = self._given[source[0].path]
            if source[0].order < len(given.variables):
                return given.variables[source[0].order], source[1] * given.sign
        if source is not None and source[0].path in self._sources and not source[0].order:
            variable, sign = self._sources[source[0].path]
            return variable, sign * source[1]
        raise ModelError(f"'{self.name}': '{path}' is no variable of the FMU; measure one, or {REMEDY}")

    def _inner(self, path: str) -> str:
        """Return a name without that of the FMU's component before it."""
        return path.removeprefix(f"{self.place}.")

    def own(self, parameters: Any) -> dict[str, Any]:
        """Return parameters by the names of the FMU, those of the component included."""
        return self._part.chosen | {self._inner(n): v for n, v in super().own(parameters).items()}

    def names(self) -> list[str]:
        """Return the names of all variables."""
        return [*self._dae.names(), *(f"{self.place}.{name}" for name in super().names())]

    def expression(self, path: str) -> str:
        """Return the FMU's variable that is measured under a name; see `wired`."""
        known = self.names()
        if path not in known:
            raise ModelError(f"'{self.name}' has no variable '{path}'{nearest(path, known)}")
        return super().expression(self.wired(path)[0])

    def unit(self, path: str) -> str:
        """Return the SI unit of a variable, the declared unit of a parameter."""
        own = self._inner(path)
        if path in self.parameter_values:
            return self.fmu.unit(own)
        return self._dae.unit(path) if path in self._dae.names() else super().unit(own)

    def field(self, path: str) -> Parameter:
        """Return what is declared of a parameter."""
        return super().field(self._inner(path))

    def part(self, path: str) -> str:
        """Return the component that a variable belongs to."""
        return path.partition(".")[0]


def _port(part: Foreign) -> dict[str, str]:
    """Return force, position and velocity of an FMU's component, as [port] names them."""
    by_order = {taken.order: taken for taken in part.taken}
    (given,) = part.given
    if isinstance(part, FMUMotion | FMURotation):
        signed, turned = (by_order[0].input, by_order[0].sign), given.sign
        position, velocity = given.variables
    else:
        if 0 not in by_order or 1 not in by_order:
            raise ModelError("an FMU that is moved must take position and velocity; " + REMEDY)
        signed, turned = (given.variables[0], given.sign), min(by_order[0].sign, by_order[1].sign)
        position, velocity = by_order[0].input, by_order[1].input
    if turned < 0:
        raise ModelError("an FMU whose position counts the other way cannot be diagnosed; turn its flanges")
    force = signed[0] if signed[1] > 0 else f"-{signed[0]}"
    return {"force": force, "position": position, "velocity": velocity}


def _recognised(network: Network) -> FMUNetworkModel | None:
    """Return the model that a network with an FMU in it is; None for one without."""
    foreign = {path: part for path, part in walk(network, "") if isinstance(part, Foreign | FMUBlock)}
    if not foreign:
        return None
    ((place, part), *others) = foreign.items()
    if others or isinstance(part, FMUBlock):
        raise ModelError(f"'{network.name}' has {', '.join(foreign)}; {REMEDY}")
    return FMUNetworkModel(network, place, part)


def read_model(
    model: Network | str, port: Mapping[str, str], base: Path, validate: bool = True
) -> tuple[Network, Machine]:
    """Return the network of a campaign that is to be diagnosed, and what predicts its outputs.

    Args:
        model: the network, `path/to/file.py:function` that returns it, or `path/to/file.fmu`, with `:ME` or
            `:CS` after it to choose (Co-Simulation if it has both, which is several times faster).
        port: names of variables by "force", "position" and "velocity", where parts may be joined to an FMU.
        base: the folder that a relative path starts from.
        validate: whether to refuse an FMU whose description its schema does not allow.

    Raises:
        ModelError: telling what is wrong.
        FMUError: if the file is no FMU that can be run.
    """
    demand(
        "read_model()",
        model=(model, instance(Network, str)),
        port=(port, instance(Mapping)),
        base=(base, instance(Path)),
        validate=(validate, boolean),
    )
    foreign = fmu_and_kind(model)
    if foreign:
        path, kind = base / foreign[0], foreign[1]
        if not path.is_file():
            others = [p.name for p in path.parent.glob("*.fmu")] if path.parent.is_dir() else []
            raise ModelError(f"model: there is no file '{path}'{nearest(path.name, others)}")
        fmu = FMU(path, validate=validate)
        box = FMUModel(fmu, fmu.kind(kind or ("CS" if "CS" in fmu.kinds else None)), port)
        return box.network, box
    network, equations = read_network(model, port, base)
    return network, _recognised(network) or equations
