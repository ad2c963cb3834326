"""Wrong calls: type checkers refuse every line that ends in a comment, which says why."""

import inertance as ia
from inertance import machines, rotational, signals

net = ia.Network("oscillator", wall=ia.Fixed())
ia.Mass(mass=1.0)  # the parameter is m
ia.Mass(1.0)  # by name only
ia.Mass(s=0.1)  # m is missing
ia.Mass(m=1.0, s="left")  # a start value is a number
ia.Spring(k="a")  # no number
ia.Spring(k=None)  # no number
ia.Spring(k=1.0, c=2.0)  # a spring has no damping
ia.Masss(m=1.0)  # no such element
rotational.Inertia(m=1.0)  # what turns has J
rotational.Sprng(c=1.0)  # no such element
signals.Sine(f=1.0, frequency=2.0)  # there is f
ia.Force(f="sine")  # no signal
ia.Position(exact="yes")  # True or False
ia.PlanetaryFlywheel(N="4", R=1.0, r=0.3, J_s=1.0, J_p=1.0, J_r=1.0, k_r=1.0, c_r=1.0)  # a whole number
ia.MassWithStopAndFriction(m=1.0, s_min=-1.0, s_max=1.0, lower=0.0)  # a part is a component
net.simulate(1.0, stepp=0.1)  # the argument is step
net.simulate("1 s")  # a number
net.simulate(1.0, solver=5)  # a name
net.dae().x.nummel()  # states are symbols of CasADi
ia.simulat(net, 1.0)  # no such function
machines.TMD(m=10.0, k=1e3, b=1.0)  # it has no inertance
machines.BallScrewInerter(screw=0.01)  # a part is a component
machines.DualMassFlywheel(J=1.0)  # there are J_1 and J_2
net.simulate(1.0).rms(3)  # signals have names
net.simulate(1.0).animate(frames="all")  # a whole number
