"""What FMUs of one process say reaches who asked, whichever of them is gone."""

from __future__ import annotations

import gc
import shutil
from pathlib import Path
from typing import Any

import fmpy
import inertance as ia
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave
from inertance import FMUError
from inertance.fmu.foreign.in_process import LocalInstance

pytestmark = pytest.mark.skipif(
    not any(shutil.which(name) for name in ("cc", "gcc", "clang")), reason="there is no C compiler"
)
NOWHERE = 999_999


@pytest.fixture(scope="module", params=["2.0", "3.0"])
def path(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    net = ia.Network("coasting", m=ia.Mass(m=2.0, s=0.1, v=0.3))
    return ia.export_fmu(net, tmp_path_factory.mktemp("said") / "coasting.fmu", fmi_version=request.param)


def ask(instance: LocalInstance) -> str:
    with pytest.raises(FMUError) as refusal:
        instance.get([("Real" if instance.major == 2 else "Float64", [NOWHERE], 1)])
    return str(refusal.value)


def test_each_hears_its_own_and_goes_on_when_others_are_gone(path: Path) -> None:
    with LocalInstance(path, "CS") as first:
        second = LocalInstance(path, "CS")
        assert "it says: " in ask(first)
        assert not second.messages
        assert "it says: " in ask(second)
        assert len(first.messages) == 1
        second.close()
        del second
        gc.collect()
        assert ask(first).count(" | ") == 1


def test_those_who_use_fmpy_beside_are_told_as_ever(
    path: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    description: Any = fmpy.read_model_description(str(path))
    if description.fmiVersion != "2.0":
        pytest.skip("of FMI 3, each instance has its own function for messages")
    with LocalInstance(path, "CS"):
        pass
    gc.collect()
    slave: Any = FMU2Slave(
        guid=description.guid,
        unzipDirectory=str(fmpy.extract(str(path), str(tmp_path))),
        modelIdentifier=description.coSimulation.modelIdentifier,
    )
    slave.instantiate()
    with pytest.raises(FMICallException):
        slave.getReal([NOWHERE])
    slave.freeInstance()
    assert capfd.readouterr().out.startswith("[ERROR] fmi2GetReal: ")
