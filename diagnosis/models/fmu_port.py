"""`FMUPort`: where other parts may be joined to an FMU."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ...base import unit_of
from ...components import Domain, ModelError, nearest
from ...fmu import FMU, FMUError

NEEDED = ("force", "position", "velocity")


@dataclass(frozen=True)
class FMUPort:
    """Where other parts may be joined to an FMU.

    Attributes:
        force, position, velocity: its variables: of these the FMU takes either the force, or the motion.
        sign: of the force: 1 if what is taken acts on the FMU, and what is given pulls like a spring.
        takes_force: whether the force is what it takes.
        domain: whether it slides or turns.
    """

    force: str
    position: str
    velocity: str
    sign: float
    takes_force: bool
    domain: Domain

    @property
    def signed_force(self) -> str:
        """The force as components with an FMU take it: with a minus if it counts the other way."""
        return self.force if self.sign > 0 else f"-{self.force}"

    @property
    def units(self) -> dict[str, str]:
        """The SI unit of each variable."""
        names = (self.force, self.position, self.velocity)
        return dict(zip(names, _units(self.domain), strict=True))


def read_port(fmu: FMU, entries: Mapping[str, str]) -> FMUPort:
    """Return the port of an FMU by the names of its variables.

    Raises:
        ModelError: telling everything that is wrong with it.
    """
    refused = f"the port of FMU '{fmu.name}' cannot be used"
    remedy = "; a port has force, position and velocity"
    problems = [
        f"port: there is no '{key}'{nearest(key, NEEDED) or remedy}" for key in entries if key not in NEEDED
    ]
    problems += [f'port: {key} = "name of a variable" must be given' for key in NEEDED if key not in entries]
    if problems:
        raise ModelError(f"{refused}:", problems)
    sign = -1.0 if entries["force"].startswith("-") else 1.0
    force, position, velocity = names = entries["force"].removeprefix("-"), *(entries[k] for k in NEEDED[1:])
    for key, name in zip(NEEDED, names, strict=True):
        try:
            variable = fmu.variable(name)
        except FMUError as error:
            problems.append(f"port: {key}: {error}")
            continue
        if not variable.real or variable.size != 1:
            told = f"{variable.type} of size {variable.size}, no real signal"
            problems.append(f"port: {key}: '{name}' is {told}")
    if problems:
        raise ModelError(f"{refused}:", problems)
    takes_force = force in fmu.inputs
    if not takes_force and position not in fmu.inputs:
        raise ModelError(
            f"{refused}: it takes neither '{force}' nor '{position}'; one of them must be an input (it has "
            f"{', '.join(fmu.inputs) or 'none'})"
        )
    domain = _domain(fmu, force, position)
    for name, unit in zip(names, _units(domain), strict=True):
        if fmu.unit(name) and not _measures(fmu, name, unit):
            problems.append(f"port: '{name}' is in {fmu.unit(name)}, where {unit} belongs")
    if problems:
        raise ModelError(f"{refused}:", problems)
    return FMUPort(force, position, velocity, sign, takes_force, domain)


def _units(domain: Domain) -> tuple[str, str, str]:
    """Return the SI units of force, position and velocity."""
    position, velocity, _ = domain.motion_units
    return domain.through_unit, position, velocity


def _domain(fmu: FMU, force: str, position: str) -> Domain:
    """Return the rotational one if a unit says so."""
    name, unit = (force, "N.m") if fmu.unit(force) else (position, "rad")
    turning = fmu.unit(name) and _measures(fmu, name, unit)
    return Domain.ROTATIONAL if turning else Domain.TRANSLATIONAL


def _measures(fmu: FMU, name: str, unit: str) -> bool:
    return fmu.measure(fmu.variables[name]).fits(unit_of(unit))
