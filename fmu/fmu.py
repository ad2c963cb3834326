"""`FMU`: a block made by any tool, read from its .fmu file."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .foreign.description import FMUDescription

if TYPE_CHECKING:
    from .foreign.instance import Instance
    from .foreign.run import ForeignRun


class FMU(FMUDescription):
    """A block made by any tool: what it says of itself, and how to run it.

    Args:
        path: the .fmu file, FMI 2.0 or 3.0, Model Exchange ("ME"), Co-Simulation ("CS") or both.
        isolated: run its binary in a process of its own, so that a crash or a call that never returns
            is an error here and nothing worse. A call then costs about 0.1 ms more.
        timeout: longest time [s] that a call may take if isolated.
        validate: refuse a description that its XML schema does not allow; some tools wrote such ones.

    Reading runs nothing of the FMU. Its files are unpacked to a temporary folder while it runs.

    Raises:
        FMUError: if the archive is broken or unsafe, the description invalid, the FMI version unknown.

    Limits: no Scheduled Execution, clocks, binary variables or structural parameters.

    Example:
        >>> from inertance import FMU
        >>> pump = FMU("pump.fmu", isolated=True)                 # doctest: +SKIP
        >>> run = pump.simulate(2.0, parameters={"speed": (1500, "rpm")})  # doctest: +SKIP
        >>> run["flow"], run.unit("flow")                         # doctest: +SKIP
    """

    def __init__(
        self, path: str | Path, *, isolated: bool = False, timeout: float = 60.0, validate: bool = True
    ) -> None:
        super().__init__(path, validate=validate)
        self.isolated, self.timeout = isolated, timeout

    def instantiate(self, kind: str | None = None) -> Instance:
        """Load the binary and make an instance; close it after use (or use `with`).

        Raises:
            FMUError: if there is no binary for this machine, or it does not load.
        """
        from .foreign.in_process import LocalInstance
        from .foreign.subprocess_instance import IsolatedInstance

        kind = self.kind(kind)
        self.check_platform()
        if self.isolated:
            return IsolatedInstance(self.path, self.name, kind, self.timeout)
        return LocalInstance(self.path, kind)

    def simulate(
        self,
        stop: float | None = None,
        *,
        inputs: Mapping[str, Any] | None = None,
        parameters: Mapping[str, Any] | None = None,
        start: Mapping[str, Any] | None = None,
        begin: float | None = None,
        step: float | None = None,
        kind: str | None = None,
        rtol: float = 1e-6,
        record: Iterable[str] = (),
    ) -> ForeignRun:
        """Run the FMU alone.

        Model Exchange is integrated by LSODA (SciPy) with error control; state, time and step events are
        located and iterated to a fixed point. Co-Simulation is advanced by `step`, with event mode and
        early return where the FMU has them.

        Args:
            stop: end time [s]; the FMU's suggestion if not given.
            inputs: signals by name: a number, a function of time, `Sampled` or (time, values) data; what is
                discrete or no real number holds each value of its data until the next.
            parameters: values by name, in the FMU's own unit or as (value, unit): `(10, "kN/m")`.
            start: start values by name, likewise.
            begin: start time [s].
            step: output interval [s], the FMU's suggestion or a 500th of the run if not given; for "CS" the
                communication step.
            kind: "ME" or "CS"; Model Exchange first if it has both.
            rtol: relative tolerance; absolute is 1e-6 rtol times the nominal value of each state.
            record: variables to record besides outputs and states.

        Raises:
            FMUError: for unknown names, values out of range, and whatever the FMU fails in.
        """
        from .foreign.simulate import RunSettings, simulate_alone

        defaults = self.defaults
        begin = defaults.get("start", 0.0) if begin is None else begin
        step = defaults.get("step") if step is None else step
        stop = defaults.get("stop", begin + 1.0) if stop is None else stop
        settings = RunSettings(
            begin, stop, step, rtol, inputs or {}, parameters or {}, start or {}, tuple(record)
        )
        return simulate_alone(self, self.kind(kind), settings, self.instantiate)

    def info(self) -> str:
        """Return what it says of itself, as text."""
        from .foreign.info import info

        return info(self)

    def __repr__(self) -> str:
        kinds = " and ".join(self.kinds)
        return f"<FMU '{self.name}': FMI {self.version}, {kinds}, {len(self.variables)} variables>"
