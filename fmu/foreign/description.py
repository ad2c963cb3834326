"""What an FMU says of itself, as data: nothing of it runs."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from ...base import ModelError, Unit, path_of, unit_of
from ...components import nearest
from ..errors import FMUError
from .archive import platform_folder, platforms
from .model_description import FACES, KINDS, read_model_description
from .units import declared_units, inverse_units, is_bare, relative_names
from .variable import ForeignVariable, foreign_variable


class FMUDescription:
    """What an FMU says of itself: its variables, units, kinds and capabilities.

    Args:
        path: the .fmu file.
        validate: refuse a description that its XML schema does not allow.

    Raises:
        FMUError: if the archive is broken or unsafe, the description invalid, the FMI version unknown.
    """

    def __init__(self, path: str | Path, *, validate: bool = True) -> None:
        self.path, self.validate = path_of(path, "an FMU"), validate
        self.description, text, self.notes = read_model_description(self.path, validate)
        self._xml = ElementTree.fromstring(text)
        self.name = str(self.description.modelName)
        self.version = str(self.description.fmiVersion)
        self.tool = self.description.generationTool or "unknown tool"
        self.kinds = [k for k, attribute in FACES.items() if getattr(self.description, attribute) is not None]
        self.platforms = platforms(self.path)
        self.units = declared_units(self.description.unitDefinitions, inverse_units(self._xml))

    @cached_property
    def variables(self) -> dict[str, ForeignVariable]:
        """Every variable by its name."""
        relative = relative_names(self._xml)
        return {v.name: foreign_variable(v, v.name in relative) for v in self.description.modelVariables}

    def of(self, *causalities: str) -> dict[str, ForeignVariable]:
        """Return the variables of FMI causalities: "parameter", "input", "output", "local" ..."""
        return {n: v for n, v in self.variables.items() if v.causality in causalities}

    @property
    def parameters(self) -> dict[str, ForeignVariable]:
        """What can be set before a run and stays constant."""
        return {n: v for n, v in self.of("parameter").items() if v.settable}

    @property
    def inputs(self) -> dict[str, ForeignVariable]:
        """What it takes."""
        return self.of("input")

    @property
    def outputs(self) -> dict[str, ForeignVariable]:
        """What it gives."""
        return self.of("output")

    @property
    def states(self) -> list[str]:
        """Names of the continuous states, as far as it declares them."""
        derivatives = [unknown.variable.derivative for unknown in self.description.derivatives]
        return [state.name for state in derivatives if state is not None]

    @property
    def defaults(self) -> dict[str, float]:
        """Its author's suggestion: some of `start`, `stop`, `tolerance`, `step`."""
        suggested = self.description.defaultExperiment
        names = {"start": "startTime", "stop": "stopTime", "tolerance": "tolerance", "step": "stepSize"}
        values = {k: getattr(suggested, name, None) for k, name in names.items()}
        return {k: float(v) for k, v in values.items() if v is not None}

    @cached_property
    def _bare(self) -> set[str]:
        return {unit.name for unit in self.units.values() if is_bare(unit)}

    def capable(self, kind: str, capability: str) -> bool:
        """Tell whether a kind declares a capability, by its FMI name such as `canGetAndSetFMUstate`."""
        return self.declared(kind, capability) in ("true", "1")

    def declared(self, kind: str, attribute: str) -> str:
        """Return what a kind declares of itself by the FMI name of an attribute, empty if nothing."""
        face = self._xml.find(KINDS[self.kind(kind)])
        told = {} if face is None else face.attrib  # names in FMI 2 and 3 differ by a capital or an s
        same = (value for name, value in told.items() if _plain(name) == _plain(attribute))
        return next(same, "")

    def kind(self, wanted: str | None = None) -> str:
        """Return the kind to use: the one wanted, else Model Exchange before Co-Simulation.

        Raises:
            FMUError: if it has not that kind.
        """
        kind = wanted or (self.kinds or [""])[0]
        if kind not in self.kinds:
            there = " and ".join(self.kinds) or "Scheduled Execution only"
            raise FMUError(f"FMU '{self.name}' cannot run as {wanted or 'ME or CS'}: it is {there}")
        return kind

    def check_platform(self) -> None:
        """Refuse an FMU without a binary for this machine.

        Raises:
            FMUError: telling which machines it has some for.
        """
        wanted = platform_folder(self.version)
        if wanted not in self.platforms:
            raise FMUError(
                f"FMU '{self.name}' has no binary for this machine ({wanted}), only for "
                f"{', '.join(self.platforms) or 'none'}; ask its author for one, or for its sources"
            )

    def variable(self, name: str, among: Iterable[str] | None = None) -> ForeignVariable:
        """Return a variable, of all or `among` some.

        Raises:
            FMUError: for an unknown name, with the nearest one.
        """
        known = self.variables if among is None else among
        if name not in known:
            elsewhere = self.variables.get(name)
            told = f" (it is {elsewhere.causality}, {elsewhere.variability})" if elsewhere else ""
            raise FMUError(f"FMU '{self.name}' has no such variable '{name}'{told or nearest(name, known)}")
        return self.variables[name]

    def unit(self, name: str) -> str:
        """Return the unit that a variable is declared with, empty if it has none."""
        return self.variable(name).unit

    def measure(self, variable: ForeignVariable) -> Unit:
        """Return how the unit of a variable relates to SI; a variable without unit is taken as SI.

        Raises:
            FMUError: if the unit is not understood, or is declared to be another than its name says.
        """
        if not variable.unit:
            return Unit("1")
        unit = self.units.get(variable.unit) or self._read_unit(variable, variable.unit)
        if self.validate and unit.name in self._bare:
            raise FMUError(
                f"FMU '{self.name}': the unit {unit.name} of '{variable.name}' is declared without the "
                f"factor that its name has, as if it were {unit.si_name}; ask its author what it is "
                "(validate=False believes the declaration)"
            )
        return replace(unit, offset=0.0) if variable.relative else unit

    def converted(self, variable: ForeignVariable, value: Any) -> Any:
        """Return a value in the unit of its variable: a pair (value, unit) is converted."""
        if not (isinstance(value, tuple) and len(value) == 2 and isinstance(value[1], str)):
            return value
        number, name = value
        if not variable.unit:
            raise FMUError(
                f"FMU '{self.name}': '{variable.name}' declares no unit, so that {name} cannot be converted; "
                "give a plain number as its author means it"
            )
        known, own = None if name in self._bare else self.units.get(name), self.measure(variable)
        given = known if known is not None and known.fits(own) else self._read_unit(variable, name, own)
        given = replace(given, offset=0.0) if variable.relative else given
        if not own.fits(given):
            raise FMUError(
                f"FMU '{self.name}': '{variable.name}' is in {variable.unit}, not convertible from {name}"
            )
        return own.from_si(given.to_si(number))

    def _read_unit(self, variable: ForeignVariable, name: str, like: Unit | None = None) -> Unit:
        try:
            return unit_of(name, like)
        except ModelError as error:
            if name in self.units:
                return self.units[name]
            raise FMUError(f"FMU '{self.name}': '{variable.name}': {error}") from error


def _plain(name: str) -> str:
    return name.lower().rstrip("s")
