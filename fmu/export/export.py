"""Export: a network as one FMU file, for Model Exchange and Co-Simulation."""

from __future__ import annotations

import hashlib
import math
import re
import uuid
from collections.abc import Iterable, Mapping, Sequence
from importlib import metadata
from pathlib import Path
from tempfile import TemporaryDirectory

from ...base import ModelError, check_output, demand, nearest, path_of, text
from ...networks import (
    DAE,
    PLATFORMS,
    CProgram,
    Network,
    c_program,
    compile_shared,
    corners_as_modes,
    dae_of,
    starting_point,
)
from .documentation import licences, page
from .icon import icon
from .model_description import ExportedModel, Rights, model_description
from .outputs import chosen_outputs, locals_of, state_names
from .package import build_description, library_path, write_archive
from .sources import face_sources, model_header
from .terminals import Terminal, publish, terminals_xml
from .variables import Interface, interface, resting

VERSIONS = ("2.0", "3.0")


def export_fmu(
    model: Network | DAE,
    path: str | Path,
    *,
    fmi_version: str = "2.0",
    outputs: Iterable[str] | None = None,
    inputs: Iterable[str] = (),
    terminals: Mapping[str, str] | None = None,
    start: Mapping[str, float] | None = None,
    platforms: Sequence[str] = ("native",),
    sources: bool = True,
    stop: float = 1.0,
    step: float = 1e-3,
    tolerance: float = 1e-6,
    fixed_step: float | None = None,
    author: str = "",
    version: str = "",
    copyright: str = "",
    license: str = "",
) -> Path:
    """Write a network as an FMU, for Model Exchange and Co-Simulation in one file.

    Every input without a signal becomes an input of the FMU; of an input that prescribes a motion, the
    derivatives that the equations need become inputs too, `der(x)` and `der(x,2)`. Parameters are
    tunable; start values of states can be set.

    Args:
        model: a network, or its equations.
        path: where to write, ending in `.fmu`.
        fmi_version: "2.0" or "3.0".
        outputs: names of the outputs, `*` for any part of one; else signals that go nowhere and what
            sensors measure, else the states.
        inputs: inputs of the network that have a signal and become inputs of the FMU nevertheless.
        terminals: flanges to turn into signals, `{"body.flange": "force-in"}`, or "motion-in"; see
            `fmu.publish`.
        start: fixed start values by name, as for `simulate`.
        platforms: "native" or of x86_64-linux, aarch64-linux, x86_64-windows, x86_64-darwin, aarch64-darwin.
        sources: whether the C sources go into the FMU.
        stop: end of the default experiment [s].
        step: communication step that suits the model [s].
        tolerance: relative tolerance where the importer gives none; a hundredth of it is absolute, times
            the nominal value of each state.
        fixed_step: step of the Co-Simulation's own stepper for real time [s]; else it controls its error.
        author: whose model it is; nothing is told of what is not given.
        version: of the model.
        copyright: notice.
        license: of the model, "proprietary" or "CC-BY-4.0"; that of the program around it stands in its
            documentation.

    Returns:
        The path.

    Raises:
        ModelError: for unknown names, versions, platforms and flanges, with the nearest name; for a path
            that cannot be written; and where no C compiler is found.

    Limits: a mode is read, not set. Sampled data bound to an input are part of the program.

    Example:
        >>> from tempfile import mkdtemp
        >>> from inertance import Fixed, Mass, Network, Spring, export_fmu
        >>> net = Network("oscillator", wall=Fixed(), spring=Spring(k=100.0), mass=Mass(m=1.0, s=0.1))
        >>> net = net.connect(net.wall.flange, net.spring.flange_a)
        >>> net = net.connect(net.spring.flange_b, net.mass.flange)
        >>> export_fmu(net, f"{mkdtemp()}/oscillator.fmu", fmi_version="3.0", platforms=[]).name
        'oscillator.fmu'
    """
    target = _target(path)
    lengths = {"stop": stop, "step": step, "fixed_step": 1.0 if fixed_step is None else fixed_step}
    _check(fmi_version, platforms, sources, tolerance, lengths)
    rights = _rights(author=author, version=version, copyright=copyright, license=license)
    published: list[Terminal] = []
    if terminals:
        if isinstance(model, DAE):
            raise ModelError(f"'{model.name}': terminals need the network, not its equations")
        model, published = publish(model, terminals)
    dae = dae_of(model)
    if not dae.name.strip():
        raise ModelError("an FMU is called after its network, whose name is empty; give Network(name)")
    leaving = [name for terminal in published for name in terminal.outputs]
    program, face = _program(dae, inputs, outputs, leaving, start or {})
    texts = {**program.files, **face_sources(fmi_version)}
    identifier = re.sub(r"\W", "_", dae.name, flags=re.ASCII)
    identifier = identifier if identifier[0].isalpha() else f"m{identifier}"
    token = _token(fmi_version, texts, face)
    compiled = tuple(sorted(name for name in texts if name.endswith(".c"))) if sources else ()
    told = ExportedModel(
        dae.name, identifier, token, metadata.version("inertance"), tolerance, step, stop, fixed_step or 0.0,
        compiled, face, rights,
    )  # fmt: skip
    texts["fmu_model.h"] = model_header(told, fmi_version)
    files: dict[str, bytes] = {
        "modelDescription.xml": model_description(told, fmi_version),
        "documentation/index.html": page(told, fmi_version).encode(),
        "documentation/licenses/license.txt": licences(rights).encode(),
    }
    picture = icon(dae.flat.instances[""].component)
    if picture is not None:
        files |= picture.files(fmi_version)
    if fmi_version == "3.0" and (published or picture is not None):
        names = [s.name for s in face.scalars]
        files["terminalsAndIcons/terminalsAndIcons.xml"] = terminals_xml(published, names, picture)
    if sources:
        files |= {f"sources/{name}": text.encode() for name, text in texts.items()}
        if fmi_version == "3.0":
            files["sources/buildDescription.xml"] = build_description(identifier, compiled)
    files |= _binaries(texts, identifier, fmi_version, platforms)
    write_archive(target, files)
    return target


def _target(path: str | Path) -> Path:
    target = path_of(path, "an FMU")
    if target.suffix != ".fmu":
        raise ModelError(f"an FMU is written to a file that ends in '.fmu', got '{path}'")
    check_output(target)
    return target


def _rights(**told: str) -> Rights:
    demand("export_fmu()", **{name: (value, text) for name, value in told.items()})
    return Rights(**{name: " ".join(value.split()) for name, value in told.items()})


def _check(
    fmi_version: str, platforms: Sequence[str], sources: bool, tolerance: float, lengths: Mapping[str, float]
) -> None:
    problems = []
    if fmi_version not in VERSIONS:
        problems.append(f"fmi_version must be one of {', '.join(VERSIONS)}, got {fmi_version!r}")
    known = ["native", *PLATFORMS]
    problems += [
        f"there is no platform '{p}'{nearest(p, known)}; there are {', '.join(known)}"
        for p in platforms
        if p not in known
    ]
    if not platforms and not sources:
        problems.append("an FMU needs sources or a platform to be compiled for")
    problems += [
        f"{name} must be above 0 s, got {value}"
        for name, value in lengths.items()
        if not 0 < value < math.inf
    ]
    if not 0 < tolerance < 1:
        problems.append(f"tolerance must lie between 0 and 1, got {tolerance}")
    if problems:
        raise ModelError("this FMU cannot be exported:", problems)


def _program(
    dae: DAE,
    inputs: Iterable[str],
    outputs: Iterable[str] | None,
    more: Sequence[str],
    fixed: Mapping[str, float],
) -> tuple[CProgram, Interface]:
    """Return the C program of a network and the interface of an FMU around it."""
    asked, known = set(inputs), dae.input_names
    unknown = [f"there is no input '{name}'{nearest(name, known)}" for name in asked if name not in known]
    if unknown:
        raise ModelError("inputs of the FMU:", unknown)
    free = [k for k, given in enumerate(dae.inputs) if given.signal is None or given.path in asked]
    start = starting_point(dae, {dae.inputs[k].path: resting(dae.inputs[k]) for k in free}, fixed)
    states = state_names(dae, start.given)
    shown = list(dict.fromkeys([*chosen_outputs(dae, outputs, states), *more]))
    named = {*states, *(f"der({name})" for name in states)}
    others = {*named, *dae.switching.mode_names, *(dae.inputs[k].path for k in free)}
    variables = [name for name in shown if name not in others]
    variables += locals_of(dae, [*states, *variables])
    named.update(variables)
    variables += [aim.name for aim in start.aims if aim.name not in named]
    dae = corners_as_modes(dae)
    program = c_program(dae, inputs=dict.fromkeys(asked), variables=variables, start=start)
    return program, interface(dae, start, free, states, variables, shown)


def _token(fmi_version: str, texts: Mapping[str, str], face: Interface) -> str:
    """Return the identity of an FMU, which its program and its variables make."""
    digest = hashlib.sha256(fmi_version.encode())
    for name in sorted(texts):
        digest.update(f"{name}\0{texts[name]}\0".encode())
    digest.update(repr(face.scalars).encode())
    return f"{{{uuid.UUID(bytes=digest.digest()[:16])}}}"


def _binaries(
    texts: Mapping[str, str], identifier: str, fmi_version: str, platforms: Sequence[str]
) -> dict[str, bytes]:
    """Compile the sources for each platform."""
    found: dict[str, bytes] = {}
    with TemporaryDirectory() as folder:
        for name, text in texts.items():
            (Path(folder) / name).write_text(text, encoding="utf-8")
        compiled = [Path(folder) / name for name in sorted(texts) if name.endswith(".c")]
        for platform in platforms:
            inside = library_path(identifier, fmi_version, platform)
            out = Path(folder) / Path(inside).name
            compile_shared(compiled, out, None if platform == "native" else platform, flags=("-s",))
            found[inside] = out.read_bytes()
    return found
