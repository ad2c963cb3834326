"""A component of your own: a spring that stiffens, and a rig that tries it.

inertance run component.py:build --plot body.s
python component.py                       checks it against a closed form
`inertance docs write-your-own-component` tells what else can be declared: modes, signals, composites.
"""

from collections.abc import Iterable
from math import sqrt
from typing import Any

import inertance as ia
from inertance import parameter


class StiffeningSpring(ia.Compliant):
    """A spring that stiffens: f = k s_rel (1 + (s_rel/s_1)^2).

    Source: where its law is written.
    """

    # Of `Compliant` it has flange_a, flange_b, their distance s_rel and the force f that pulls them together.
    k = parameter("N/m", "stiffness at rest", above=0)
    s_1 = parameter("m", "stretch at which the stiffness of rest is doubled", above=0, default=0.1)

    def equations(self) -> Iterable[Any]:
        """Yield the equations, `left == right`; here every name is a symbol."""
        yield self.f == self.k * self.s_rel * (1 + (self.s_rel / self.s_1) ** 2)


def build() -> ia.Network:
    """Return a body on the spring, pulled aside and let go."""
    net = ia.Network(
        "trial",
        wall=ia.Fixed(),
        spring=StiffeningSpring(k=100.0),
        body=ia.Mass(m=1.0, s=0.1, v=0.0),
    )
    net.connect(net.wall.flange, net.spring.flange_a)
    return net.connect(net.spring.flange_b, net.body.flange)


if __name__ == "__main__":
    run = build().simulate(5.0)
    # Its energy k s^2/2 (1 + (s/s_1)^2/2) = 0.75 J becomes m v^2/2 as the body passes the middle.
    expected, fastest = sqrt(2 * 0.75), abs(run["body.v"]).max()
    print(f"largest speed {fastest:.4f} m/s, by the energy {expected:.4f} m/s")
    assert abs(fastest / expected - 1) < 1e-2
