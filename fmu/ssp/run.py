"""What the FMUs of a system did together."""

from __future__ import annotations

from dataclasses import dataclass, field

from ...base import Array
from ..cosimulation.step_error import ExchangeRun
from ..foreign.run import RecordedVariables


@dataclass(eq=False)
class SystemRun(RecordedVariables, ExchangeRun):
    """What the FMUs of a system did together; `run["body.mass.s"]` is `mass.s` of the component `body`.

    At an event two points share one time: before and after. Of every FMU there are outputs and states.
    """

    system: str
    units: dict[str, str] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        runs = self.fmus.items()
        self.units = {f"{name}.{v}": unit for name, run in runs for v, unit in run.units.items()}

    @property
    def name(self) -> str:
        """Name of the system."""
        return self.system

    @property
    def time(self) -> Array:
        """Instants of the points [s]."""
        return next(iter(self.fmus.values())).time

    def __getitem__(self, name: str) -> Array:
        """Return a variable along the run.

        Raises:
            UnknownNameError: if it was not recorded, with the nearest name.
        """
        if name == "time":
            return self.time
        component, _, variable = self.known(name).partition(".")
        return self.fmus[component][variable]
