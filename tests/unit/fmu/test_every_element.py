"""Every component there is goes into FMUs, many to one, that do what their networks do; and is linearised."""

from __future__ import annotations

import shutil

import inertance as ia
import numpy as np
import pytest
from elements import GRAVE, STARTS, elements, rig
from inertance.cli.catalogue import all_names
from inertance.fmu.check import derivatives

NAMES = sorted(set(elements()) - GRAVE, key=lambda name: (name in STARTS, name))  # GRAVE hold the others
FMUS = 4


@pytest.fixture
def whole(monkeypatch: pytest.MonkeyPatch) -> None:
    """Compare the derivatives of all elements."""
    monkeypatch.setattr(derivatives, "KNOWNS_COMPARED", 1000)


def warm_rig(name: str) -> ia.Network:
    """Return a component among bodies that are pushed, whose losses heat a body where they can."""
    return rig(name, still=True, **{"useHeatPort": True} if "useHeatPort" in all_names()[name].fields else {})


@pytest.mark.skipif(
    not any(shutil.which(name) for name in ("cc", "gcc", "clang")), reason="there is no C compiler"
)
@pytest.mark.parametrize("part", range(FMUS))
@pytest.mark.usefixtures("whole", "few_instances")
def test_an_fmu_of_many_elements_does_what_their_network_does(part: int) -> None:
    names = {name.replace(".", "_").lower(): name for name in NAMES[part::FMUS]}
    net = ia.Network("many", **{key: warm_rig(name) for key, name in names.items()})
    start = {f"{key}.{path}": v for key, name in names.items() for path, v in STARTS.get(name, {}).items()}
    version = ("2.0", "3.0")[part % 2]
    report = ia.fmu.check_fmu(net, 1.0, step=1e-2, versions=[version], start=start)
    assert report.passed, str(report)


@pytest.mark.parametrize("name", NAMES)
def test_every_element_is_linearised_about_a_run(name: str) -> None:
    dae = rig(name).dae()
    run = ia.simulate(dae, 1.0, start=STARTS.get(name))
    linear = ia.analysis.linearise(dae, at=run, time=0.7)
    assert np.isfinite(linear.A).all()
