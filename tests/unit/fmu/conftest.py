"""FMUs made for the tests: tiny ones in C, in every shape that an import must tell apart."""

from __future__ import annotations

import importlib.util
import shutil
import subprocess
import sys
import zipfile
from collections.abc import Callable, Iterator
from contextlib import nullcontext
from pathlib import Path
from typing import Any

import fmpy
import pytest
from inertance.fmu.check import against_network, sections, states
from inertance.fmu.check.other_process import OtherProcess

MODELS = {"body": 1, "ball": 2, "clock": 3, "saw": 4, "spring": 5, "relay": 6}
STATES = {
    "body": {"s": "m", "v": "m/s"},
    "ball": {"h": "m", "v": "m/s"},
    "clock": {"x": ""},
    "saw": {"x": ""},
    "spring": {},
    "relay": {"x": ""},
}
OTHERS = {
    "body": [("F", 2, "input", "N"), ("m", 3, "parameter", "kg"), ("fault", 5, "parameter", ""),
             ("when", 6, "parameter", "s")],
    "ball": [], "clock": [], "saw": [],
    "spring": [("s", 2, "input", "mm"), ("v", 7, "input", "m/s"), ("k", 3, "parameter", "N/m"),
               ("F", 4, "output", "N")],
    "relay": [("u", 2, "input", ""), ("y", 4, "output", "")],
}  # fmt: skip
STARTS = {"F": 0, "m": 2, "fault": 0, "when": 0, "s": 0, "v": 0, "k": 100, "u": 0}
UNITS = """<UnitDefinitions>
<Unit name="m"><BaseUnit m="1"/><DisplayUnit name="inch" factor="39.37007874015748"/></Unit>
<Unit name="mm"><BaseUnit m="1" factor="0.001"/></Unit><Unit name="m/s"><BaseUnit m="1" s="-1"/></Unit>
<Unit name="N"><BaseUnit kg="1" m="1" s="-2"/></Unit><Unit name="kg"><BaseUnit kg="1"/></Unit>
<Unit name="s"><BaseUnit s="1"/></Unit><Unit name="N/m"><BaseUnit kg="1" s="-2"/></Unit>
</UnitDefinitions>"""


def description(model: str, version: str = "2.0") -> str:
    """Return modelDescription.xml of one of the models."""
    lines = []
    for number, (name, unit) in enumerate(STATES[model].items()):
        start = int(model == "ball" and name == "h")
        lines.append(_variable(name, number, "output", unit, "exact", start))
    lines += [_variable(*other, start=STARTS.get(other[0])) for other in OTHERS[model]]
    count, states = len(lines), len(STATES[model])
    for number in range(states):
        lines.append(
            f'<ScalarVariable name="der({number})" valueReference="{100 + number}" causality="local">'
            f'<Real derivative="{number + 1}"/></ScalarVariable>'
        )
    derivatives = "".join(f'<Unknown index="{count + i + 1}"/>' for i in range(states))
    outputs = "".join(
        f'<Unknown index="{i + 1}"/>' for i, line in enumerate(lines[:count]) if '"output"' in line
    )
    face = f'modelIdentifier="{model}" canGetAndSetFMUstate="true"'
    slave = f'<CoSimulation {face} canHandleVariableCommunicationStepSize="true"/>'
    return (
        f'<?xml version="1.0" encoding="UTF-8"?>\n<fmiModelDescription fmiVersion="{version}" '
        f'modelName="{model}" guid="g" numberOfEventIndicators="{int(model in ("ball", "relay"))}">'
        f"<ModelExchange {face}/>{slave if model in ('body', 'spring') else ''}{UNITS}"
        f"<ModelVariables>{''.join(lines)}</ModelVariables><ModelStructure>"
        f"{_some('Outputs', outputs)}{_some('Derivatives', derivatives)}"
        f"{_some('InitialUnknowns', derivatives)}"
        "</ModelStructure></fmiModelDescription>"
    )


def _some(tag: str, content: str) -> str:
    return f"<{tag}>{content}</{tag}>" if content else ""


def _variable(
    name: str, reference: int, causality: str, unit: str, initial: str = "", start: float | None = None
) -> str:
    fixed = {"parameter": ' variability="fixed"'}.get(causality, "")
    chosen = f' initial="{initial}"' if initial else ""
    given = "" if start is None or (causality == "output" and not initial) else f' start="{start}"'
    bound = ' min="0.001"' if name == "m" else ""
    measured = f' unit="{unit}"' if unit else ""
    return (
        f'<ScalarVariable name="{name}" valueReference="{reference}" causality="{causality}"{fixed}{chosen}>'
        f"<Real{measured}{bound}{given}/></ScalarVariable>"
    )


MakeFMU = Callable[..., Path]
MACHINES = Path(__file__).parents[3] / "examples" / "fmu_models.py"


@pytest.fixture(scope="session")
def machines() -> Any:
    """The machines of examples/fmu_models.py."""
    spec = importlib.util.spec_from_file_location("fmu_models", MACHINES)
    assert spec
    assert spec.loader
    module = sys.modules["fmu_models"] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="session")
def make_fmu(tmp_path_factory: pytest.TempPathFactory) -> MakeFMU:
    """Return a function that compiles one of the models, once, and packs it as an .fmu."""
    compiler = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
    if compiler is None or fmpy.platform != "linux64":
        pytest.skip("needs a C compiler (cc, gcc or clang) on 64-bit Linux")
    folder = tmp_path_factory.mktemp("models")
    headers = Path(fmpy.__file__).parent / "c-code"

    def make(model: str, *defines: str) -> Path:
        path = folder / f"{'_'.join((model, *defines))}.fmu"
        if not path.exists():
            library = path.with_suffix(".so")
            flags = [f"-I{headers}", f"-DMODEL={MODELS[model]}", *(f"-D{d}" for d in defines)]
            source = Path(__file__).with_name("foreign.c")
            command = [
                compiler,
                "-shared",
                "-fPIC",
                "-O1",
                "-w",
                *flags,
                str(source),
                "-o",
                str(library),
                "-lm",
            ]
            subprocess.run(command, check=True)
            with zipfile.ZipFile(path, "w") as archive:
                archive.writestr("modelDescription.xml", description(model))
                archive.write(library, f"binaries/linux64/{model}.so")
        return path

    return make


@pytest.fixture(scope="session")
def other_process() -> Iterator[OtherProcess]:
    """The other process of many checks, of which each would else begin one of its own."""
    with OtherProcess() as other:
        yield other


@pytest.fixture
def few_instances(monkeypatch: pytest.MonkeyPatch, other_process: OtherProcess) -> None:
    """Let checks of FMUs make few instances, here and in one other process; test_jumps tries the others."""
    monkeypatch.setattr(states, "INSTANCES", 3)
    monkeypatch.setattr(states, "REPEATED", 2)
    for module in (against_network, sections):
        monkeypatch.setattr(module, "OtherProcess", lambda: nullcontext(other_process))
