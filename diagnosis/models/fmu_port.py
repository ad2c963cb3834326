"""`Port`: where other parts may be joined to an FMU."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ...components import Domain, ModelError, nearest
from ...fmu import FMU, FMUError

NEEDED = ("force", "position", "velocity")
SI = {  # exponents of kg, m, s; rad counts as 1
    (0, 1, 0): "m", (0, 1, -1): "m/s", (0, 1, -2): "m/s2", (1, 1, -2): "N", (1, 2, -2): "N.m",
    (0, 0, -1): "rad/s", (0, 0, -2): "rad/s2", (1, 2, -3): "W", (1, -1, -2): "Pa", (1, 0, 0): "kg",
}  # fmt: skip


@dataclass(frozen=True)
class Port:
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


def read_port(fmu: FMU, entries: Mapping[str, str]) -> Port:
    """Return the port of an FMU by the names of its variables.

    Raises:
        ModelError: telling everything that is wrong with it.
    """
    problems = [
        f"port: there is no '{key}'{nearest(key, NEEDED) or '; a port has force, position and velocity'}"
        for key in entries
        if key not in NEEDED
    ]
    problems += [f'port: {key} = "name of a variable" must be given' for key in NEEDED if key not in entries]
    if problems:
        raise ModelError(f"the port of FMU '{fmu.name}' cannot be used:", problems)
    sign = -1.0 if entries["force"].startswith("-") else 1.0
    names = {key: entries[key].removeprefix("-") if key == "force" else entries[key] for key in NEEDED}
    for key, name in names.items():
        try:
            variable = fmu.variable(name)
        except FMUError as error:
            problems.append(f"port: {key}: {error}")
            continue
        if not variable.real or variable.size != 1:
            problems.append(
                f"port: {key}: '{name}' is {variable.type} of size {variable.size}, no real signal"
            )
    if problems:
        raise ModelError(f"the port of FMU '{fmu.name}' cannot be used:", problems)
    takes_force = names["force"] in fmu.inputs
    if not takes_force and names["position"] not in fmu.inputs:
        raise ModelError(
            f"the port of FMU '{fmu.name}' cannot be used: it takes neither '{names['force']}' nor "
            f"'{names['position']}'; one of them must be an input (it has {', '.join(fmu.inputs) or 'none'})"
        )
    domain = _domain(fmu, names["force"], names["position"])
    for name, unit in zip(names.values(), _units(domain), strict=True):
        exponents = next(key for key, value in {**SI, (0, 0, 0): "rad"}.items() if value == unit)
        if fmu.unit(name) and fmu.measure(fmu.variables[name]).exponents[:3] != exponents:
            problems.append(f"port: '{name}' is in {fmu.unit(name)}, where {unit} belongs")
    if problems:
        raise ModelError(f"the port of FMU '{fmu.name}' cannot be used:", problems)
    return Port(names["force"], names["position"], names["velocity"], sign, takes_force, domain)


def _units(domain: Domain) -> tuple[str, str, str]:
    """Return the SI units of force, position and velocity."""
    position, velocity, _ = domain.motion_units
    return domain.through_unit, position, velocity


def _domain(fmu: FMU, force: str, position: str) -> Domain:
    """Return the rotational one if a unit says so."""
    name, exponents = (force, (1, 2, -2)) if fmu.unit(force) else (position, (0, 0, 0))
    turning = fmu.unit(name) and fmu.measure(fmu.variables[name]).exponents[:3] == exponents
    return Domain.ROTATIONAL if turning else Domain.TRANSLATIONAL
