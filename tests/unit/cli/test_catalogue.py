"""The catalogue of components: by family, found by words, drawn between their ports."""

import pytest
from inertance.cli import app
from inertance.cli.catalogue import all_names, by_family
from inertance.cli.sketch import sketch
from inertance.components.language import Port, RealInput, RealOutput
from typer.testing import CliRunner

runner = CliRunner()


@pytest.mark.parametrize("name", all_names())
def test_every_picture_shows_every_port_once(name: str) -> None:
    drawn = sketch(all_names()[name])
    for field in all_names()[name].fields.values():
        if isinstance(field, Port | RealInput | RealOutput):
            assert drawn.replace(",", " ").split().count(field.name) + drawn.count(f"--{field.name}") >= 1
    assert max(map(len, drawn.splitlines())) <= 79


def test_a_picture_is_as_one_would_draw_it() -> None:
    assert sketch(all_names()["Spring"]) == "  flange_a o--/\\/\\/\\--o flange_b"
    assert sketch(all_names()["signals.Switch"]) == "  u1 >--+\n  u2 >--[ Switch ]--> y\n  u3 >--+"


def test_families_hold_each_component_once() -> None:
    listed = [name for _, names in by_family() for name in names]
    assert sorted(listed) == sorted(all_names())
    titles = {name: title for title, names in by_family() for name in names}
    assert titles["CoulombFriction"] == titles["StribeckFriction"] != titles["Spring"]
    assert titles["Spring"].startswith("translational: ")


def test_words_find_what_has_them_all() -> None:
    found = runner.invoke(app, ["components", "--search", "friction temperature"])
    assert found.exit_code == 0
    assert "TemperatureDependentFriction" in found.stdout
    assert "CubicSpring" not in found.stdout
    nothing = runner.invoke(app, ["components", "--search", "flux capacitor"])
    assert nothing.exit_code == 2
    assert "no component mentions 'flux capacitor'" in nothing.output


def test_one_component_is_told_with_its_picture_and_what_it_derives() -> None:
    told = runner.invoke(app, ["components", "rotational.EddyCurrentBrake"]).stdout
    assert "tau_input >--" in told
    assert "lossPower" in told
    assert "with useHeatPort=True" in told
