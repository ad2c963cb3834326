"""Standard error: no integrator tells there what the library tells better, or what it mended."""

import subprocess
import sys
from pathlib import Path

SCRIPT = """
import sys
import inertance as ia

def joined(name, spring, **more):
    net = ia.Network(name, wall=ia.Fixed(), spring=spring, mass=ia.Mass(m=1.0, **more))
    net.connect(net.wall.flange, net.spring.flange_a)
    return net.connect(net.spring.flange_b, net.mass.flange)

swing = joined("swing", ia.Spring(k=1e6), s=0.1)
blowing_up = joined("blowing up", ia.CubicSpring(k=0.0, k3=-1.0), s=1.0, v=1.0)
runs = {
    "many steps": lambda **o: swing.simulate(10.0, step=10.0, max_steps=50, **o),
    "no end": lambda **o: blowing_up.simulate(10.0, step=1.0, **o),
    "no start": lambda **o: swing.simulate(1.0, start={"mass.s": 1e300, "mass.v": 1e300}, **o),
    "many steps of slopes": lambda **o: swing.simulate(9.0, step=9.0, sensitivities=["spring.k"], **o),
}
for solver in sys.argv[1:]:
    for name, run in runs.items():
        try:
            run(solver=solver)
            print(solver, name, "ended")
        except ia.SimulationError as error:
            print(solver, name, error)
"""
SOLVERS = ("cvodes", "idas", "rosenbrock")


def test_integrators_tell_nothing_themselves(tmp_path: Path) -> None:
    (tmp_path / "script.py").write_text(SCRIPT)
    command = [sys.executable, str(tmp_path / "script.py"), *SOLVERS]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    for solver in SOLVERS:
        assert f"{solver} many steps 'swing': given up after" in done.stdout
        assert f"{solver} no end 'blowing up': integration failed at t = 1.31" in done.stdout
