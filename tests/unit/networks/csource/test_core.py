"""The core itself, through its C interface: copies, products, refusals, clean compilation."""

import ctypes
import subprocess
from collections.abc import Callable
from ctypes import POINTER, byref, c_char_p, c_double, c_int, c_void_p
from pathlib import Path
from typing import Any

import casadi as ca
import inertance as ia
import numpy as np
import pytest
from inertance.networks import CProgram, c_program, compile_shared
from inertance.networks.csource.toolchain import ToolchainError, compiler
from inertance.networks.simulation.events import constants

try:
    compiler()
except ToolchainError as missing:
    pytest.skip(str(missing), allow_module_level=True)

Built = Callable[[CProgram], Any]
SIZE = '#include "core_state.h"\nunsigned long core_size(void) { return sizeof(Core); }\n'
STRICT = ("-Wall", "-Wextra", "-Werror", "-pedantic", "-fvisibility=default")


def machine() -> ia.Network:
    """Free force on a mass that sticks and slips, behind two springs with nothing between them."""
    chain = ia.series(soft=ia.Spring(k=100.0), hard=ia.CubicSpring(k=50.0, k3=4e4))
    net = ia.Network(
        "machine",
        wall=ia.Fixed(),
        chain=chain,
        mass=ia.Mass(m=1.0),
        rub=ia.CoulombFriction(f_c=1.0),
        push=ia.Force(),
    )
    net.connect(net.wall.flange, net.chain.flange_a, net.rub.flange_a)
    return net.connect(net.chain.flange_b, net.mass.flange, net.push.flange, net.rub.flange_b)


@pytest.fixture(scope="module")
def program() -> CProgram:
    return c_program(machine().dae(), variables=["chain.hard.f", "mass.a"])


@pytest.fixture(scope="module")
def library(program: CProgram, tmp_path_factory: pytest.TempPathFactory) -> Any:
    folder = tmp_path_factory.mktemp("core")
    files = program.files | {"size.c": SIZE}
    for name, text in files.items():
        (folder / name).write_text(text)
    sources = [folder / name for name in files if name.endswith(".c")]
    library = ctypes.CDLL(str(compile_shared(sources, folder / "core.so", flags=STRICT)))
    library.core_message.restype = c_char_p
    library.core_state.restype = library.core_time.restype = library.core_input.restype = c_double
    return library


@pytest.fixture
def core(library: Any) -> Any:
    core = ctypes.create_string_buffer(library.core_size())
    library.core_reset(core)
    return core


def advance(library: Any, core: Any, stop: float, early: int = 0, fixed: float = 0.0) -> int:
    reached = c_int()
    tolerance = c_double(1e-9), c_double(1e-11)
    status = library.core_advance(core, c_double(stop), *tolerance, c_double(fixed), early, byref(reached))
    assert status == 0, library.core_message(core)
    return reached.value


def values(library: Any, core: Any, function: str, count: int) -> Any:
    found = POINTER(c_double)()
    assert getattr(library, function)(core, byref(found)) == 0, library.core_message(core)
    return np.array(found[:count])


def test_it_runs_like_the_network(program: CProgram, library: Any, core: Any) -> None:
    library.core_set_input(core, 0, c_double(5.0))
    assert library.core_start(core) == 0
    advance(library, core, 1.0)
    run = machine().simulate(1.0, inputs={"push.f": 5.0}, rtol=1e-10, atol=1e-12)
    states = [library.core_state(core, i) for i in range(len(program.states))]
    assert states == pytest.approx([run[name][-1] for name in program.states], abs=1e-7)
    assert values(library, core, "core_variables", 2) == pytest.approx(
        [run[n][-1] for n in program.variables], abs=1e-5
    )


def test_both_loops_have_the_same_constants(program: CProgram) -> None:
    told = dict(line.split()[1:] for line in program.files["constants.h"].splitlines() if " " in line[8:])
    names = {name: value for name, value in vars(constants).items() if name.isupper()}
    assert {name: float(value) for name, value in told.items()} == names
    text = "".join(text for name, text in program.files.items() if name != "constants.h")
    assert [name for name in names if f"#define {name} " in text] == []


def test_a_copy_goes_on_bit_by_bit(library: Any, core: Any) -> None:
    library.core_set_input(core, 0, c_double(5.0))
    library.core_start(core)
    advance(library, core, 0.3)
    kept = ctypes.create_string_buffer(core.raw, len(core))
    for stop in (0.5, 0.9):
        advance(library, core, stop)
    once = [library.core_state(core, i) for i in range(2)]
    for stop in (0.5, 0.9):
        advance(library, kept, stop)
    assert once == [library.core_state(kept, i) for i in range(2)]


def test_stops_early_on_an_event_and_fires_it_when_asked(library: Any, core: Any) -> None:
    library.core_set_input(core, 0, c_double(5.0))
    library.core_start(core)
    assert advance(library, core, 3.0, early=1) == 1
    run = machine().simulate(3.0, inputs={"push.f": 5.0}, rtol=1e-10, atol=1e-12)
    stops = next(event.time for event in run.events if event.target == "stuck")
    assert library.core_time(core) == pytest.approx(stops, abs=1e-7)
    before, changed = library.core_mode(core, 0), c_int()
    assert library.core_settle(core, byref(changed)) == 0
    assert library.core_mode(core, 0) != before


def test_equal_steps_converge(library: Any, core: Any) -> None:
    ends = []
    for h in (0.02, 0.01, 1e-4):
        library.core_reset(core)
        library.core_set_input(core, 0, c_double(5.0))
        library.core_start(core)
        advance(library, core, 0.2, fixed=h)
        ends.append(library.core_state(core, 0))
    assert abs(ends[1] - ends[2]) < abs(ends[0] - ends[2]) / 8


def test_products_are_derivatives(program: CProgram, library: Any, core: Any) -> None:
    rng = np.random.default_rng(1)
    nx = len(program.states)
    counts = nx, len(program.inputs), len(program.parameters)
    at = [np.array([0.02, 0.5]), np.array([3.0]), np.array(list(program.parameters.values()))]
    directions = [rng.normal(size=n) * 10.0**-2 for n in counts]
    directions[2][list(program.parameters).index("rub.peak")] = 0.0  # it stands at its limit

    def outputs(shift: float) -> Any:
        library.core_reset(core)
        x, u, p = (a + shift * d for a, d in zip(at, directions, strict=True))
        for i, name in enumerate(("state", "input", "parameter")):
            for k, value in enumerate((x, u, p)[i]):
                assert getattr(library, f"core_set_{name}")(core, k, c_double(value)) == 0, (
                    library.core_message(core)
                )
        assert library.core_start(core) == 0, library.core_message(core)
        return np.concatenate(
            [values(library, core, "core_rates", nx), values(library, core, "core_variables", 2)]
        )

    step = 1e-5
    differences = (outputs(step) - outputs(-step)) / (2 * step)
    outputs(0.0)
    rates, w = np.zeros(nx), np.zeros(2)
    pointers = [d.ctypes.data_as(c_void_p) for d in (*directions, rates, w)]
    assert library.core_forward(core, *pointers) == 0
    assert np.concatenate([rates, w]) == pytest.approx(differences, rel=1e-6, abs=1e-8)

    seeds = [rng.normal(size=nx), rng.normal(size=2)]
    adjoint = [np.zeros(n) for n in counts]
    assert library.core_adjoint(core, *[a.ctypes.data_as(c_void_p) for a in (*seeds, *adjoint)]) == 0
    back = sum(a @ d for a, d in zip(adjoint, directions, strict=True))
    assert back == pytest.approx(seeds[0] @ rates + seeds[1] @ w, rel=1e-9)


def test_what_makes_no_sense_is_refused_in_words(program: CProgram, library: Any, core: Any) -> None:
    mass = list(program.parameters).index("mass.m")
    assert library.core_set_parameter(core, mass, c_double(-1.0)) == 2
    assert library.core_message(core) == b"mass.m is too small, got -1; it must be above 0 kg"
    assert library.core_set_input(core, 0, c_double(np.nan)) == 2
    assert library.core_message(core) == b"push.f must be a finite number, got nan"
    assert library.core_set_state(core, 0, c_double(np.inf)) == 2


def test_dependencies_pass_through_algebraic_unknowns(program: CProgram) -> None:
    rates, variables = program.dependencies
    dae = program.dae
    named = [*program.states, *(i.path for i in program.inputs)]
    position, speed = program.states.index("rub.s_rel"), program.states.index("rub.v_rel")
    assert dae.z.numel() == 1
    assert {named[k] for k in rates[position]} == {"rub.v_rel"}
    assert {"rub.s_rel", "push.f"} <= {named[k] for k in rates[speed]}
    assert {named[k] for k in variables[0]} == {"rub.s_rel"}


def test_sanitizers_find_nothing(program: CProgram, tmp_path: Path) -> None:
    main = """
        #include <stdio.h>
        #include "core_state.h"
        int main(void) {
            static Core c;
            CoreStop reached;
            core_reset(&c);
            core_set_input(&c, 0, 5);
            if (!core_start(&c) && !core_advance(&c, 2, 1e-6, 1e-8, 0, 0, &reached)) return 0;
            return puts(core_message(&c)), 1;
        }
    """
    for name, text in (program.files | {"main.c": main}).items():
        (tmp_path / name).write_text(text)
    listed = [str(tmp_path / name) for name in (*program.sources, "main.c")]
    flags = ["-std=c99", "-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
    built = subprocess.run(
        [*compiler(), *flags, *listed, "-o", str(tmp_path / "main"), "-lm"], capture_output=True, text=True
    )
    if built.returncode and "asan" in built.stderr:
        pytest.skip("this compiler has no sanitizers")
    assert not built.returncode, built.stderr
    done = subprocess.run([str(tmp_path / "main")], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_free_inputs_go_on_by_their_derivatives(tmp_path: Path) -> None:
    net = ia.Network("shaker", table=ia.Position(), mount=ia.SpringDamper(k=1e3, d=10.0), box=ia.Mass(m=2.0))
    dae = net.connect(net.table.flange, net.mount.flange_a).connect(net.mount.flange_b, net.box.flange).dae()
    program = c_program(dae)
    assert {i.order for i in program.inputs} >= {0, 1}
    assert c_program(dae, inputs={"table.s_ref": lambda t: 0.01 * ca.sin(t)}).inputs == []
    with pytest.raises(ia.ModelError, match=r"did you mean 'table\.s_ref'"):
        c_program(dae, inputs={"table.s_rf": 0.0})


def test_dependencies_pass_from_block_to_block() -> None:
    class Chain(ia.Component):
        u = ia.RealInput("1")
        w = ia.RealInput("1")
        first = ia.variable("1", "what u determines")
        then = ia.variable("1", "what w and the first determine")

        def equations(self) -> Any:
            yield ca.sin(self.first) + 2 * self.first == self.u
            yield ca.sin(self.then) + 2 * self.then == self.first + self.w

    program = c_program(ia.Network("chain", chain=Chain()).dae(), variables=["chain.then"])
    assert program.dae.z.numel() == 2
    assert program.dependencies == ([], [[0, 1]])
