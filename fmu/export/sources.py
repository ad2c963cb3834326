"""Sources: the C files of an FMU besides the model and the core."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from .model_description import ExportedModel

CSOURCE = Path(__file__).with_name("csource")
DISCRETE = ("Boolean", "Integer")
COMMON = ("fmi_common.h", "fmi_common.c", "fmi_numbers.c", "model_exchange.c", "derivatives.c", "saved.c")
OWN_SOURCES = {
    "2.0": (*COMMON, "fmi2_face.h", "fmi2.c"),
    "3.0": (*COMMON, "fmi3_face.h", "fmi3.c", "fmi3_absent.c"),
}
HEADERS = {
    "2.0": ("fmi2Functions.h", "fmi2FunctionTypes.h", "fmi2TypesPlatform.h"),
    "3.0": ("fmi3Functions.h", "fmi3FunctionTypes.h", "fmi3PlatformTypes.h"),
}


def face_sources(fmi_version: str) -> dict[str, str]:
    """Return the FMI functions and the header files of the standard, by name."""
    import fmpy

    standard = Path(fmpy.__file__).parent / "c-code"
    paths = [CSOURCE / name for name in OWN_SOURCES[fmi_version]]
    paths += [standard / name for name in HEADERS[fmi_version]]
    return {path.name: path.read_text(encoding="utf-8") for path in paths}


def model_header(model: ExportedModel, fmi_version: str) -> str:
    """Return fmu_model.h: what the FMI functions know of the model, and of which standard they are."""
    typed = {kind: [s.reference for s in model.interface.scalars if s.type == kind] for kind in DISCRETE}
    inputs = [float(s.start or 0.0) for s in model.interface.scalars if s.causality == "input"]
    return f"""\
#ifndef FMU_MODEL_H
#define FMU_MODEL_H

#include "fmi{fmi_version[0]}_face.h"

#define FMU_TOKEN "{model.token}"
#define FMU_TOLERANCE {model.tolerance!r}
#define FMU_FIXED_STEP {model.fixed_step!r}
#define FMU_AIMS {_initializer(model.interface.aims)}
#define FMU_INPUTS {_initializer(inputs)}
#define FMU_BOOLEANS {_initializer(typed["Boolean"])}
#define FMU_INTEGERS {_initializer(typed["Integer"])}
#define NBOOLEAN {len(typed["Boolean"])}
#define NINTEGER {len(typed["Integer"])}

#endif
"""


def _initializer(values: Iterable[float]) -> str:
    return f"{{{', '.join(map(repr, values)) or '0'}}}"
