"""What an FMU says of itself, as text."""

from __future__ import annotations

from .description import FMUDescription
from .variable import ForeignVariable

CAPABILITIES = {
    "canGetAndSetFMUstate": "saves and restores its state",
    "canSerializeFMUstate": "serialises its state",
    "providesDirectionalDerivative": "directional derivatives",
    "providesAdjointDerivatives": "adjoint derivatives",
    "canHandleVariableCommunicationStepSize": "variable communication step",
    "canInterpolateInputs": "interpolates inputs",
    "hasEventMode": "event mode",
    "canBeInstantiatedOnlyOncePerProcess": "one instance a process only",
    "needsExecutionTool": "needs its tool installed",
}
LISTED_VARIABLES = 40


def info(fmu: FMUDescription) -> str:
    """Return what an FMU says of itself, as text."""
    lines = [f"{fmu.name}: FMI {fmu.version}, {' and '.join(fmu.kinds) or 'Scheduled Execution'}"]
    if fmu.description.description:
        lines.append(f"  {fmu.description.description}")
    lines.append(f"  made by     {fmu.tool}")
    lines.append(f"  binaries    {', '.join(fmu.platforms) or 'none'}")
    for kind in fmu.kinds:
        able = [text for name, text in CAPABILITIES.items() if fmu.capable(kind, name)]
        lines.append(f"  {kind:<11} {', '.join(able) or 'nothing optional'}")
    if fmu.defaults:
        lines.append("  suggested   " + ", ".join(f"{k} {v:g}" for k, v in fmu.defaults.items()))
    states, indicators = fmu.description.numberOfContinuousStates, fmu.description.numberOfEventIndicators
    lines.append(f"  states      {states}, event indicators {indicators}")
    for title in ("inputs", "outputs", "parameters"):
        lines += _listed(title, list(getattr(fmu, title).values()))
    lines += [f"  note: {note}" for note in fmu.notes]
    return "\n".join(lines)


def _listed(title: str, variables: list[ForeignVariable]) -> list[str]:
    if not variables:
        return []
    width = max(len(v.name) for v in variables[:LISTED_VARIABLES])
    lines = [f"  {title}"]
    for v in variables[:LISTED_VARIABLES]:
        unit = f"[{v.unit}]" if v.unit else ""
        start = f"= {v.start}" if v.start is not None else ""
        size = f"x {v.size}" if v.size > 1 else ""
        lines.append(
            "    " + "  ".join(p for p in (v.name.ljust(width), v.type, size, start, unit, v.text) if p)
        )
    if len(variables) > LISTED_VARIABLES:
        lines.append(f"    ... and {len(variables) - LISTED_VARIABLES} more")
    return lines
