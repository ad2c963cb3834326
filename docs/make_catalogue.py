"""Draw images/catalogue.png: what elements answer to a motion of 10 mm at 1 Hz, or of 0.1 rad.

python docs/make_catalogue.py
"""

from io import BytesIO
from pathlib import Path

import inertance as ia
import numpy as np
from inertance import rotational
from matplotlib import pyplot
from PIL import Image

PICTURE = Path(__file__).parent / "images" / "catalogue.png"
ELEMENTS: dict[str, ia.Component] = {
    "TabulatedSpring": ia.TabulatedSpring(table=((-0.01, -2e3), (-0.005, -200.0), (0.0, 0.0), (0.01, 300.0))),
    "CubicSpring": ia.CubicSpring(k=2e4, k3=3e8),
    "ObliqueSprings": ia.ObliqueSprings(k=1e4, a=0.02, l_0=0.03),
    "Rope": ia.Rope(k=2e4, d=200.0),
    "Zener": ia.Zener(k_0=1e4, k=3e4, d=3e3),
    "AirSpring": ia.AirSpring(A=0.01, p_0=5e5, V_0=4e-4),
    "QuadraticDamper": ia.QuadraticDamper(c=5e3),
    "BoucWen": ia.BoucWen(k=1e5, alpha=0.2, beta=1.25e5, gamma=1.25e5, n=2.0),
    "CoulombFriction": ia.CoulombFriction(f_c=100.0),
    "LuGreFriction": ia.LuGreFriction(
        f_c=80.0, f_s=120.0, v_s=0.01, sigma_0=2e5, sigma_1=400.0, sigma_2=200.0
    ),
    "Jenkins": ia.Jenkins(k=5e4, f_c=100.0),
    "Inerter": ia.Inerter(b=300.0),
    "Backlash": ia.Backlash(k=1e5, d=100.0, eps=4e-3),
    "WireRope": ia.WireRope(k_1=1e4, k_3=1e8, f_y=80.0, s_y=1e-3),
    "rotational.HarmonicRipple": rotational.HarmonicRipple(tau_sin=2.0, tau_cos=0.0, period=0.05),
    "FractionalDamper": ia.FractionalDamper(c=2e3, alpha=0.5, w_low=0.6, decades=3),
}


def answer(element: ia.Component) -> tuple[np.ndarray, np.ndarray, tuple[str, str]]:
    """Return motion and force over the last of three cycles, with their names."""
    turns = isinstance(element, rotational.TwoFlanges)
    kind, drive, size = (rotational, rotational.Position, 0.1) if turns else (ia, ia.Position, 0.01)
    net = ia.Network(
        "driven", wall=kind.Fixed(), element=element,
        drive=drive(**{"phi_ref" if turns else "s_ref": lambda t: size * np.sin(2 * np.pi * t)}),
    )  # fmt: skip
    net.connect(net.wall.flange, net.element.flange_a).connect(net.element.flange_b, net.drive.flange)
    run = net.simulate(3.0, step=2e-3, rtol=1e-7)
    last = run.time >= 2.0
    names = ("phi_rel", "tau") if turns else ("s_rel", "f")
    motion, force = (run[f"element.{name}"][last] for name in names)
    return motion, force, ("angle [rad]", "torque [N.m]") if turns else ("stretch [mm]", "force [N]")


def main() -> None:
    """Draw all elements."""
    figure, axes = pyplot.subplots(4, 4, figsize=(11.0, 9.5), layout="constrained")
    for ax, (name, element) in zip(axes.ravel(), ELEMENTS.items(), strict=True):
        motion, force, labels = answer(element)
        ax.plot(motion if labels[0] == "angle [rad]" else 1e3 * motion, force, linewidth=1.4)
        ax.set_title(name, fontsize="medium")
        ax.set_xlabel(labels[0], fontsize="small")
        ax.set_ylabel(labels[1], fontsize="small")
        ax.tick_params(labelsize="small")
        ax.grid(alpha=0.3)
    with BytesIO() as file:
        figure.savefig(file, dpi=90)
        Image.open(file).convert("RGB").quantize(64).save(PICTURE, optimize=True)


if __name__ == "__main__":
    main()
