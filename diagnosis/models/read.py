"""`read_model`: the model of a campaign, which may be an FMU or have one in it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from ...base import boolean, demand, instance
from ...components import ModelError, nearest
from ...fmu import FMU
from ...identification import Machine, fmu_and_kind, read_network
from ...networks import Network
from .fmu_model import FMUModel
from .fmu_network import recognised


def read_model(
    model: Network | str, port: Mapping[str, str], base: Path, validate: bool = True
) -> tuple[Network, Machine]:
    """Return the network of a campaign that is to be diagnosed, and what predicts its outputs.

    Args:
        model: the network, `path/to/file.py:function` that returns it, or `path/to/file.fmu`, with `:ME` or
            `:CS` after it to choose (Co-Simulation if it has both, which is several times faster).
        port: names of variables by "force", "position" and "velocity", where parts may be joined to an FMU.
        base: the folder that a relative path starts from.
        validate: whether to refuse an FMU whose description its schema does not allow.

    Raises:
        ModelError: telling what is wrong.
        FMUError: if the file is no FMU that can be run.
    """
    demand(
        "read_model()",
        model=(model, instance(Network, str)),
        port=(port, instance(Mapping)),
        base=(base, instance(Path)),
        validate=(validate, boolean),
    )
    foreign = fmu_and_kind(model)
    if foreign:
        path, kind = base / foreign[0], foreign[1]
        if not path.is_file():
            others = [p.name for p in path.parent.glob("*.fmu")] if path.parent.is_dir() else []
            raise ModelError(f"model: there is no file '{path}'{nearest(path.name, others)}")
        fmu = FMU(path, validate=validate)
        box = FMUModel(fmu, fmu.kind(kind or ("CS" if "CS" in fmu.kinds else None)), port)
        return box.network, box
    network, equations = read_network(model, port, base)
    return network, recognised(network) or equations
