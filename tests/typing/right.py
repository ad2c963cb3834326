"""Right calls: type checkers accept every line."""

from fractions import Fraction
from math import pi

import casadi as ca
import inertance as ia
import numpy as np
from inertance import machines, parameter, rotational, signals
from inertance.components import Stated

mass = ia.Mass(m=1, s=0.1, v=np.float64(0.2))
mass.m = 2.0
springs = [ia.Spring(k=np.float32(1.0)), ia.Spring(k=np.arange(3)[1]), ia.Spring(k=Fraction(1, 3), s_rel0=0)]
compliant: ia.Compliant = springs[0]
component: ia.Component = compliant.with_values(k=3.0)
pushes = [ia.Force(), ia.Force(f=3), ia.Force(f=lambda t: ca.sin(2 * pi * t)), ia.Force(f=np.sin)]
recorded = ia.Position(s_ref=ia.Sampled([0.0, 1.0, 2.0, 3.0], [0.0, 0.1, 0.1, 0.0]), exact=False)
smooth = [ia.CoulombFriction(f_c=1.0, regularised=None), ia.CoulombFriction(f_c=1.0, regularised=1e-3)]
tables = [ia.TabulatedFriction(table=((0.0, 1.0), (1.0, 2.0))), ia.TabulatedFriction(table=[[0, 1], [1, 2]])]
delay = signals.Delay(T=0.1, n=int(np.int64(3)))
clutch = rotational.Clutch(fn_max=10.0, mu_pos=((0.0, 0.4),), f_normalized=lambda t: t)
planet = ia.Planet(R=0.05, r=0.017, J_p=1e-5, J_r=1e-4, k_r=1e8, c_r=4e3)
planets = ia.PlanetaryFlywheel(
    N=3, lumped=False, planet_2=planet, R=0.05, r=0.017, J_s=3e-4, J_p=1e-5, J_r=1e-4, k_r=1e8, c_r=4e3
)
screw = ia.CompliantNutScrew(
    lead=0.01, m_r=1.7, k=1e7, d=1e3, eps=1e-7, friction=rotational.CoulombFriction(tau_c=0.2)
)


class Strut(ia.TwoFlanges):
    """A composite: parts take parameters of the whole, and functions of it."""

    k = parameter("N/m", "stiffness", above=0)
    spring = ia.SpringDamper(k=k, d=lambda self: 2 * (self.k * 3.0) ** 0.5)

    def connections(self) -> Stated:
        yield self.flange_a, self.spring.flange_a
        yield self.spring.flange_b, self.flange_b


class Stiffening(ia.Compliant):
    """An element of one's own: its parameters are symbols in its equations."""

    k = parameter("N/m", "stiffness", above=0)

    def equations(self) -> Stated:
        yield self.f == self.k * self.s_rel**3


net = ia.Network("rig", wall=ia.Fixed(), strut=Strut(k=2.0), law=Stiffening(k=1.0), mass=mass)
net.connect(net.wall.flange, net.strut.flange_a, net.law.flange_a)
net.connect(net.strut.flange_b, net.law.flange_b, net.mass.flange)
run = net.simulate(
    1, start={"mass.s": 0.1}, step=0.1, rtol=1e-8, solver="idas", progress=False, max_steps=10_000
)
dae = net.dae()
energy = ca.Function("energy", [dae.x, dae.p], [dae.expression("mass.v") ** 2 / 2])
absorbers: list[ia.Component] = [machines.TMD(m=10.0, k=1e3, d=5.0), machines.NES(m=1, k3=1e6, d=2.0)]
absorbers += [machines.TMDI(m=10.0, k=1e3, d=5.0, b=2.0, inerter=ia.Inerter(b=2.0))]
largest: float = run.peak("mass.s", begin=0.2)
several = run.rms(["mass.*", "strut.spring.f"])
sizes: list[float] = several.to_list()
stuck: float = run.at("mass.s", 0.5)
picture = run.animate(10, slower=2.0).save
