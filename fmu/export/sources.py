"""Sources: the C files of an FMU besides the model and the core."""

from __future__ import annotations

from pathlib import Path

from .variables import Interface

CSOURCE = Path(__file__).with_name("csource")
COMMON = ("fmi_common.h", "fmi_common.c", "fmi_numbers.c", "derivatives.c", "saved.c")
OWN = {
    "2.0": (*COMMON, "fmi2_face.h", "fmi2.c", "fmi2_run.c"),
    "3.0": (*COMMON, "fmi3_face.h", "fmi3.c", "fmi3_run.c", "fmi3_absent.c"),
}
HEADERS = {
    "2.0": ("fmi2Functions.h", "fmi2FunctionTypes.h", "fmi2TypesPlatform.h"),
    "3.0": ("fmi3Functions.h", "fmi3FunctionTypes.h", "fmi3PlatformTypes.h"),
}


def face_sources(fmi_version: str) -> dict[str, str]:
    """Return the FMI functions and the header files of the standard, by name."""
    import fmpy

    texts = {name: (CSOURCE / name).read_text(encoding="utf-8") for name in OWN[fmi_version]}
    standard = Path(fmpy.__file__).parent / "c-code"
    return texts | {name: (standard / name).read_text(encoding="utf-8") for name in HEADERS[fmi_version]}


def model_header(token: str, tolerance: float, fixed_step: float, face: Interface) -> str:
    """Return fmu_model.h: what the FMI functions know of the model."""
    inputs = [s.start for s in face.scalars if s.causality == "input"]
    lines = [
        "#ifndef FMU_MODEL_H",
        "#define FMU_MODEL_H",
        "",
        f'#define FMU_TOKEN "{token}"',
        f"#define FMU_TOLERANCE {tolerance!r}",
        f"#define FMU_FIXED_STEP {fixed_step!r}",
        f"#define FMU_AIMS {{{', '.join(map(str, face.aims)) or '0'}}}",
        f"#define FMU_INPUTS {_numbers(inputs)}",
        "",
        "#endif",
    ]
    return "\n".join([*lines, ""])


def _numbers(values: list[float | None]) -> str:
    return f"{{{', '.join(repr(float(v or 0.0)) for v in values) or '0'}}}"
