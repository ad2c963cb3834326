"""Random networks against nodal analysis, and random rows of masses that rub and strike."""

from dataclasses import dataclass
from typing import Any

import casadi as ca
import inertance as ia
import numpy as np
import pytest
from hypothesis import HealthCheck, assume, example, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

FREQUENCY = 0.3 + 1.1j
SOME = settings(
    max_examples=20, deadline=None, suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much]
)
FEW = settings(derandomize=True, max_examples=12, deadline=None, suppress_health_check=[HealthCheck.too_slow])
value = st.sampled_from([0.5, 1.0, 2.0, 3.0])

ELEMENTS: dict[str, tuple[Any, Any]] = {
    "spring": (lambda v: ia.Spring(k=v), lambda v, s: v),
    "damper": (lambda v: ia.Damper(d=v), lambda v, s: v * s),
    "inerter": (lambda v: ia.Inerter(b=v), lambda v, s: v * s**2),
    "strut": (lambda v: ia.SpringDamper(k=v, d=v / 2), lambda v, s: v + v / 2 * s),
    "parallel": (lambda v: ia.parallel(ia.Inerter(b=v), ia.Damper(d=v)), lambda v, s: v * s**2 + v * s),
    "series": (
        lambda v: ia.series(ia.Inerter(b=v), ia.SpringDamper(k=v, d=1.0)),
        lambda v, s: 1 / (1 / (v * s**2) + 1 / (v + s)),
    ),
}  # fmt: skip


@dataclass(frozen=True)
class Graph:
    """Nodes 1 to `nodes` and the ground 0; elements and rods (kind, from, to, size); masses by node."""

    nodes: int
    edges: tuple[tuple[str, int, int, float], ...]
    masses: tuple[tuple[int, float], ...]
    prescribed: bool


@st.composite
def graphs(draw: st.DrawFn) -> Graph:
    nodes = draw(st.integers(2, 5))
    pairs = [(draw(st.integers(0, i - 1)), i) for i in range(1, nodes + 1)]
    more = draw(st.lists(st.tuples(st.integers(0, nodes), st.integers(0, nodes)), max_size=4))
    pairs += [(a, b) for a, b in more if a != b]
    kinds = st.sampled_from([*ELEMENTS, *ELEMENTS, "rod"])
    edges = tuple((draw(kinds), a, b, draw(value)) for a, b in pairs)
    masses = tuple((i, draw(value)) for i in range(1, nodes + 1) if draw(st.booleans()))
    return Graph(nodes, edges, masses, draw(st.booleans()))


def network(graph: Graph, order: list[int] | None = None) -> ia.Network:
    """Build a graph, its components added and its nodes joined in the order given."""
    at: dict[int, list[ia.components.language.PortRef]] = {i: [] for i in range(graph.nodes + 1)}
    parts: dict[str, ia.Component] = {"ground": ia.Fixed()}
    at[0].append(parts["ground"].flange)
    for number, (kind, a, b, size) in enumerate(graph.edges):
        part = ia.Rod() if kind == "rod" else ELEMENTS[kind][0](size)
        parts[f"e{number}"] = part
        at[a].append(part.flange_a)
        at[b].append(part.flange_b)
    for node, mass in graph.masses:
        parts[f"m{node}"] = ia.Mass(m=mass)
        at[node].append(parts[f"m{node}"].flange)
    parts["drive"] = ia.Position() if graph.prescribed else ia.Force()
    at[graph.nodes].append(parts["drive"].flange)
    names = list(parts)
    places = order or list(range(len(names)))
    net = ia.Network("random", **{names[k % len(names)]: parts[names[k % len(names)]] for k in places})
    for node in sorted(at, key=lambda n: (places[n % len(places)], n)):
        ports = at[node] if order is None else at[node][::-1]
        net.connect(*ports)
    return net


def nodal(graph: Graph) -> complex | None:
    """Position per force, or force per position, at the last node; None if it is not determined."""
    s, n = FREQUENCY, graph.nodes
    matrix = np.zeros((n + 1, n + 1), complex)
    held = []
    for kind, a, b, size in graph.edges:
        ends = np.zeros(n + 1)
        ends[a], ends[b] = -1.0, 1.0
        if kind == "rod":
            held.append(ends)
        else:
            matrix += ELEMENTS[kind][1](size, s) * np.outer(ends, ends)
    for node, mass in graph.masses:
        matrix[node, node] += mass * s**2
    if graph.prescribed:
        held.append(np.eye(n + 1)[n])
    rods = np.array(held).reshape(-1, n + 1)[:, 1:]
    full = np.block([[matrix[1:, 1:], rods.T], [rods, np.zeros((len(rods), len(rods)))]])
    if np.linalg.matrix_rank(full, tol=1e-9) < len(full):
        return None
    load = np.eye(len(full))[-1 if graph.prescribed else n - 1]
    answer = np.linalg.solve(full, load)
    return complex(-answer[-1] if graph.prescribed else answer[n - 1])


def response(dae: ia.DAE, output: str) -> complex:
    """The same of the reduced equations, linear as they are."""
    s = FREQUENCY
    wanted = (dae.ode, dae.alg, dae.expression(output))
    slopes = [ca.jacobian(e, v) for e in wanted for v in (dae.x, dae.z, dae.u)]
    numbers = list(dae.parameter_values.values())
    q = [*numbers, *[0.0] * (dae.constants.numel() - len(numbers))]
    found = ca.Function("slopes", dae.arguments(), slopes)(0, 0, 0, q, 0)
    a, a_z, b, c, c_z, d, e, e_z, f = (np.array(m.full()) for m in found)
    of_x, of_u = np.linalg.solve(c_z, -c), np.linalg.solve(c_z, -d)
    u = np.array([i.sign * s**i.order for i in dae.inputs])
    x = np.linalg.solve(s * np.eye(len(a)) - a - a_z @ of_x, (b + a_z @ of_u) @ u)
    z = of_x @ x + of_u @ u
    return complex((e @ x + e_z @ z + f @ u)[0])


@SOME
@given(graphs())
def test_random_networks_answer_as_nodal_analysis_says(graph: Graph) -> None:
    expected = nodal(graph)
    net = network(graph)
    if expected is None:
        with pytest.raises(ia.ModelError):
            net.dae()
        return
    output = "drive.flange.f" if graph.prescribed else "drive.flange.s"
    found = response(net.dae(), output) * (-1 if graph.prescribed else 1)
    assert found == pytest.approx(expected, rel=1e-7, abs=1e-9)


@SOME
@given(graphs(), st.randoms(use_true_random=False))
def test_order_of_components_and_ports_changes_nothing(graph: Graph, random: object) -> None:
    assume(nodal(graph) is not None)
    order = list(range(2 + len(graph.edges) + len(graph.masses)))
    random.shuffle(order)  # type: ignore[attr-defined]
    output = "drive.flange.f" if graph.prescribed else "drive.flange.s"
    first, second = network(graph).dae(), network(graph, order).dae()
    assert len(first.states) == len(second.states)
    assert response(first, output) == pytest.approx(response(second, output), rel=1e-7, abs=1e-9)


@st.composite
def rows(draw: st.DrawFn) -> tuple[list[float], list[float], list[float], float, list[float]]:
    count = draw(st.integers(2, 5))
    masses = [draw(st.floats(0.1, 10.0)) for _ in range(count)]
    gaps = [draw(st.sampled_from([0.0, 0.05, 0.2])) for _ in range(count - 1)]
    speeds = [draw(st.sampled_from([-2.0, -1.0, 0.0, 1.0, 3.0])) for _ in range(count)]
    rubbing = [draw(st.sampled_from([0.0, 0.3, 2.0])) for _ in range(count - 1)]
    return masses, gaps, speeds, draw(st.sampled_from([0.0, 0.5, 1.0])), rubbing


def in_a_row(row: tuple[list[float], list[float], list[float], float, list[float]]) -> ia.Network:
    """Build masses that rub on their neighbours and strike them."""
    masses, gaps, speeds, e, rubbing = row
    places = np.cumsum([0.0, *(1 + gap for gap in gaps)])
    net = ia.Network("row")
    for i, (m, s, v) in enumerate(zip(masses, places, speeds, strict=True)):
        net.add(**{f"m{i}": ia.Mass(m=m, s=s, v=v)})
    for i, f_c in enumerate(rubbing):
        net.add(**{f"c{i}": ia.HardStop(e=e, s_min=1.0), f"r{i}": ia.CoulombFriction(f_c=f_c)})
        left, right, stop, rub = (getattr(net, name) for name in (f"m{i}", f"m{i + 1}", f"c{i}", f"r{i}"))
        net.connect(left.flange, stop.flange_a, rub.flange_a).connect(
            right.flange, stop.flange_b, rub.flange_b
        )
    return net


def kinetic(run: ia.Result, masses: list[float]) -> NDArray[np.float64]:
    energy: NDArray[np.float64] = np.sum([m * run[f"m{i}.v"] ** 2 / 2 for i, m in enumerate(masses)], axis=0)
    return energy


@FEW
@given(rows())
@example(row=([1.0, 1.0, 1.375, 1.125], [0.05, 0.0, 0.05], [0.0, 0.0, -1.0, -1.0], 0.5, [2.0, 0.0, 2.0]))
def test_rows_that_rub_and_strike_keep_momentum_and_gain_no_energy(
    row: tuple[list[float], list[float], list[float], float, list[float]],
) -> None:
    masses, gaps, speeds, e, rubbing = row
    run = in_a_row(row).simulate(1.0, rtol=1e-8, atol=1e-10)
    momentum = np.sum([m * run[f"m{i}.v"] for i, m in enumerate(masses)], axis=0)
    scale = sum(m * abs(v) for m, v in zip(masses, speeds, strict=True)) + 1.0
    assert momentum == pytest.approx(momentum[0], abs=1e-8 * scale)
    energy = kinetic(run, masses)
    assert np.diff(energy).max() <= 1e-7 * (energy[0] + 1.0)
    for i in range(len(gaps)):
        assert run[f"c{i}.s_rel"].min() >= 1.0 - 1e-8
        assert run[f"c{i}.f"].max() <= 1e-9
        assert abs(run[f"r{i}.f"]).max() <= rubbing[i] + 1e-9
    assert all(event.impulse >= -1e-9 for event in run.events if event.impulse is not None)
    first = [event for event in run.events if event.impulse is not None and event.time == 0.0]
    if e == 1.0 and not any(rubbing) and not first:
        assert energy[-1] == pytest.approx(energy[0], rel=1e-7)


@FEW
@given(rows(), st.floats(0.0, 0.8), st.sampled_from([1.0, 0.3, 0.01]))
def test_what_comes_in_jumps_is_averaged_over_time(
    row: tuple[list[float], list[float], list[float], float, list[float]], begin: float, step: float
) -> None:
    """The mean speed is the way over the time, and shares of modes add up, wherever points are."""
    run = in_a_row(row).simulate(3.0, begin=2.0, step=step, rtol=1e-8, atol=1e-10)
    begin += 2.0
    for i in range(len(row[0])):
        way = run.at(f"m{i}.s", 3.0) - run.at(f"m{i}.s", begin)
        assert run.mean(f"m{i}.v", begin=begin) * (3.0 - begin) == pytest.approx(way, abs=1e-6)
        assert run.rms(f"m{i}.v", begin=begin) ** 2 == pytest.approx(
            run.std(f"m{i}.v", begin=begin) ** 2 + run.mean(f"m{i}.v", begin=begin) ** 2
        )
        assert run.peak(f"m{i}.v") >= abs(run[f"m{i}.v"][-1])
    for i in range(len(row[4])):
        shares = [run.share(f"r{i}.mode", value, begin=begin) for value in run.values_of(f"r{i}.mode")]
        assert sum(shares) == pytest.approx(1.0)
