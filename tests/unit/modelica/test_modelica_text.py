"""Modelica text: what it says of a network, and what it refuses to say."""

from __future__ import annotations

import math
import re
from pathlib import Path

import casadi as ca
import inertance as ia
import pytest
from inertance import signals
from inertance.cli import app
from inertance.components.language import Stated, parameter, variable
from inertance.modelica import write_modelica
from inertance.modelica.expressions import Printer
from typer.testing import CliRunner

MODEL = """
import inertance as ia


def build():
    net = ia.Network("oscillator", wall=ia.Fixed(), spring=ia.Spring(k=100.0), mass=ia.Mass(m=1.0, s=0.1))
    net.connect(net.wall.flange, net.spring.flange_a)
    return net.connect(net.spring.flange_b, net.mass.flange)
"""


def held(**parts: ia.Component) -> ia.Network:
    net = ia.Network("held", wall=ia.Fixed(), mass=ia.Mass(m=2.0, s=0.5), **parts)
    for name in parts:
        part = getattr(net, name)
        net.connect(net.wall.flange, part.flange_a)
        net.connect(part.flange_b, net.mass.flange)
    return net


def test_the_standard_library_has_what_it_has_and_the_rest_is_ours() -> None:
    text = ia.to_modelica(held(spring=ia.Spring(k=3.0), inerter=ia.Inerter(b=4.0)))
    assert "Modelica.Mechanics.Translational.Components.Spring spring(c=3, s_rel0=0);" in text
    assert "Modelica.Mechanics.Translational.Components.Mass mass(m=2" in text
    assert len(re.findall(r"start=-?0\.5, fixed=true", text)) == 1
    assert len(re.findall("fixed=true", text)) == 2
    assert "connect(spring.flange_b, mass.flange_a);" in text
    assert "model Inerter " in text
    assert "f = b*a_rel;" in text
    assert "flange" in text
    assert "model Spring " not in text


def test_without_the_library_nothing_of_it_is_left() -> None:
    text = ia.to_modelica(held(spring=ia.Spring(k=3.0), other=ia.Spring(k=4.0)), msl=False)
    assert "Modelica." not in text
    assert text.count("model Spring ") == 1
    assert "Spring other(k=4, s_rel0=0);" in text


def test_a_subclass_and_an_option_are_not_the_librarys() -> None:
    class Mine(ia.Spring):
        """A spring of ours."""

    text = ia.to_modelica(held(a=Mine(k=1.0)))
    assert "Mine a(k=1, s_rel0=0)" in text
    warm = ia.Position(exact=False)
    net = ia.Network("n", drive=warm, mass=ia.Mass(m=1.0)).connect(warm.flange)
    assert "Sources.Position" not in ia.to_modelica(net)


def test_words_of_modelica_and_odd_names() -> None:
    net = ia.Network('2 of: a"b', **{"when": ia.Mass(m=1.0), "input": ia.Mass(m=2.0), "Real": ia.Mass(m=3.0)})
    text = ia.to_modelica(net)
    assert text.startswith('model m2_of__a_b "2 of: a\\"b: ')
    for name in ("when_", "input_", "Real_"):
        assert f"Mass {name}(m=" in text


def test_a_free_input_deep_inside_becomes_an_input_of_the_model() -> None:
    class Driven(ia.Component):
        """A mass that is pushed."""

        push = ia.Force()
        mass = ia.Mass(m=1.0)

        def connections(self) -> Stated:
            yield self.push.flange, self.mass.flange

    text = ia.to_modelica(ia.Network("n", pair=Driven()))
    assert 'input Real pair_push_f(unit="N");' in text
    assert "pair.push_f = pair_push_f;" in text
    assert "connect(push_f, push.f);" in text


def test_a_port_deep_inside_is_shown() -> None:
    net = held(chain=ia.series(ia.Spring(k=3.0), ia.Damper(d=4.0)))
    net.add(tip=ia.Mass(m=0.1)).connect(net.chain.spring.flange_b, net.tip.flange)
    text = ia.to_modelica(net)
    assert "TranslationalFlange spring_flange_b;" in text
    assert "connect(chain.spring_flange_b, tip.flange_a);" in text


def test_what_is_inserted_stands_between() -> None:
    net = held(spring=ia.Spring(k=3.0))
    net.insert(net.spring.flange_b, play=ia.Backlash(k=1.0, d=1.0, eps=1e-3))
    text = ia.to_modelica(net)
    assert "connect(spring.flange_b, play.flange_a);" in text
    assert "connect(play.flange_b, mass.flange_a);" in text


def test_expressions_keep_their_value() -> None:
    x, y = ca.SX.sym("x"), ca.SX.sym("y")
    printer = Printer({x.element_hash(): "x", y.element_hash(): "y"})
    several = [
        x - (y - x), x / (y / x), (x + y) * (x - y), -(x + y), -x * y, (x * x) ** (y - 1), (-x) ** 2, x - -y,
        1 / (x * y), ca.if_else(x > y, -x, y), ca.fmax(x, -y) - ca.fmin(x, y), ca.if_else(x == 0, 1, 2) + x,
        ca.logic_and(x > 0, ca.logic_not(y <= 0)) * x, 2 * x * -y, x * (y / x) * 1e-20,
        ca.asinh(x) - ca.fabs(y),
    ]  # fmt: skip
    for expression in several:
        text = printer.number(expression).replace("^", "**")
        for values in ((0.7, -1.3), (-2.5, 0.4), (3.0, 2.0)):
            wanted = float(ca.Function("f", [x, y], [expression])(*values))
            assert modelica_value(text, *values) == pytest.approx(wanted, rel=1e-12), (expression, text)


def modelica_value(text: str, x: float, y: float) -> float:
    """Return the value of a Modelica expression, by Python's own grammar."""
    text = text.replace("(if ", "choose(").replace(" then ", ", ").replace(" else ", ", ")
    scope = {"x": x, "y": y, "log": math.log, "sqrt": math.sqrt, "abs": abs, "max": max, "min": min}
    return float(eval(text, scope | {"choose": lambda condition, yes, no: yes if condition else no}))


@pytest.mark.parametrize(
    ("part", "told"),
    [
        (ia.HardStop(e=0.5), "HardStop 'it' lets a shock act"),
        (ia.Inerter(b=-1.0), "b must be at least 0"),
    ],
)
def test_what_cannot_be_said_is_an_error_with_its_name(part: ia.Component, told: str) -> None:
    with pytest.raises(ia.ModelError, match=told):
        ia.to_modelica(held(it=part))


def test_sampled_data_are_refused() -> None:
    data = ia.Sampled([0.0, 1.0, 2.0, 3.0], [0.0, 1.0, 0.0, 1.0])
    net = ia.Network("n", push=ia.Force(f=data), mass=ia.Mass(m=1.0))
    net.connect(net.push.flange, net.mass.flange)
    with pytest.raises(ia.ModelError, match=r"input 'push\.f': sampled data .* leave the input free"):
        ia.to_modelica(net)


def test_inserting_inside_a_part_is_refused() -> None:
    net = held(chain=ia.series(ia.Spring(k=3.0), ia.Damper(d=4.0)))
    net.insert(net.chain.spring.flange_b, play=ia.Backlash(k=1.0, d=1.0, eps=1e-3))
    with pytest.raises(ia.ModelError, match=r"inserted at .* inside a part"):
        ia.to_modelica(net)


def test_arguments_and_paths() -> None:
    net = held(spring=ia.Spring(k=3.0))
    with pytest.raises(ia.ModelError, match="stop must be"):
        ia.to_modelica(net, stop=-1.0)
    with pytest.raises(ia.ModelError, match=r"ends in '\.mo'"):
        write_modelica(net, "it.txt")


def test_units_that_modelica_cannot_write_are_left_out() -> None:
    class Odd(ia.Compliant):
        """f = k s_rel^n."""

        k = parameter("N/m^n", "stiffness")
        d = parameter("N/kg.m", "of a product")
        e = variable("m", "stretch")

        def equations(self) -> Stated:
            yield self.e == self.s_rel
            yield self.f == self.k * self.e + self.d * self.e

    text = ia.to_modelica(held(odd=Odd(k=2.0, d=1.0)))
    assert 'parameter Real k "stiffness";' in text
    assert 'parameter Real d(unit="N/(kg.m)") "of a product";' in text


def test_the_command_writes_and_prints(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "model.py").write_text(MODEL)
    monkeypatch.chdir(tmp_path)
    written = CliRunner().invoke(app, ["modelica", "model.py:build", "--out", "it.mo", "--stop", "3"])
    assert written.exit_code == 0
    assert "wrote it.mo" in written.output
    text = Path("it.mo").read_text()
    assert "annotation(experiment(StopTime=3, Tolerance=1e-06));" in text
    printed = CliRunner().invoke(app, ["modelica", "model.py:build", "--stop", "3"])
    assert printed.output == text
    plain = CliRunner().invoke(app, ["modelica", "model.py:build", "--no-msl", "--start", "mass.v=2"])
    assert "v(start=2, fixed=true)" in plain.output
    assert "Modelica." not in plain.output
    for words in (["--out", "it.txt"], ["--start", "mass.q=2"]):
        assert CliRunner().invoke(app, ["modelica", "model.py:build", *words]).exit_code in (1, 2)


def test_signals_stay_signals() -> None:
    net = ia.Network("n", sine=signals.Sine(f=2.0), push=ia.Force(), mass=ia.Mass(m=1.0))
    net.connect(net.sine.y, net.push.f)
    net.connect(net.push.flange, net.mass.flange)
    text = ia.to_modelica(net)
    assert "connector RealOutput = Modelica.Blocks.Interfaces.RealOutput;" in text
    assert "connect(sine.y, push.f);" in text
    assert "sin(" in text
    assert "time" in text
