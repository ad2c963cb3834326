"""Local instances: a loaded binary of an FMU in this process, FMI 2 and 3 alike."""

from __future__ import annotations

import ctypes
from collections import deque
from collections.abc import Callable
from contextlib import chdir, suppress
from pathlib import Path
from threading import Lock
from typing import Any, Self

from ..errors import FMUError
from .archive import library_name
from .instance import Group, Stepped, Update, Values
from .messages import callbacks_for
from .model_description import FACES
from .unpacked import Unpacked

KEPT_MESSAGES, NAMED_FUNCTIONS, MOST_ITERATIONS = 5, 6, 1000
NAMES = {  # of FMPy, for FMI 2 and FMI 3
    "set": ("fmi2SetReal", "fmi3SetFloat64"),
    "get": ("fmi2GetReal", "fmi3GetFloat64"),
    "rates": ("getDerivatives", "getContinuousStateDerivatives"),
    "update": ("newDiscreteStates", "updateDiscreteStates"),
    "Enumeration": ("Integer", "Int64"),
}
CASTS: dict[str, Callable[[Any], Any]] = {
    "Real": float, "Float64": float, "Float32": float, "String": str, "Boolean": bool,
}  # fmt: skip
_LOADING = Lock()


class LocalInstance:
    """An instance in this process; only plain numbers, texts and lists pass.

    Its files are its own, in a temporary folder, or those given; `events` asks for event mode. A group is
    (FMI type, value references, number of values). The inputs chosen at the start are set with every
    evaluation.

    Attributes:
        instance: FMPy's object.
        event_mode: whether Co-Simulation has event mode.
        interpolates: whether Co-Simulation follows rates of the inputs.
    """

    def __init__(
        self, path: Path, kind: str, *, files: Unpacked | None = None, events: bool = True
    ) -> None:  # fmt: skip
        from fmpy.fmi1 import FMICallException

        self.kind, self.messages = kind, deque[str](maxlen=KEPT_MESSAGES)
        self._files, self._shared = files or Unpacked(path), files is not None
        self.description = self._files.description
        self.name, self.major = self.description.modelName, self.description.fmiMajorVersion
        self._names = {role: names[self.major - 2] for role, names in NAMES.items()}
        self._inputs, self._failure = list[int](), FMICallException
        self._kept: dict[str, Any] = {}
        self.instance: Any = None
        face = getattr(self.description, FACES[kind])
        self._steps_completed = kind == "ME" and face.needsCompletedIntegratorStep
        self.event_mode = events and kind == "CS" and bool(face.hasEventMode)
        self.interpolates = kind == "CS" and self.major == 2 and bool(face.canInterpolateInputs)
        try:
            self._load(face)
        except BaseException:
            self._leave()
            raise
        nx, nz = self.description.numberOfContinuousStates, self.description.numberOfEventIndicators
        self._x, self._dx, self._z = ((ctypes.c_double * n)() for n in (nx, nx, nz))

    def _leave(self) -> None:
        if not self._shared:
            self._files.remove()

    def _load(self, face: Any) -> None:
        library = self._files.folder / "binaries" / self._files.binaries / library_name(face.modelIdentifier)
        kind = _fmpy_class(self.major, self.kind)
        _check_symbols(self.name, library, kind)
        options: dict[str, Any]
        if self.major == 2:
            options = {"callbacks": callbacks_for(self)}
        else:
            options = {"logMessage": self.hear}
            if self.kind == "CS":
                options |= {"earlyReturnAllowed": self.event_mode, "eventModeUsed": self.event_mode}
        try:
            with _LOADING, chdir("."):  # FMPy goes into the folder of the library meanwhile
                self.instance = kind(
                    guid=self.description.guid, unzipDirectory=str(self._files.folder),
                    modelIdentifier=face.modelIdentifier,
                )  # fmt: skip
                self.instance.instantiate(**options)
        except Exception as error:
            tool = self.description.generationTool or "the tool that made it"
            needed = f"; it needs {tool} installed here" if face.needsExecutionTool else ""
            raise FMUError(
                f"FMU '{self.name}' could not be instantiated: {error}{self._said()}{needed}"
            ) from error

    def hear(self, *told: Any) -> None:
        """Keep a message of the FMU."""
        texts = [t.decode("utf-8", "replace") for t in told if isinstance(t, bytes)]
        self.messages.append(texts[-1] if texts else "")

    def _said(self) -> str:
        said = " | ".join(message.strip() for message in self.messages if message.strip())
        return f"; it says: {said}" if said else ""

    def _call(self, method: str, *arguments: Any) -> Any:
        try:
            return getattr(self.instance, method)(*arguments)
        except self._failure as error:
            raise FMUError(f"FMU '{self.name}': {error}{self._said()}") from error

    def start(
        self, begin: float, stop: float, rtol: float, values: list[tuple[Group, Values]], inputs: list[int]
    ) -> None:
        """Set values and enter initialization mode."""
        self._inputs, self._driven = inputs, self._reals(inputs)
        tolerance = rtol if self.kind == "CS" else None
        if self.major == 2:
            self._call("setupExperiment", tolerance, begin, stop)
        for group, numbers in values:
            self.set(group, numbers)
        self._call("enterInitializationMode", *(() if self.major == 2 else (tolerance, begin, stop)))

    def started(self) -> None:
        """Leave initialization mode."""
        self._call("exitInitializationMode")

    def set(self, group: Group, values: Values) -> None:
        """Set variables of one type."""
        kind, references, _ = group
        cast = CASTS.get(kind, int)
        self._call(f"set{self._names.get(kind, kind)}", references, [cast(value) for value in values])

    def get(self, groups: list[Group]) -> Values:
        """Return the values of variables, group after group, as numbers."""
        found: Values = []
        for kind, references, count in groups:
            extra = (count,) if self.major == 3 else ()
            found += map(float, self._call(f"get{self._names.get(kind, kind)}", references, *extra))
        return found

    def _reals(self, references: list[int]) -> tuple[Any, tuple[Any, ...]]:
        """Return an array for real variables, and the arguments with which FMI sets or gets it as a whole."""
        count = len(references)
        values, place = (ctypes.c_double * count)(), (ctypes.c_uint32 * count)(*references)
        more = () if self.major == 2 else (count,)
        return values, (self.instance.component, place, count, values, *more)

    def drive(self, inputs: Values) -> None:
        """Set the inputs chosen at the start."""
        if self._inputs:
            values, arguments = self._driven
            values[:] = inputs
            self._call(self._names["set"], *arguments)

    def _at(self, t: float, x: Values, inputs: Values) -> None:
        self._call("setTime", t)
        if len(x):
            self._x[:] = x
            self._call("setContinuousStates", self._x, len(x))
        self.drive(inputs)

    def _read(self, method: str, values: Any) -> Values:
        if len(values):
            self._call(method, values, len(values))
        return list(values)

    def states(self) -> Values:
        """Return the continuous states."""
        return self._read("getContinuousStates", self._x)

    def nominals(self) -> Values:
        """Return the sizes of the continuous states."""
        return self._read("getNominalsOfContinuousStates", self._dx)

    def derivatives(self, t: float, x: Values, inputs: Values) -> Values:
        """Return the rates of the states at a point."""
        self._at(t, x, inputs)
        return self._rates()

    def _rates(self) -> Values:
        return self._read(self._names["rates"], self._dx)

    def indicators(self, t: float, x: Values, inputs: Values) -> Values:
        """Return the event indicators at a point."""
        self._at(t, x, inputs)
        return self.watched()

    def watched(self) -> Values:
        """Return the event indicators where it stands."""
        return self._read("getEventIndicators", self._z)

    def look(self, t: float, x: Values, inputs: Values, groups: list[Group]) -> Values:
        """Return variables at a point."""
        self._at(t, x, inputs)
        return self.get(groups)

    def completed_step(self) -> tuple[bool, bool]:
        """Tell the FMU that a step was accepted; return whether it wants event mode, or an end."""
        if not self._steps_completed:
            return False, False
        enter, terminate = self._call("completedIntegratorStep", not self._kept)
        return bool(enter), bool(terminate)

    def enter_events(self) -> None:
        """Enter event mode."""
        self._call("enterEventMode")

    def update(self) -> Update:
        """Iterate events until none is left and leave event mode."""
        for _ in range(MOST_ITERATIONS):
            again, terminate, _, _, timed, following = self._call(self._names["update"])
            if terminate or not again:
                break
        else:
            raise FMUError(f"FMU '{self.name}': its event iteration has no end{self._said()}")
        if not terminate:
            self._call("enterContinuousTimeMode" if self.kind == "ME" else "enterStepMode")
        return Update(bool(terminate), float(following) if timed else None)

    def step(self, t: float, duration: float, inputs: Values, rates: Values) -> Stepped:
        """Advance a Co-Simulation FMU; rates of the inputs are used if it interpolates, else ignored."""
        self.drive(inputs)
        if self.interpolates and self._inputs and len(rates):
            self._call("setRealInputDerivatives", self._inputs, [1] * len(self._inputs), rates)
        if self.major == 2:
            return self._step_2(t, duration)
        event, terminate, early, reached = self._call("doStep", t, duration, not self._kept)
        return Stepped(reached if early else t + duration, bool(event), bool(terminate))

    def _step_2(self, t: float, duration: float) -> Stepped:
        from fmpy.fmi2 import fmi2Discard, fmi2LastSuccessfulTime, fmi2Terminated

        try:
            self.instance.doStep(t, duration, not self._kept)
        except self._failure as error:
            if error.status != fmi2Discard:
                raise FMUError(f"FMU '{self.name}' at t = {t:g} s: {error}{self._said()}") from error
            reached = self._call("getRealStatus", fmi2LastSuccessfulTime)
            if self._call("getBooleanStatus", fmi2Terminated):
                return Stepped(reached, False, True)
            raise FMUError(
                f"FMU '{self.name}' refused the communication step of {duration:g} s at t = {t:g} s and "
                f"came to {reached:g} s; give a smaller step"
            ) from error
        return Stepped(t + duration, False, False)

    def save(self, place: str = "") -> None:
        """Keep the present state; a new one replaces that of the same place."""
        if place in self._kept:
            self._call("freeFMUState", self._kept.pop(place))
        self._kept[place] = self._call("getFMUState")

    def restore(self, place: str = "") -> None:
        """Go back to the state kept."""
        self._call("setFMUState", self._kept[place])

    def close(self) -> None:
        """Free the instance and remove its files."""
        slave, self.instance = self.instance, None
        if slave is None:
            return
        with suppress(Exception):
            for state in self._kept.values():
                slave.freeFMUState(state)
        with suppress(Exception):
            slave.terminate()
        slave.freeInstance()
        self._leave()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def _fmpy_class(major: int, kind: str) -> Any:
    from fmpy import fmi2, fmi3

    return getattr(fmi2 if major == 2 else fmi3, f"FMU{major}{'Model' if kind == 'ME' else 'Slave'}")


def _check_symbols(name: str, library: Path, face: Any) -> None:
    """Load a library and refuse it if a function that FMI demands is not in it, before any is called."""
    from fmpy import freeLibrary

    if not library.is_file():
        raise FMUError(f"FMU '{name}' has no library '{library.name}' among its binaries for this machine")
    try:
        loaded = ctypes.CDLL(str(library))
    except OSError as error:
        raise FMUError(f"FMU '{name}': its binary does not load: {error}") from error
    missing = [n for n in dir(face) if n.startswith(("fmi2", "fmi3")) and not hasattr(loaded, n)]
    freeLibrary(loaded._handle)
    if missing:
        more = [f"{len(missing) - NAMED_FUNCTIONS} more"] if len(missing) > NAMED_FUNCTIONS else []
        told = ", ".join(missing[:NAMED_FUNCTIONS] + more)
        raise FMUError(f"FMU '{name}': its binary lacks FMI functions: {told}")
