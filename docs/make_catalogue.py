"""Draw the pictures of catalogue.md, what its elements do: `python docs/make_catalogue.py [NAME ...]`.

A panel is a function that draws what the elements named in its title do; panels of one name make a picture.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable
from pathlib import Path
from textwrap import fill
from typing import Any

import inertance as ia
import numpy as np
from inertance import machines, rotational, signals, thermal
from matplotlib import pyplot

IMAGES = Path(__file__).parent / "images"
WIDTH, HEIGHT = 3.5, 2.7  # of a panel [in]
STYLE: dict[str, Any] = {
    "axes.grid": True,
    "axes.titlesize": "small",
    "font.size": 8.5,
    "grid.alpha": 0.3,
    "legend.frameon": False,
    "lines.linewidth": 1.2,
    "font.sans-serif": ["DejaVu Sans"],
    "path.simplify_threshold": 0.25,
    "svg.fonttype": "none",
    "svg.hashsalt": "catalogue",
    "xtick.minor.size": 0,
    "ytick.minor.size": 0,
}
Axes = Any
Drawn = Callable[[Axes], None]
PICTURES: dict[str, list[tuple[str, Drawn]]] = {}
SLOW = 2 * np.pi  # rad/s
FINER = re.compile(r"(\d\.\d)\d{4,}|\.0{6}| transform=\"rotate\(-0 [^\"]*\"")  # than a tenth of a point


def panel(picture: str, *names: str) -> Callable[[Drawn], Drawn]:
    """Register a function that draws what some elements do."""

    def register(draw: Drawn) -> Drawn:
        PICTURES.setdefault(picture, []).append((", ".join(names), draw))
        return draw

    return register


def draw_picture(name: str) -> None:
    """Draw all panels of a picture into one file."""
    panels = PICTURES[name]
    columns = 2 if len(panels) in (2, 4) else 3
    rows = -(-len(panels) // columns)
    size = (WIDTH * columns, HEIGHT * rows)
    figure, axes = pyplot.subplots(rows, columns, figsize=size, layout="constrained", squeeze=False)
    for ax, (title, draw) in zip(axes.flat, panels, strict=False):
        ax.set_title(fill(title, 46))
        draw(ax)
        if ax.get_legend_handles_labels()[0]:
            ax.legend(fontsize="small")
    for ax in axes.flat[len(panels) :]:
        ax.set_axis_off()
    path = IMAGES / f"catalogue_{name}.svg"
    figure.savefig(path, metadata={"Date": None})
    pyplot.close(figure)
    path.write_text(FINER.sub(r"\1", path.read_text(encoding="utf-8")), encoding="utf-8")


def told(ax: Axes, x: str, y: str) -> None:
    """Label the axes."""
    ax.set_xlabel(x)
    ax.set_ylabel(y)


def joined(name: str, *chains: str, **parts: ia.Component) -> ia.Network:
    """Return a network of parts whose ports, told as "a.flange b.flange_a", are joined."""
    net = ia.Network(name, **parts)
    for chain in chains:
        ends = []
        for path in chain.split():
            port: Any = net
            for step in path.split("."):
                port = getattr(port, step)
            ends.append(port)
        net.connect(*ends)
    return net


def moved(
    element: ia.Component, motion: Any, stop: float = 2.0, step: float = 5e-3, **inputs: Any
) -> ia.Result:
    """Return the run of an element between a wall and a flange that is moved."""
    turning = isinstance(element, rotational.TwoFlanges)
    kind: Any = rotational if turning else ia
    drive = kind.Position(**{"phi_ref" if turning else "s_ref": motion})
    net = joined(
        "moved", "wall.flange element.flange_a", "element.flange_b drive.flange",
        wall=kind.Fixed(), element=element, drive=drive,
    )  # fmt: skip
    given = {f"element.{name}": value for name, value in inputs.items()}
    return net.simulate(stop, step=step, inputs=given)


def swing(size: float, frequency: float = 1.0) -> Any:
    """Return a sine."""
    return lambda t: size * np.sin(SLOW * frequency * t)


def loop(
    ax: Axes,
    element: ia.Component,
    size: float = 0.01,
    frequency: float = 1.0,
    label: str = "",
    over: str = "",
    **inputs: Any,
) -> None:
    """Draw force over stretch, or over speed, of an element that is swung."""
    run = moved(element, swing(size, frequency), 2 / frequency, 5e-3 / frequency, **inputs)
    turning = isinstance(element, rotational.TwoFlanges)
    across = over or ("phi_rel" if turning else "s_rel")
    late = run.time >= 1 / frequency
    scale = 1.0 if over else 1e3
    ax.plot(
        scale * run[f"element.{across}"][late],
        run["element.tau" if turning else "element.f"][late],
        label=label,
    )
    unit = {"s_rel": "mm", "phi_rel": "mrad", "v_rel": "m/s", "w_rel": "rad/s"}[across]
    told(ax, f"{across} [{unit}]", "tau [N.m]" if turning else "f [N]")


CURVE = ((-0.01, -2000.0), (-0.005, -200.0), (0.0, 0.0), (0.01, 300.0))
VALVE = ((-0.1, -300.0), (0.0, 0.0), (0.05, 400.0), (0.1, 500.0))


@panel("points", "TabulatedSpring", "rotational.TabulatedSpring")
def _(ax: Axes) -> None:
    for how in ("linear", "smooth"):
        loop(ax, ia.TabulatedSpring(table=CURVE, interpolation=how), 0.012, label=how)
    ax.plot(*(np.array(CURVE) * (1e3, 1)).T, "k.")
    ax.text(0.03, 0.05, "turning alike, tau over phi_rel", transform=ax.transAxes, fontsize="small")


@panel("points", "TabulatedDamper", "rotational.TabulatedDamper")
def _(ax: Axes) -> None:
    for how in ("linear", "smooth"):
        loop(ax, ia.TabulatedDamper(table=VALVE, interpolation=how), 0.02, label=how, over="v_rel")
    ax.plot(*np.array(VALVE).T, "k.")
    ax.text(0.4, 0.05, "turning alike, tau over w_rel", transform=ax.transAxes, fontsize="small")


@panel("points", "MapSpringDamper")
def _(ax: Axes) -> None:
    table = tuple((s, v, 2e4 * s + f) for s in (-0.02, 0.02) for v, f in ((-0.1, -50), (0, 0), (0.1, 150)))
    for frequency in (0.1, 0.5, 1.0):
        loop(ax, ia.MapSpringDamper(table=table), 0.015, frequency, f"{frequency:g} Hz")


@panel("bristles", "LuGreFriction")
def _(ax: Axes) -> None:
    guide = ia.LuGreFriction(f_c=20.0, f_s=30.0, v_s=0.01, sigma_0=2e5, sigma_1=300.0, sigma_2=5.0)
    for frequency in (0.1, 1.0):
        loop(ax, guide, 0.002, frequency, f"{frequency:g} Hz")


@panel("bristles", "rotational.LuGreFriction")
def _(ax: Axes) -> None:
    shaft = rotational.LuGreFriction(tau_c=1.0, tau_s=1.5, w_s=0.05, sigma_0=1e3, sigma_1=3.0, sigma_2=0.2)
    for size in (2e-4, 1e-3, 4e-3):
        loop(ax, shaft, size, 0.5, f"{1e3 * size:g} mrad")


@panel("bristles", "TemperatureDependentFriction", "rotational.TemperatureDependentFriction")
def _(ax: Axes) -> None:
    for alpha in (-0.02, 0.0, 0.02):
        pad = ia.TemperatureDependentFriction(f_c=50.0, alpha=alpha, useHeatPort=True)
        net = joined(
            "pad", "wall.flange pad.flange_a", "pad.flange_b drive.flange", "pad.heatPort body.port",
            wall=ia.Fixed(), pad=pad, drive=ia.ConstantSpeed(v_fixed=0.5), body=thermal.HeatCapacitor(C=5.0),
        )  # fmt: skip
        run = net.simulate(5.0, step=0.05)
        ax.plot(run["body.T"] - 273.15, run["pad.f"], label=f"alpha = {alpha:g}/K")
    told(ax, "temperature [°C]", "f [N], or tau")


@panel("rubber", "Maxwell, Zener and the like")
def _(ax: Axes) -> None:
    held = {
        "Maxwell": ia.Maxwell(k=5e4, d=500.0),
        "RelaxingSpring, T = 30 ms": ia.RelaxingSpring(k=5e4, T=0.03),
        "rotational.RelaxingSpring, 90 ms": rotational.RelaxingSpring(c=5e4, T=0.09),
        "Zener": ia.Zener(k_0=5e4, k=5e4, d=500.0),
    }
    for name, element in held.items():
        run = moved(element, lambda t: 0.001 * np.tanh(1e3 * t), 0.06, 2e-4)
        turns = name.startswith("rotational")
        ax.plot(1e3 * run.time, run["element.tau" if turns else "element.f"], label=name)
    told(ax, "time after a step of 1 mm, or mrad [ms]", "f [N], or tau [N.m]")


@panel("rubber", "Zener, shaken")
def _(ax: Axes) -> None:
    for frequency in (1.0, 10.0, 100.0):
        loop(ax, ia.Zener(k_0=5e4, k=5e4, d=500.0), 0.001, frequency, f"{frequency:g} Hz")


@panel("rubber", "FractionalDamper")
def _(ax: Axes) -> None:
    w = np.logspace(-2, 4, 121)
    for alpha in (0.2, 0.5, 0.8):
        rubber = ia.FractionalDamper(c=1e4, alpha=alpha, w_low=0.1, decades=4.0, n=8)
        net = joined(
            "rubber", "wall.flange rubber.flange_a", "rubber.flange_b drive.flange",
            wall=ia.Fixed(), rubber=rubber, drive=ia.Position(),
        )  # fmt: skip
        system = ia.analysis.linearise(net, ["drive.s_ref"], ["rubber.f"])
        (line,) = ax.loglog(w, abs(system.response(w / SLOW)).ravel(), label=f"alpha = {alpha:g}")
        ax.loglog(w, 1e4 * w**alpha, ":", color=line.get_color())
    told(ax, "angular frequency [rad/s]", "dynamic stiffness [N/m]")


@panel("isolators", "WireRope")
def _(ax: Axes) -> None:
    for size in (0.002, 0.005, 0.01):
        loop(ax, ia.WireRope(k_1=2e4, k_2=5e5, k_3=3e7, f_y=60.0, s_y=1e-3), size)


@panel("isolators", "ObliqueSprings")
def _(ax: Axes) -> None:
    across, upright = ia.ObliqueSprings(k=1e4, l_0=0.06, a=0.05), ia.Spring(k=4e3)
    loop(ax, across, 0.04, label="alone")
    loop(ax, upright, 0.04, label="a Spring")
    run = moved(ia.parallel(upright, across), swing(0.04))
    ax.plot(1e3 * run["drive.flange.s"], run["drive.flange.f"] * -1, label="both")


@panel("isolators", "Rope")
def _(ax: Axes) -> None:
    for d in (0.0, 1500.0):
        loop(ax, ia.Rope(k=1e5, d=d, s_rel0=0.002), label=f"d = {d:g} N.s/m")


@panel("isolators", "machines.NES")
def _(ax: Axes) -> None:
    for sink in (None, machines.NES(m=0.05, k3=2.0, d=0.015)):
        net = joined(
            "tower", "ground.flange column.flange_a", "column.flange_b mass.flange",
            ground=ia.Fixed(), column=ia.Spring(k=1.0), mass=ia.Mass(m=1.0, s=0.1, v=0.0),
        )  # fmt: skip
        if sink:
            net.add(sink=sink).connect(net.ground.flange, net.sink.flange_a)
            net.connect(net.mass.flange, net.sink.flange_b)
        run = net.simulate(80.0, step=0.2)
        ax.plot(run.time, 1e3 * run["mass.s"], label="with" if sink else "without", alpha=1 if sink else 0.4)
    told(ax, "time [s]", "s of the tower [mm]")


@panel("joints", "Iwan")
def _(ax: Axes) -> None:
    for size in (1e-3, 2e-3):
        loop(ax, ia.Iwan(k=1e6, s_y=2e-3, p=2.0, cells=20), size)


@panel("joints", "Iwan, BoucWen")
def _(ax: Axes) -> None:
    laps: dict[str, Any] = {f"Iwan, p = {p:g}": ia.Iwan(k=1e6, s_y=2e-3, p=p, cells=20) for p in (1.0, 2.0)}
    shape = 0.5 / 2e-3**2
    laps["BoucWen, n = 2"] = ia.BoucWen(k=1e6, alpha=0.0, beta=shape, gamma=shape, n=2.0)
    sizes = 1e-3 * np.geomspace(0.1, 1.0, 6)
    for name, lap in laps.items():
        runs = [moved(lap.clone(), swing(size)) for size in sizes]
        lost = [np.trapezoid(run["element.lossPower"][run.time > 1], run.time[run.time > 1]) for run in runs]
        ax.loglog(1e3 * sizes, lost, label=name)
    told(ax, "size of the loop [mm]", "lost in a loop [J]")


@panel("fluids", "AirSpring")
def _(ax: Axes) -> None:
    for n in (1.0, 1.4):
        loop(ax, ia.AirSpring(A=0.02, p_0=6e5, V_0=5e-3, n=n), 0.1, label=f"n = {n:g}")


@panel("fluids", "MonotubeDamper")
def _(ax: Axes) -> None:
    oil = ia.MonotubeDamper(A_p=1e-3, A_r=8e-4, A_e=1e-5, A_c=2e-5, V_r=1e-4, V_0=1e-4, p_0=2e6)
    for frequency in (0.5, 2.0, 8.0):
        loop(ax, oil, 0.01, frequency, f"{frequency:g} Hz", "v_rel")


@panel("fluids", "machines.OleoStrut")
def _(ax: Axes) -> None:
    strut = machines.OleoStrut(
        s_rel0=0.8, A_a=2e-3, A_h=1.6e-3, A_o=3e-5, p_0=1.5e6, V_0=8e-4, n=1.3, C_d=0.9, rho=870.0
    )
    for sink in (1.0, 2.0, 3.0):
        run = machines.landing_gear(strut, L=0.8, sink=sink).simulate(0.4, step=1e-3)
        ax.plot(800 - 1e3 * run["strut.s_rel"], run["strut.f"] / -1e3, label=f"sinks at {sink:g} m/s")
    told(ax, "stroke [mm]", "force [kN]")


MR: dict[str, Any] = {"alpha_a": 14e3, "alpha_b": 69.5e3, "c_0a": 2100.0, "c_0b": 350.0, "eta": 190.0}
SHAPE: dict[str, Any] = {"A": 301.0, "beta": 3.63e6, "gamma": 3.63e6}


@panel("coils", "SpencerDamper")
def _(ax: Axes) -> None:
    damper = ia.SpencerDamper(c_1a=28.3e3, c_1b=295.0, k_0=4690.0, k_1=500.0, **MR, **SHAPE)
    for u in (0.0, 0.75, 1.5, 2.25):
        loop(ax, damper, 0.015, 2.5, f"{u:g} V", "v_rel", u=lambda t, u=u: u + 0 * t)


@panel("coils", "BoucWenDamper")
def _(ax: Axes) -> None:
    for u in (0.0, 0.75, 1.5, 2.25):
        loop(ax, ia.BoucWenDamper(**MR, **SHAPE), 0.015, 2.5, f"{u:g} V", "v_rel", u=lambda t, u=u: u + 0 * t)


@panel("coils", "VoiceCoil")
def _(ax: Axes) -> None:
    for L in (1e-3, 3e-3):
        run = moved(ia.VoiceCoil(Bl=15.0, R=2.0, L=L), swing(0.0), 0.01, 1e-4, u=lambda t: 4.0 + 0 * t)
        ax.plot(1e3 * run.time, -run["element.f"], label=f"L = {1e3 * L:g} mH")
    told(ax, "time after 4 V, held [ms]", "force [N]")


@panel("coils", "machines.Shaker")
def _(ax: Axes) -> None:
    for load in (0.1, 1.2):
        net = joined(
            "table", "frame.flange shaker.flange_a", "shaker.flange_b load.flange", frame=ia.Fixed(),
            shaker=machines.Shaker(m=0.3, k=4e3, d=8.0, Bl=15.0, R=2.0, L=1e-3), load=ia.Mass(m=load),
        )  # fmt: skip
        f = np.logspace(0, 3, 151)
        system = ia.analysis.linearise(net, ["shaker.u"], ["load.a"])
        ax.loglog(f, abs(system.response(f)).ravel(), label=f"load of {load:g} kg")
    told(ax, "frequency [Hz]", "acceleration over voltage [m/s²/V]")


@panel("inerters", "FluidInerter")
def _(ax: Axes) -> None:
    fluid = ia.FluidInerter(A_p=1.2e-3, D=0.012, L=7.0, D_h=0.2, rho=800.0, mu=0.003)
    for frequency in (1.0, 2.0):
        loop(ax, fluid, 0.02, frequency, f"{frequency:g} Hz")


@panel("inerters", "VariableInerter")
def _(ax: Axes) -> None:
    net = joined(
        "coasting", "one.flange inerter.flange_a", "two.flange inerter.flange_b", one=ia.Mass(m=1.0),
        two=ia.Mass(m=1.0, v=1.0), inerter=ia.VariableInerter(b=4.0, b_u=-3.0, T=0.05),
    )  # fmt: skip
    run = net.simulate(1.0, step=5e-3, inputs={"inerter.u": lambda t: 0.5 + np.tanh(20 * (t - 0.5)) / 2})
    ax.plot(run.time, 4 - 3 * run["inerter.x"], label="inertance [kg]")
    ax.plot(run.time, run["inerter.v_rel"], label="v_rel [m/s]")
    told(ax, "time [s]", "")


@panel("inerters", "machines.CrankInerter")
def _(ax: Axes) -> None:
    crank = machines.CrankInerter(
        crank=ia.SliderCrank(r=0.05, l=0.2), flywheel=ia.DiskFlywheel(m=1.0, R=0.05)
    )
    net = joined(
        "crank", "frame.flange inerter.flange_b", "inerter.flange_a push.flange",
        frame=ia.Fixed(), inerter=crank, push=ia.Force(f=-0.2),
    )  # fmt: skip
    run = net.simulate(0.55, step=2e-3, start={"inerter.crank.phi": 0.5, "inerter.flywheel.w": 0.0})
    travel = run["inerter.crank.s"]
    slope = np.gradient(travel, run["inerter.crank.phi"])[5:-1]
    ax.plot(1e3 * (travel - 0.2)[5:-1], 0.5 * 0.05**2 / slope**2)
    told(ax, "stroke [mm]", "inertance [kg]")


@panel("inerters", "Gyroscope", "machines.GyroInerter")
def _(ax: Axes) -> None:
    for w_s in (0.0, 200.0, 400.0):
        gyro = ia.Gyroscope(J_s=2e-3, w_s=w_s, J_t=1.2e-3, c=8.0, d=0.02)
        net = joined(
            "held", "wall.flange inerter.flange_b", "inerter.flange_a push.flange", wall=ia.Fixed(),
            inerter=machines.GyroInerter(pinion=ia.RackPinion(R=0.03), flywheel=gyro), push=ia.Force(),
        )  # fmt: skip
        f = np.logspace(-1, 2, 301)
        system = ia.analysis.linearise(net, ["push.f"], ["inerter.flange_a.s"])
        ax.loglog(f, 1 / abs(system.response(f)).ravel() / (SLOW * f) ** 2, label=f"spin of {w_s:g} rad/s")
    told(ax, "frequency [Hz]", "force over acceleration [kg]")


@panel("inerters", "machines.MechatronicInerter")
def _(ax: Axes) -> None:
    for C in (0.01, 0.05):
        inerter = machines.MechatronicInerter(
            screw=ia.NutScrew(lead=0.01), flywheel=ia.DiskFlywheel(m=0.1, R=0.03),
            motor=rotational.ShuntedMotor(k=0.05, L=0.01, R=0.5, elastance=1 / C),
        )  # fmt: skip
        net = joined(
            "held", "wall.flange inerter.flange_a", "inerter.flange_b push.flange",
            wall=ia.Fixed(), inerter=inerter, push=ia.Force(),
        )  # fmt: skip
        f = np.logspace(-1, 2, 151)
        system = ia.analysis.linearise(net, ["push.f"], ["inerter.flange_b.s"])
        ax.loglog(f, 1 / abs(system.response(f)).ravel() / (SLOW * f) ** 2, label=f"C = {1e3 * C:g} mF")
    told(ax, "frequency [Hz]", "force over acceleration [kg]")


@panel("elastic", "ModalRod", "LumpedRod")
def _(ax: Axes) -> None:
    for count in (4, 8, 16):
        orders = np.arange(1, min(count, 6) + 1)
        modal = [ia.ModalRod(m=7.85, k=2.1e8, modes=count).frequency_error(int(k)) for k in orders[:count]]
        lumped = [
            -ia.LumpedRod(m=7.85, k=2.1e8, segments=count).frequency_error(int(k))
            for k in orders[: count - 1]
        ]
        ax.semilogy(
            orders[: len(modal)], modal, "o-", color=f"C{int(np.log2(count))}", ms=3, label=f"{count} modes"
        )
        ax.semilogy(
            orders[: len(lumped)],
            lumped,
            "s--",
            color=f"C{int(np.log2(count))}",
            ms=3,
            label=f"{count} lumps",
        )
    told(ax, "natural frequency", "how far off, clamped at one end")


@panel("elastic", "rotational.ModalShaft", "rotational.LumpedShaft")
def _(ax: Axes) -> None:
    shafts = {
        "6 modes": rotational.ModalShaft(J=0.02, c=1240.0, modes=6),
        "12 lumps": rotational.LumpedShaft(J=0.02, c=1240.0, segments=12),
    }
    for name, shaft in shafts.items():
        net = joined(
            "drive", "motor.flange shaft.flange_a", "shaft.flange_b load.flange",
            motor=rotational.Torque(), shaft=shaft, load=rotational.Inertia(J=0.02),
        )  # fmt: skip
        system = ia.analysis.linearise(net, ["motor.tau"], ["load.w"])
        f = np.linspace(10.0, 300.0, 291)
        ax.semilogy(f, abs(system.response(f)).ravel(), label=name)
    told(ax, "frequency [Hz]", "w of the load over tau [rad/s/N.m]")


def by_hand(lift: float, lower: float) -> Any:
    """Return an effort that lifts for half a second, rests, lowers as long, and rests."""
    return lambda t: sum(
        size * np.tanh(50 * (t - at)) / 2
        for size, at in ((lift, 0.5), (-lift, 1.0), (-lower, 2.0), (lower, 2.5))
    )


@panel("gears", "LeadScrew")
def _(ax: Axes) -> None:
    for mu in (0.03, 0.12):
        net = joined(
            "jack", "hand.flange rotor.flange screw.flange_r", "screw.flange_t load.flange weight.flange",
            hand=rotational.Torque(tau=by_hand(2.5, 1.0)), rotor=rotational.Inertia(J=0.02),
            screw=ia.LeadScrew(lead=0.004, d_m=0.018, mu=mu), load=ia.Mass(m=100.0),
            weight=ia.ConstantForce(f_constant=-981.0),
        )  # fmt: skip
        run = net.simulate(3.0, step=0.01)
        ax.plot(run.time, 1e3 * run["load.s"], label=f"mu = {mu:g}")
    ax.set_ylim(-10, 10)
    told(ax, "time [s]; lifted at 0.5 s, lowered at 2 s", "height [mm]")


@panel("gears", "rotational.WormGear")
def _(ax: Axes) -> None:
    for mu in (0.1, 0.2):
        net = joined(
            "hoist", "hand.flange rotor.flange worm.flange_a", "worm.flange_b drum.flange load.flange",
            hand=rotational.Torque(tau=by_hand(6.0, 1.5)), rotor=rotational.Inertia(J=0.02),
            worm=rotational.WormGear(ratio=20.0, lead_angle=0.15, mu=mu), drum=rotational.Inertia(J=0.5),
            load=rotational.ConstantTorque(tau_constant=-40.0),
        )  # fmt: skip
        run = net.simulate(3.0, step=0.01)
        ax.plot(run.time, run["drum.phi"], label=f"mu = {mu:g}")
    ax.set_ylim(-2, 2)
    told(ax, "time [s]; lifted at 0.5 s, lowered at 2 s", "angle of the drum [rad]")


@panel("gears", "rotational.HarmonicDrive")
def _(ax: Axes) -> None:
    net = joined(
        "arm",
        "motor.flange drive.flange_a",
        "drive.flange_b link.flange",
        motor=rotational.Speed(w_ref=50.0),
        drive=rotational.HarmonicDrive(ratio=100.0, c=1e4, d=20.0, e_1=2e-4),
        link=rotational.Inertia(J=1.0),
    )
    run = net.simulate(1.0, step=2e-3, start={"link.w": -0.5, "drive.x": 0.0})
    ax.plot(run.time, run["link.w"])
    told(ax, "time [s]", "w of the link, motor at 50 rad/s")


@panel("gears", "rotational.BeltDrive")
def _(ax: Axes) -> None:
    net = joined(
        "cycle",
        "pedal.flange front.flange chain.flange_a",
        "chain.flange_b rear.flange",
        pedal=rotational.Torque(tau=lambda t: 8 * np.sin(SLOW * t)),
        front=rotational.Inertia(J=0.01),
        chain=rotational.BeltDrive(r_a=0.05, r_b=0.1, k=2e4, d=100.0, e_0=-0.002),
        rear=rotational.Inertia(J=0.05),
    )
    run = net.simulate(1.5, step=4e-3)
    for name in ("f_1", "f_2"):
        ax.plot(run.time, run[f"chain.{name}"], label=f"strand {name}")
    told(ax, "time [s]", "tension [N], 2 mm of slack")


@panel("drivelines", "rotational.UniversalJoint")
def _(ax: Axes) -> None:
    for beta in (0.2, 0.4, 0.6):
        net = joined(
            "shafts",
            "drive.flange joint.flange_a",
            "joint.flange_b wheel.flange",
            wheel=rotational.Inertia(J=0.1),
            drive=rotational.Speed(w_ref=1.0),
            joint=rotational.UniversalJoint(beta=beta),
        )
        run = net.simulate(2 * np.pi, step=0.05)
        ax.plot(np.degrees(run["drive.flange.phi"]), run["wheel.w"], label=f"beta = {beta:g} rad")
    told(ax, "angle of flange_a [°]", "w_b over w_a")


@panel("drivelines", "rotational.Differential")
def _(ax: Axes) -> None:
    net = joined(
        "axle", "engine.flange axle.flange", "axle.left left.flange", "axle.right right.flange",
        engine=rotational.Torque(tau=8.0), axle=rotational.Differential(ratio=4.0),
        left=rotational.Inertia(J=1.0), right=rotational.Inertia(J=3.0),
    )  # fmt: skip
    run = net.simulate(1.0, step=0.05)
    ax.plot(run.time, run["axle.flange.phi"] / 4, "k:", label="phi/ratio")
    for side, mass in (("left", 1), ("right", 3)):
        ax.plot(run.time, run[f"{side}.phi"], label=f"{side}, {mass} kg.m²")
    told(ax, "time [s]", "angle [rad]")


@panel("gaps", "rotational.Gearbox", "rotational.ElastoBacklash2", "rotational.RelaxingBacklash")
def _(ax: Axes) -> None:
    gearbox = rotational.Gearbox(ratio=2.0, lossTable=((0.0, 0.9, 0.9, 0.0, 0.0),), c=500.0, d=2.0, b=0.02)
    net = joined(
        "gears",
        "drive.flange box.flange_a",
        "box.flange_b wheel.flange",
        drive=rotational.Torque(tau=lambda t: 2 * np.sin(SLOW * t)),
        box=gearbox,
        wheel=rotational.Inertia(J=0.02),
    )
    net.add(rotor=rotational.Inertia(J=0.01)).connect(net.rotor.flange, net.drive.flange)
    run = net.simulate(1.2, step=2e-3)
    ax.plot(1e3 * run["box.phi_rel"], run["box.elastoBacklash.tau"], label="Gearbox", lw=0.8)
    for kind in (rotational.ElastoBacklash2, rotational.ElastoBacklash, rotational.RelaxingBacklash):
        run = moved(kind(c=500.0, d=20.0, b=0.02), swing(0.02), 1.0, 2.5e-3)
        ax.plot(1e3 * run["element.phi_rel"], run["element.tau"], label=kind.__name__)
    told(ax, "phi_rel [mrad]", "tau [N.m]")


@panel("drivelines", "machines.DualMassFlywheel", "machines.TorsionalDamper")
def _(ax: Axes) -> None:
    f, engine = np.linspace(1.0, 40.0, 196), rotational.Torque()
    flywheel = machines.DualMassFlywheel(J_1=0.1, J_2=0.06, c=600.0, d=2.0)
    net = joined("line", "engine.flange flywheel.flange_a", engine=engine, flywheel=flywheel)
    system = ia.analysis.linearise(net, ["engine.tau"], ["flywheel.primary.a", "flywheel.secondary.a"])
    first, second = abs(system.response(f)).reshape(len(f), 2).T
    ax.semilogy(f, second / first, label="flywheel: a_2 over a_1")
    for d in (0.0, 5.0):
        net = joined(
            "shaft",
            "engine.flange crank.flange damper.flange shaft.flange_b",
            "wall.flange shaft.flange_a",
            engine=engine,
            crank=rotational.Inertia(J=0.2),
            shaft=rotational.Spring(c=2e3),
            wall=rotational.Fixed(),
            damper=machines.TorsionalDamper(J_h=0.01, J_r=0.05, d=d),
        )
        system = ia.analysis.linearise(net, ["engine.tau"], ["crank.phi"])
        ax.semilogy(f, 2e3 * abs(system.response(f)).ravel(), "--", label=f"crank, damper d = {d:g}")
    told(ax, "frequency [Hz]", "ratio of amplitudes")


@panel("cranks", "SliderCrank", "Cam")
def _(ax: Axes) -> None:
    net = joined(
        "engine",
        "turn.flange crank.flange_r cam.flange_r",
        "crank.flange_t piston.flange",
        "cam.flange_t valve.flange",
        turn=rotational.Speed(w_ref=1.0),
        crank=ia.SliderCrank(r=0.05, l=0.15),
        piston=ia.Mass(m=1.0),
        cam=ia.Cam(table=((0.0, 0.0), (1.5, 0.0), (3.0, 0.01), (4.5, 0.0))),
        valve=ia.Mass(m=0.2),
    )
    run = net.simulate(4 * np.pi, step=0.05)
    angle = np.degrees(run["crank.phi"])
    ax.plot(angle, 1e3 * run["piston.s"] - 100, label="piston, from 100 mm")
    ax.plot(angle, 10e3 * run["valve.s"], label="ten times the valve")
    told(ax, "angle [°]", "s [mm]")


ROAD: dict[str, Any] = {"R": 0.3, "F_z": 4000.0, "mu": 0.9, "B": 12.0, "C": 1.5}


@panel("cranks", "Tyre")
def _(ax: Axes) -> None:
    for sigma in (0.1, 0.4, 1.6):
        run = moved_tyre(ia.Tyre(sigma=sigma, **ROAD))
        ax.plot(run.time, run["tyre.f_x"] / 1e3, label=f"sigma = {sigma:g} m")
    told(ax, "time after 5 % of slip, at 10 m/s [s]", "f_x [kN]")


def moved_tyre(tyre: ia.Component) -> ia.Result:
    """Return the run of a tyre that begins to slip by 5 % at once."""
    net = joined(
        "rolling", "rim.flange tyre.flange_r", "tyre.flange_t hub.flange",
        rim=rotational.Speed(w_ref=1.05 * 10 / 0.3), hub=ia.Speed(v_ref=10.0), tyre=tyre,
    )  # fmt: skip
    return net.simulate(0.3, step=1e-3)


@panel("cranks", "machines.RigidRingTyre")
def _(ax: Axes) -> None:
    belt = machines.RigidRingTyre(
        J_b=0.6, m_b=7.0, c_phi=4e4, d_phi=20.0, k_x=1.4e6, d_x=200.0, sigma=0.1, **ROAD
    )
    for name, tyre in (("Tyre", ia.Tyre(sigma=0.1, **ROAD)), ("RigidRingTyre", belt)):
        net = joined(
            "brake",
            "brake.flange rim.flange tyre.flange_r",
            "tyre.flange_t hub.flange",
            rim=rotational.Inertia(J=0.5),
            brake=rotational.Torque(tau=0.0),
            hub=ia.Speed(v_ref=10.0),
            tyre=tyre,
        )
        rolling = {"rim.w": 10 / 0.3} | (
            {"tyre.ring.w": 10 / 0.3, "tyre.belt.v": 10.0} if tyre is belt else {}
        )
        found = ia.analysis.linearise(
            net, ["brake.tau"], ["rim.w"], at=net.simulate(0.5, start=rolling), time=0.5
        )
        f = np.linspace(1.0, 150.0, 299)
        ax.semilogy(f, abs(found.response(f)).ravel(), label=name)
    told(ax, "frequency [Hz]", "w of the rim over tau, at 10 m/s")


@panel("motors", "rotational.DCMotor")
def _(ax: Axes) -> None:
    motor = rotational.DCMotor(k=0.05, R=0.5, L=1e-3, u_max=24.0, i_max=10.0)
    net = joined("spindle", "motor.flange rotor.flange", motor=motor, rotor=rotational.Inertia(J=1e-3))
    run = net.simulate(3.0, step=0.01, inputs={"motor.u": lambda t: 100.0 + 0 * t})
    ax.plot(run.time, run["motor.i"], label="i [A], 10 A at most")
    ax.plot(run.time, run["rotor.w"] / 50, label="w/50 [rad/s], 24 V at most")
    told(ax, "time [s]", "")


@panel("motors", "rotational.ShuntedMotor")
def _(ax: Axes) -> None:
    for name, elastance in (("R", 0.0), ("R and C", 200.0)):
        motor = rotational.ShuntedMotor(k=0.5, L=0.01, R=0.5, elastance=elastance)
        net = joined(
            "swing",
            "wall.flange spring.flange_a motor.flange_a",
            "spring.flange_b motor.flange_b disc.flange",
            wall=rotational.Fixed(),
            spring=rotational.Spring(c=30.0),
            motor=motor,
            disc=rotational.Inertia(J=0.1, w=1.0),
        )
        run = net.simulate(3.0, step=0.01)
        ax.plot(run.time, 1e3 * run["disc.phi"], label=f"terminals on {name}")
    told(ax, "time [s]", "phi [mrad]")


@panel("motors", "machines.Servo")
def _(ax: Axes) -> None:
    for band in (0.01, 0.05):
        servo = machines.Servo(
            k_p=40.0, k_d=0.6, band=band, period=5e-3, delay=2e-3, ratio=200.0, J=1e-7, k=0.01, R=4.0, L=1e-3,
            u_max=12.0, i_max=1.5,
        )  # fmt: skip
        net = joined("arm", "servo.flange arm.flange", servo=servo, arm=rotational.Inertia(J=0.02))
        run = net.simulate(0.8, step=4e-3, inputs={"servo.reference": lambda t: 1.0 + 0 * t})
        ax.plot(run.time, run["arm.phi"], label=f"dead band ±{band:g} rad")
    told(ax, "time [s]", "phi [rad]")


@panel("gaps", "ElastoBacklash", "RelaxingBacklash", "rotational.Backlash")
def _(ax: Axes) -> None:
    for kind in (ia.ElastoBacklash, ia.RelaxingBacklash):
        loop(ax, kind(k=1e4, d=500.0, b=0.01), 0.01, label=f"{kind.__name__} [mm, N]")
    run = moved(rotational.Backlash(c=1e4, d=500.0, eps=0.005), swing(0.01), 1.0, 2.5e-3)
    ax.plot(1e3 * run["element.phi_rel"], run["element.tau"], "--", label="rotational.Backlash [mrad, N.m]")


@panel("gaps", "MassWithLength")
def _(ax: Axes) -> None:
    net = joined(
        "train",
        "wall.flange stop.flange_a",
        "stop.flange_b one.flange_a",
        "one.flange_b gap.flange_a",
        "gap.flange_b two.flange_a",
        wall=ia.Fixed(),
        stop=ia.HardStop(e=0.8),
        gap=ia.ElastoGap(k=1e6, d=1e3),
        one=ia.MassWithLength(m=2.0, L=0.5, s=0.6, v=-0.2),
        two=ia.MassWithLength(m=2.0, L=0.3, s=1.4, v=-1.0),
    )
    run = net.simulate(1.5, step=5e-3)
    for k, (name, half) in enumerate((("one", 0.25), ("two", 0.15))):
        ax.fill_between(run.time, run[f"{name}.s"] - half, run[f"{name}.s"] + half, alpha=0.4, color=f"C{k}")
    ax.axhline(0.0, color="k")
    told(ax, "time [s]", "from end to end [m]")


@panel("drives", "Move", "ConstantSpeed", "rotational.Move", "rotational.ConstantSpeed")
def _(ax: Axes) -> None:
    given = {"move.s_ref": swing(1.0), "move.v_ref": lambda t: SLOW * np.cos(SLOW * t)}
    given["move.a_ref"] = lambda t: -(SLOW**2) * np.sin(SLOW * t)
    parts: dict[str, ia.Component] = {"one": ia.Mass(m=1.0), "two": ia.Mass(m=1.0)}
    net = joined(
        "given", "move.flange one.flange", "steady.flange two.flange",
        move=ia.Move(), steady=ia.ConstantSpeed(v_fixed=0.5), **parts,
    )  # fmt: skip
    run = net.simulate(2.0, step=0.02, inputs=given)
    ax.plot(run.time, run["one.s"], label="Move")
    ax.plot(run.time, run["two.s"], label="ConstantSpeed")
    told(ax, "time [s]", "s [m], or phi [rad]")


def over_speed(ax: Axes, sources: dict[str, ia.Component], turning: bool) -> None:
    """Draw forces or torques over the speed of what is accelerated evenly."""
    kind: Any = rotational if turning else ia
    for name, source in sources.items():
        given = {"phi_ref" if turning else "s_ref": lambda t: t**2 / 2 - 2 * t}
        net = joined("swept", "source.flange drive.flange", source=source, drive=kind.Position(**given))
        run = net.simulate(4.0, step=0.02)
        ax.plot(run.time - 2, run["source.tau" if turning else "source.f"], label=name)
    told(ax, "w [rad/s]" if turning else "v [m/s]", "tau [N.m]" if turning else "f [N]")


@panel(
    "over_speed", "LinearSpeedDependentForce", "QuadraticSpeedDependentForce", "InverseSpeedDependentForce"
)
def _(ax: Axes) -> None:
    kinds = {"linear": ia.LinearSpeedDependentForce, "quadratic": ia.QuadraticSpeedDependentForce}
    sources: dict[str, ia.Component] = {
        name: kind(f_nominal=1.0, v_nominal=1.0) for name, kind in kinds.items()
    }
    over_speed(
        ax, sources | {"inverse": ia.InverseSpeedDependentForce(f_nominal=1.0, v_nominal=1.0, v0=0.3)}, False
    )


@panel(
    "over_speed", "rotational.LinearSpeedDependentTorque", "rotational.QuadraticSpeedDependentTorque",
    "rotational.InverseSpeedDependentTorque",
)  # fmt: skip
def _(ax: Axes) -> None:
    load: Any = {"tau_nominal": -1.0, "w_nominal": 1.0, "TorqueDirection": False}
    sources: dict[str, Any] = {
        "linear": rotational.LinearSpeedDependentTorque(**load),
        "quadratic": rotational.QuadraticSpeedDependentTorque(**load),
        "inverse": rotational.InverseSpeedDependentTorque(w0=0.3, **load),
    }
    over_speed(ax, sources, True)


@panel("over_speed", "RollingResistance", "EddyCurrentBrake", "rotational.EddyCurrentBrake")
def _(ax: Axes) -> None:
    sources: dict[str, Any] = {
        "RollingResistance": ia.RollingResistance(fWeight=100.0, CrConstant=0.01, v0=0.2),
        "EddyCurrentBrake, 20 °C": ia.EddyCurrentBrake(f_nominal=2.0, v_nominal=0.5, alpha20=0.004),
        "EddyCurrentBrake, 220 °C": ia.EddyCurrentBrake(
            f_nominal=2.0, v_nominal=0.5, alpha20=0.004, T=493.15
        ),
    }
    over_speed(ax, sources, False)


@panel("drives", "Vehicle")
def _(ax: Axes) -> None:
    for slope in (0.0, 0.05, 0.1):
        car = ia.Vehicle(m=1200.0, J=2.0, R=0.3, A=2.0, Cd=0.3, inclinationConstant=slope)
        motor = rotational.InverseSpeedDependentTorque(tau_nominal=400.0, w_nominal=100.0, w0=50.0)
        run = joined("trip", "motor.flange car.flangeR", motor=motor, car=car).simulate(60.0, step=0.25)
        ax.plot(run.time, 3.6 * run["car.v"], label=f"{100 * slope:g} % uphill")
    told(ax, "time [s]", "v [km/h], 40 kW")


@panel("drives", "PowerSensor", "MultiSensor", "rotational.PowerSensor", "rotational.MultiSensor")
def _(ax: Axes) -> None:
    net = joined(
        "measured",
        "push.flange meter.flange_a",
        "meter.flange_b body.flange oil.flange_b",
        "wall.flange oil.flange_a",
        push=ia.Force(f=swing(10.0, 0.5)),
        meter=ia.MultiSensor(),
        body=ia.Mass(m=1.0),
        oil=ia.Damper(d=4.0),
        wall=ia.Fixed(),
    )
    run = net.simulate(3.0, step=0.02)
    for name, unit in (("v", "m/s"), ("f", "N"), ("power", "W")):
        ax.plot(run.time, run[f"meter.{name}"], label=f"{name} [{unit}]")
    told(ax, "time [s]", "")


def blocks(ax: Axes, stop: float, given: Any, step: float = 0.01, **shown: ia.Component) -> None:
    """Draw what blocks of one input make of a signal."""
    runs = {
        name: ia.Network("block", block=block).simulate(stop, step=step, inputs={"block.u": given})
        for name, block in shown.items()
    }
    for name, run in runs.items():
        ax.plot(run.time, run["block.y"], label=name)
    for run in [*runs.values()][-1:]:
        ax.plot(run.time, run["block.u"], "k:", label="u")
    told(ax, "time [s]", "y")


@panel("signals", "signals.Sign", "signals.Hysteresis", "signals.Abs")
def _(ax: Axes) -> None:
    blocks(
        ax, 2.0, swing(1.5), Sign=signals.Sign(), Abs=signals.Abs(),
        Hysteresis=signals.Hysteresis(uLow=-0.5, uHigh=1.0),
    )  # fmt: skip


@panel("signals", "signals.BooleanToReal")
def _(ax: Axes) -> None:
    net = ia.Network("switched", wave=signals.Sine(f=1.0), level=signals.Hysteresis(uLow=-0.5, uHigh=0.5))
    net.add(number=signals.BooleanToReal(realTrue=0.8, realFalse=-0.2))
    net.connect(net.wave.y, net.level.u).connect(net.level.y, net.number.u)
    run = net.simulate(2.0, step=0.005)
    for name, label in (("number.y", "y"), ("level.y", "u: on, off"), ("wave.y", "signal")):
        ax.plot(run.time, run[name], label=label)
    told(ax, "time [s]", "")


@panel("signals", "signals.DeadZone", "signals.SampleHold")
def _(ax: Axes) -> None:
    blocks(
        ax, 1.0, swing(1.0), DeadZone=signals.DeadZone(u_max=0.3),
        SampleHold=signals.SampleHold(period=0.1, delay=0.05),
    )  # fmt: skip


@panel("tables", "signals.SecondOrder", "signals.TransferFunction")
def _(ax: Axes) -> None:
    blocks(
        ax, 2.0, lambda t: 1.0 + 0 * t, SecondOrder=signals.SecondOrder(w=10.0, D=0.2),
        TransferFunction=signals.TransferFunction(b=(-0.1, 1.0), a=(0.02, 0.3, 1.0)),
    )  # fmt: skip


@panel("signals", "signals.Switch", "signals.Min", "signals.Max", "signals.Feedback")
def _(ax: Axes) -> None:
    parts: dict[str, ia.Component] = {
        "one": signals.Sine(f=1.0), "two": signals.Ramp(height=1.0, duration=2.0), "Switch": signals.Switch(),
        "Min": signals.Min(), "Max": signals.Max(), "Feedback": signals.Feedback(),
    }  # fmt: skip
    net = joined(
        "two signals",
        "one.y Switch.u1 Switch.u2 Min.u1 Max.u1 Feedback.u1",
        "two.y Switch.u3 Min.u2 Max.u2 Feedback.u2",
        **parts,
    )
    run = net.simulate(2.0, step=0.01)
    for k, name in enumerate(("Switch", "Min", "Max", "Feedback")):
        ax.plot(run.time, run[f"{name}.y"] - 2.5 * k, label=f"{name}, {-2.5 * k:+g}" if k else name)
    told(ax, "time [s]", "y of a sine and a ramp")


@panel("tables", "signals.CombiTable1D", "signals.CombiTable2D")
def _(ax: Axes) -> None:
    table = ((-1.0, 0.0), (0.0, 1.0), (0.5, 0.5))
    shown = {f"1D, {how}": signals.CombiTable1D(table=table, extrapolation=how) for how in ("linear", "hold")}
    for name, block in shown.items():
        run = ia.Network("block", block=block).simulate(3.0, step=0.05, inputs={"block.u": lambda t: t - 1.5})
        ax.plot(run["block.u"], run["block.y"], label=name)
    field = signals.CombiTable2D(table=((0, 0, 1), (-1, 0, 1), (0, 1, 0), (1, 0, 1)))
    for u2 in (0.0, 0.5):
        given: dict[str, Any] = {"block.u1": lambda t: t - 1.0, "block.u2": lambda t, u2=u2: u2 + 0 * t}
        run = ia.Network("block", block=field).simulate(2.0, step=0.05, inputs=given)
        ax.plot(run["block.u1"], run["block.y"] - 2, "--", label=f"2D, u2 = {u2:g}; -2")
    told(ax, "u, u1", "y")


@panel("tables", "signals.Chirp", "signals.CombiTimeTable")
def _(ax: Axes) -> None:
    table = ((0.0, 2.0, 4.0), (1.0, 3.0, 4.0), (1.0, 2.0, 3.5), (2.0, 2.5, 5.0))
    net = ia.Network("sources", chirp=signals.Chirp(f_min=1.0, f_max=8.0, duration=2.0))
    net.add(table=signals.CombiTimeTable(table=table))
    run = net.simulate(2.0, step=0.005)
    for name in ("chirp", "table.column1", "table.column2"):
        ax.plot(run.time, run[f"{name}.y"], label=name)
    told(ax, "time [s]", "y")


@panel("heat", "thermal.HeatCapacitor", "thermal.ThermalConductor", "thermal.FixedTemperature")
def _(ax: Axes) -> None:
    for G in (0.5, 2.0):
        net = joined(
            "cooling",
            "body.port path.port_a",
            "path.port_b air.port",
            body=thermal.HeatCapacitor(C=10.0, T=353.15),
            path=thermal.ThermalConductor(G=G),
            air=thermal.FixedTemperature(T=293.15),
        )
        run = net.simulate(30.0, step=0.25)
        ax.plot(run.time, run["body.T"] - 273.15, label=f"G = {G:g} W/K")
    told(ax, "time [s]", "T of 10 J/K [°C]")


@panel("heat", "thermal.FixedHeatFlow", "thermal.TemperatureSensor")
def _(ax: Axes) -> None:
    net = joined(
        "heating",
        "heater.port body.port path.port_a gauge.port",
        "path.port_b air.port",
        "gauge.T control.u",
        heater=thermal.FixedHeatFlow(Q_flow=20.0),
        body=thermal.HeatCapacitor(C=10.0),
        gauge=thermal.TemperatureSensor(),
        path=thermal.ThermalConductor(G=0.5),
        air=thermal.FixedTemperature(),
        control=signals.FirstOrder(T=5.0),
    )
    run = net.simulate(60.0, step=0.5, start={"control.y": 293.15})
    ax.plot(run.time, run["gauge.T"] - 273.15, label="sensor")
    ax.plot(run.time, run["control.y"] - 273.15, label="behind a lag of 5 s")
    told(ax, "time [s]", "T at 20 W [°C]")


@panel("heat", "EddyCurrentBrake, with useHeatPort")
def _(ax: Axes) -> None:
    for C in (0.5, 50.0):
        brake = rotational.EddyCurrentBrake(
            tau_nominal=100.0, w_nominal=10.0, alpha20=0.004, useHeatPort=True
        )
        net = joined(
            "stop", "brake.flange wheel.flange", "brake.heatPort disc.port", brake=brake,
            wheel=rotational.Inertia(J=20.0, w=20.0), disc=thermal.HeatCapacitor(C=C * 20),
        )  # fmt: skip
        run = net.simulate(8.0, step=0.05)
        ax.plot(run.time, run["wheel.w"], label=f"w, disc of {20 * C:g} J/K")
    told(ax, "time [s]", "w [rad/s]")


@panel("trades", "machines.InterconnectedStruts")
def _(ax: Axes) -> None:
    car = machines.interconnected_car(
        machines.InterconnectedStruts(A_b=8e-4, A_r=5e-4, p_0=2e6, V_0=2e-4, R=2e9)
    )
    f = np.linspace(0.3, 5.0, 189)
    system = ia.analysis.linearise(
        car, ["left_road.s_ref", "right_road.s_ref"], ["body.s", "body.theta"], at="start"
    )
    response = system.response(f)
    heave, roll = abs(response[..., 0, :].sum(axis=-1)), abs(response[..., 1, 0] - response[..., 1, 1])
    ax.plot(f, heave, label="heave, roads alike")
    ax.plot(f, roll, label="roll [rad/m], roads opposed")
    told(ax, "frequency [Hz]", "motion of the body")


@panel("trades", "machines.Unbalance")
def _(ax: Axes) -> None:
    for torque in (40.0, 60.0):
        plant = machines.sieve(drive=rotational.Inertia(J=2.0))
        plant.add(motor=rotational.ConstantTorque(tau_constant=torque), losses=rotational.Damper(d=0.5))
        plant.add(housing=rotational.Fixed()).connect(plant.housing.flange, plant.losses.flange_a)
        plant.connect(plant.motor.flange, plant.drive.flange, plant.losses.flange_b)
        run = plant.simulate(20.0, step=0.05)
        ax.plot(run.time, run["drive.w"], label=f"{torque:g} N.m")
    told(ax, "time [s]", "w of a sieve's rotor [rad/s]")


if __name__ == "__main__":
    pyplot.style.use(STYLE)
    for chosen in sys.argv[1:] or PICTURES:
        draw_picture(chosen)
        size = (IMAGES / f"catalogue_{chosen}.svg").stat().st_size
        print(f"{chosen}: {size / 1e3:.0f} kB", flush=True)
