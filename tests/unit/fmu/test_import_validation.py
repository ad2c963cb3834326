"""What breaks the standard: told and mended where nothing depends on it, refused where a number could."""

from __future__ import annotations

import pickle
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from inertance import FMU, Fixed, FMUError, InertanceError, Mass, Network, Spring, export_fmu
from inertance.cli import app
from inertance.diagnosis import read_model
from inertance.identification import Campaign, Record
from typer.testing import CliRunner

LATE = '<Annotations><Annotation type="org.tool">kept</Annotation></Annotations>'


@pytest.fixture(scope="module")
def good(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """A sound FMU of either version."""
    net = Network("small", wall=Fixed(), spring=Spring(k=100.0), mass=Mass(m=1.0, s=0.1))
    net.connect(net.wall.flange, net.spring.flange_a)
    net.connect(net.spring.flange_b, net.mass.flange)
    folder = tmp_path_factory.mktemp("good")
    return {v: export_fmu(net, folder / f"{v}.fmu", fmi_version=v) for v in ("2.0", "3.0")}


def edited(good: Path, folder: Path, *edits: tuple[str, str]) -> Path:
    path = folder / "edited.fmu"
    with zipfile.ZipFile(good) as archive, zipfile.ZipFile(path, "w") as copy:
        for name in archive.namelist():
            content = archive.read(name)
            if name == "modelDescription.xml":
                text = content.decode()
                for old, new in edits:
                    assert old in text, old
                    text = text.replace(old, new, 1)
                content = text.encode()
            copy.writestr(name, content)
    return path


HARMLESS = [
    (
        "3.0",
        "<ModelVariables>",
        f"{LATE}<ModelVariables>",
        "'ModelVariables' in 'fmiModelDescription' comes too late",
    ),
    (
        "3.0",
        "<UnitDefinitions>",
        "<LogCategories/><UnitDefinitions>",
        "'LogCategories' is not as the schema wants",
    ),
    ("3.0", "<ModelStructure>", f"<ModelStructure>{LATE}", "in 'ModelStructure' comes too late"),
    (
        "3.0",
        "</fmiModelDescription>",
        "<Annotations><Note/></Annotations></fmiModelDescription>",
        "'Annotations'",
    ),
    ("3.0", "<fmiModelDescription", '<fmiModelDescription flavour="mild"', "flavour='mild'"),
    ("3.0", "<fmiModelDescription", '<fmiModelDescription generationDateAndTime="Tuesday"', "Time='Tuesday'"),
    (
        "2.0",
        "<ModelVariables>",
        '<VendorAnnotations><Toll name="x"/></VendorAnnotations><ModelVariables>',
        "Vendor",
    ),
    ("2.0", "<UnitDefinitions>", "<TypeDefinitions/><UnitDefinitions>", "'TypeDefinitions'"),
    ("2.0", 'causality="parameter"', 'causality="parameter" sort="3"', "sort='3' of 'ScalarVariable'"),
    ("2.0", "<CoSimulation ", "<CoSimulation pretty='yes' ", "pretty='yes'"),
]


@pytest.mark.parametrize(("version", "old", "new", "told"), HARMLESS, ids=[h[3] for h in HARMLESS])
def test_what_harms_nothing_is_told(
    good: dict[str, Path], tmp_path: Path, version: str, old: str, new: str, told: str
) -> None:
    fmu, sound = FMU(edited(good[version], tmp_path, (old, new))), FMU(good[version])
    assert any(told in note for note in fmu.notes), fmu.notes
    assert fmu.variables == sound.variables
    assert fmu.units == sound.units
    assert (fmu.simulate(0.5)["mass.s"] == sound.simulate(0.5)["mass.s"]).all()
    assert told in fmu.info()


def test_annotations_behind_the_dimensions_of_every_variable(good: dict[str, Path], tmp_path: Path) -> None:
    """As Dymola writes them."""
    variables = FMU(good["3.0"]).variables
    extra = "".join(
        f'<Float64 name="x{i}" valueReference="{9000 + i}" causality="local" variability="discrete" '
        f'initial="exact" start="1 2"><Dimension start="2"/>{LATE}</Float64>'
        for i in range(3)
    )
    fmu = FMU(edited(good["3.0"], tmp_path, ("</ModelVariables>", f"{extra}</ModelVariables>")))
    assert len(fmu.variables) == len(variables) + 3
    assert fmu.notes == [
        "'Annotations' in 'Float64' comes too late; its place was taken as if it were right (3 times)"
    ]


HARMFUL = [
    ("2.0", "<ModelStructure>", "<ModelStructure><Outpus/>", "'Outpus'"),
    ("2.0", 'name="mass.m"', 'nane="mass.m"', "nane"),
    ("2.0", 'causality="parameter"', 'causality="parametre"', "parametre"),
    ("2.0", 'start="100.0"', 'start="1OO"', "1OO"),
    ("2.0", "<UnitDefinitions>", "<UnitDefinition/><UnitDefinitions>", "'UnitDefinition'"),
    ("2.0", "<CoSimulation ", '<CoSimulation needsExecutionTool="maybe" ', "maybe"),
    ("2.0", 'name="mass.m"', 'name="spring.k"', "two variables called 'spring.k'"),
    ("3.0", "<ContinuousStateDerivative", "<ContinuousStatesDerivative", "ContinuousStatesDerivative"),
    ("3.0", "</ModelVariables>", "</ModelVariables><ModelVariables/>", "ModelVariables"),
]


@pytest.mark.parametrize(("version", "old", "new", "told"), HARMFUL, ids=[h[3] for h in HARMFUL])
def test_what_could_change_a_number_is_refused(
    good: dict[str, Path], tmp_path: Path, version: str, old: str, new: str, told: str
) -> None:
    with pytest.raises(FMUError, match=told):
        FMU(edited(good[version], tmp_path, (old, new)))


def test_the_command_line_tries_what_is_refused(good: dict[str, Path], tmp_path: Path) -> None:
    path = edited(good["2.0"], tmp_path, ("<UnitDefinitions>", "<UnitDefinition/><UnitDefinitions>"))
    arguments = ["fmu", "import-test", str(path), "--stop", "0.1", "--no-isolated"]
    refused = CliRunner().invoke(app, arguments)
    assert refused.exit_code == 1
    assert "--no-validate" in refused.output
    tried = CliRunner().invoke(app, [*arguments, "--no-validate"])
    assert tried.exit_code == 0
    assert "Element 'UnitDefinition'" in tried.output
    assert "mass.s: " in tried.output


def test_a_campaign_tries_what_is_refused(good: dict[str, Path], tmp_path: Path) -> None:
    edited(good["2.0"], tmp_path, ("<UnitDefinitions>", "<UnitDefinition/><UnitDefinitions>"))
    t = np.linspace(0.0, 1.0, 11)
    entries: dict[str, Any] = {
        "model": "edited.fmu", "base": tmp_path, "parameters": {"spring.k": {"rel": 0.1}},
        "channels": {"x": {"output": "mass.s", "unit": "m"}},
        "train": [{"record": Record("run", t, {"x": np.cos(t)}), "initial": "rest"}], "noise": {"x": 1e-3},
        "reader": read_model,
    }  # fmt: skip
    with pytest.raises(InertanceError, match="UnitDefinition"):
        Campaign(**entries)
    campaign = Campaign(**entries, validate=False)
    assert pickle.loads(campaign.pickled()).outputs == ["x"]
