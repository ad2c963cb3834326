"""Fuzz of exported FMUs: random sequences of FMI calls, under AddressSanitizer and UBSan where there.

    python tests/fuzz/fuzz.py [--count 100000] [--seed 0]

For FMI 2.0 and 3.0, Model Exchange and Co-Simulation: legal sequences, in which no call may be refused; and
sequences with bad value references, NaN and infinite numbers, steps of zero or less, empty and absent arrays,
calls out of order, states that are garbage, cut or restored after terminate. A crash, a sequence that takes
longer than 30 s, and memory that is not freed end the program.
"""

from __future__ import annotations

import argparse
import shutil
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

import fmpy
import inertance as ia

HERE = Path(__file__).parent
SANITIZERS = ("-fsanitize=address,undefined", "-fno-sanitize-recover=all", "-fno-omit-frame-pointer")
STRICT = ("-std=c99", "-D_DEFAULT_SOURCE", "-Wall", "-Wextra", "-Werror", "-O1", "-g")
KINDS = {"ME": "me", "CS": "cs"}


def machine() -> ia.Network:
    """A ball above a stop, a block on a belt within a clearance, and two cubic springs in line.

    So there are events, shocks, corners and a loop.
    """
    net = ia.Network(
        "machine",
        floor=ia.Fixed(),
        stop=ia.HardStop(e=0.7),
        ball=ia.Mass(m=0.5, s=1.0),
        weight=ia.ConstantForce(f_constant=-4.905),
        push=ia.Force(),
        belt=ia.Speed(v_ref=0.1),
        rub=ia.StribeckFriction(f_c=5.0, f_s=8.0, v_s=0.05),
        block=ia.Mass(m=1.0),
        play=ia.Backlash(k=1e4, d=10.0, eps=0.01),
        inner=ia.CubicSpring(k=100.0, k3=1e4),
        outer=ia.CubicSpring(k=50.0, k3=3e4),
    )
    net.connect(net.floor.flange, net.stop.flange_a, net.inner.flange_a, net.play.flange_a)
    net.connect(net.stop.flange_b, net.ball.flange, net.weight.flange, net.push.flange)
    net.connect(net.belt.flange, net.rub.flange_a)
    net.connect(net.inner.flange_b, net.outer.flange_a)
    return net.connect(net.rub.flange_b, net.block.flange, net.outer.flange_b, net.play.flange_b)


def compiler() -> str | None:
    """Return the C compiler, if there is one."""
    return next((name for name in ("gcc", "clang", "cc") if shutil.which(name)), None)


def has_sanitizers(command: str, folder: Path) -> bool:
    """Tell whether programs can be built with sanitizers, and run."""
    (folder / "empty.c").write_text("int main(void) { return 0; }\n")
    build = [command, *SANITIZERS, str(folder / "empty.c"), "-o", str(folder / "empty")]
    return (
        subprocess.run(build, capture_output=True).returncode == 0
        and subprocess.run([str(folder / "empty")], capture_output=True).returncode == 0
    )


def build(version: str, folder: Path, sanitized: bool) -> Path:
    """Return the fuzz driver of an FMI version, compiled with the sources of the machine's FMU."""
    command = compiler()
    assert command is not None
    path = ia.export_fmu(
        machine(),
        folder / f"fuzz{version[0]}.fmu",
        fmi_version=version,
        platforms=[],
        start={"rub.v_rel": 0.0},
    )
    inside = Path(fmpy.extract(str(path), unzipdir=str(folder / version))) / "sources"
    program = folder / f"fuzz{version[0]}"
    flags = [*STRICT, *(SANITIZERS if sanitized else ()), f"-I{inside}", f"-I{HERE}"]
    files = [str(HERE / f"fuzz{version[0]}.c"), *sorted(str(f) for f in inside.glob("*.c"))]
    done = subprocess.run(
        [command, *flags, *files, "-o", str(program), "-lm"], capture_output=True, text=True
    )
    if done.returncode:
        raise RuntimeError(done.stderr)
    return program


def run(program: Path, kind: str, count: int, seed: int) -> subprocess.CompletedProcess[str]:
    """Run a driver."""
    command = [str(program), KINDS[kind], str(count), str(seed)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def main() -> int:
    """Fuzz all four kinds, print the counts, and return the exit code."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--count", type=int, default=100_000, help="sequences of each kind")
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    failed = 0
    with TemporaryDirectory(prefix="inertance-") as name:
        folder = Path(name)
        command = compiler()
        if command is None:
            print("needs a C compiler: cc, gcc or clang")
            return 2
        sanitized = has_sanitizers(command, folder)
        print(f"{given.count} sequences of each kind, {'with' if sanitized else 'WITHOUT'} sanitizers")
        for version in ("2.0", "3.0"):
            program = build(version, folder, sanitized)
            for kind in KINDS:
                began = perf_counter()
                done = run(program, kind, given.count, given.seed)
                told = done.stdout.strip() or done.stderr.strip()
                print(f"FMI {version} {kind}: exit {done.returncode}, {told}, {perf_counter() - began:.0f} s")
                failed += done.returncode != 0
    return min(failed, 1)


if __name__ == "__main__":
    sys.exit(main())
