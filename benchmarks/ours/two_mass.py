"""Wall, spring, mass, spring, mass from a cold start: final s1, s2, v1, v2."""

from inertance import Fixed, Mass, Network, Spring

net = Network(
    "pair", wall=Fixed(), k1=Spring(k=100.0), m1=Mass(m=1.0, s=0.1), k2=Spring(k=200.0), m2=Mass(m=1.0)
)
net.connect(net.wall.flange, net.k1.flange_a)
net.connect(net.k1.flange_b, net.m1.flange, net.k2.flange_a)
net.connect(net.k2.flange_b, net.m2.flange)
run = net.simulate(1.0)
print([float(run[name][-1]) for name in ("m1.s", "m2.s", "m1.v", "m2.v")])
