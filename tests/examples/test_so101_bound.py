"""examples/so101_bound.py: a law that is there is found; what dry friction leaves of the measured joint."""

from pathlib import Path
from typing import Any

import inertance as ia
import numpy as np
import pytest
from inertance.identification import Multisine, sampled

EXAMPLE = "so101_bound"
SPAN = (0.0, 6.0)
LAWS: dict[str, Any] = {"dry": ((), ()), "ripple": ((0.3,), (0.2,))}


def write(path: Path, example: Any, seed: int) -> None:
    """Write a motion of a joint whose friction has waves and a direction."""
    truth = example.servo(*LAWS["ripple"])
    truth.wave_1.c, truth.step_1.even = 0.3, 0.1
    shape = Multisine(rms=0.3, low=0.2, high=2.0, period=6.0, seed=seed)
    drive = sampled(shape, 6.0, 50.0)
    held = ia.Sampled(drive.time, drive.values, interpolation="hold")
    run = truth.simulate(6.0, inputs={"error.u1": held}, step=0.02, rtol=1e-8)
    phi = run["encoder.phi"][np.searchsorted(run.time, drive.time + 1e-6, side="right") - 1]
    phi = phi + 1e-4 * np.random.default_rng(seed).standard_normal(len(phi))
    columns = np.column_stack([drive.time, drive.values, phi])
    np.savetxt(path, columns, delimiter=",", header="t [s],command [rad],position [rad]", comments="")


def test_what_a_law_leaves_is_noise_once_it_holds_what_is_there(
    example: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for seed, name in enumerate(("fitted", "tested")):
        write(tmp_path / f"{name}.csv", example, seed)
    monkeypatch.setattr(example.joint, "TESTED", {"tested": SPAN})
    monkeypatch.setattr(example, "LAWS", LAWS)
    dry, ripple = (example.left(example.fitted(tmp_path, law, {"fitted": SPAN})) for law in LAWS)
    assert dry > 0.01 > 0.001 > ripple
    own = example.left(example.fitted(tmp_path, "ripple", {"tested": SPAN}))
    assert own <= ripple


def test_what_dry_friction_leaves_of_the_measured_motions(example: Any) -> None:
    names = (*example.joint.FITTED, *example.joint.TESTED)
    if not all((example.joint.DATA / f"{name}.csv").is_file() for name in names):
        pytest.skip("no SO-101 records: not checked is what dry friction leaves of the measured motions")
    dry = next(iter(example.LAWS))
    shares = [
        example.left(example.fitted(example.joint.DATA, dry, motions))
        for motions in (example.joint.FITTED, example.joint.TESTED)
    ]
    assert shares == pytest.approx([0.0103, 0.0069], rel=0.05)
