"""A rig to begin with: a body on a spring and a damper, carried by a support that moves.

inertance run rig.py:build --plot 'body.s,support.s_ref'     runs it and draws what is named
inertance run rig.py:build --set spring.k=2000 --stop 5      with another spring
python rig.py                                                does the same in Python
"""

import inertance as ia
from inertance import signals


def build() -> ia.Network:
    """Return the rig. `inertance components` lists what else there is to build with."""
    net = ia.Network(
        "rig",
        # Elements by names of your own; values are in SI units.
        motion=signals.Sine(amplitude=0.01, f=1.0),  # m, Hz
        support=ia.Position(),
        spring=ia.Spring(k=1000.0),  # N/m
        damper=ia.Damper(d=20.0),  # N.s/m
        body=ia.Mass(m=10.0, s=0.0, v=0.0),  # kg; at rest when a run begins
    )
    # Each line is a node: what it names moves as one there, and the forces add up to zero.
    net.connect(net.motion.y, net.support.s_ref)
    net.connect(net.support.flange, net.spring.flange_a, net.damper.flange_a)
    net.connect(net.spring.flange_b, net.damper.flange_b, net.body.flange)
    return net


if __name__ == "__main__":
    run = build().simulate(10.0)
    print(run.summary())
    print(f"largest force of the spring: {abs(run['spring.f']).max():.3g} N")
    run.save("rig.csv", "body.*", "spring.f")
    run.plot("body.s", "spring.f").savefig("rig.png")
