"""Harmonic balance: the equations of a network over one period, as a system in Fourier coefficients.

With x(t) = sum X_k exp(i k w t), nonlinear terms are evaluated at instants and transformed (alternating
frequency/time). Unknowns are the real coefficients of states and algebraic unknowns.

Source: Krack & Gross, Harmonic Balance for Nonlinear Vibration Problems (2019), chapters 2 to 4.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any

import casadi as ca
import numpy as np

from ...base import Array, Complex, ModelError, above, between, demand, listed, nearest, text, whole
from ..dae import DAE
from ..simulation.simulate import simulate
from .operating import operating_point
from .orbits import Orbit

MOST = 1e100


class Balance:
    """The residual of harmonic balance for a network driven by amplitude sin(w t) at one input.

    Args:
        dae: equations without modes.
        driven: path of the input.
        amplitude: of its sine.
        outputs: names of what is looked at.
        harmonics: how many are kept.
        signals: constant values of the other inputs.
        parameters: changed parameters.
    """

    def __init__(
        self,
        dae: DAE,
        driven: str,
        amplitude: float,
        outputs: Sequence[str],
        harmonics: int,
        signals: Mapping[str, float],
        parameters: Mapping[str, float],
    ) -> None:
        if dae.hybrid:
            raise ModelError(
                f"'{dae.name}' switches modes, and harmonic balance is for smooth equations; give friction "
                "regularised=, or use stepped_sine()"
            )
        demand("harmonic balance", amplitude=(amplitude, above(0)), harmonics=(harmonics, whole(1)))
        demand(
            "harmonic balance",
            amplitude=(amplitude, between(0, MOST)),
            harmonics=(harmonics, between(1, 1000)),
        )
        if text(driven) or driven not in dae.input_names:
            told = nearest(str(driven), dae.input_names)
            raise ModelError(f"'{dae.name}' has no input '{driven}'{told}")
        outputs = listed("outputs", outputs)
        self.dae, self.driven, self.amplitude, self.outputs = dae, driven, amplitude, list(outputs)
        self.signals, self.parameters = {**signals}, {**parameters}
        self.harmonics, self.points = harmonics, _points(harmonics)
        self.rest = operating_point(dae, inputs={**signals, driven: 0.0}, parameters=parameters)
        self.n, self.m = dae.x.numel(), dae.z.numel()
        self.size = self.n + self.m
        self._phase = 2 * np.pi * np.arange(self.points) / self.points
        k = np.arange(1, harmonics + 1)
        waves = np.outer(self._phase, k)
        self._synthesis = np.hstack([np.ones((self.points, 1)), np.cos(waves), np.sin(waves)])
        self._analysis = self._synthesis.T * np.r_[1.0, np.full(2 * harmonics, 2.0)][:, None] / self.points
        self._slope = np.zeros((2 * harmonics + 1,) * 2)
        self._slope[k, k + harmonics], self._slope[k + harmonics, k] = k, -k

    @cached_property
    def _products(self) -> Array:
        """Return what each instant's slope gives to each pair of coefficients."""
        pairs: Array = self._analysis[:, None, :] * self._synthesis.T[None, :, :]
        return pairs.reshape(-1, self.points)

    @cached_property
    def _functions(self) -> tuple[Any, Any]:
        dae = self.dae
        both = ca.vertcat(dae.ode, dae.alg)
        slopes = ca.densify(ca.jacobian(both, ca.vertcat(dae.x, dae.z)))
        wanted = ca.vertcat(ca.SX(0, 1), *[dae.expression(name) for name in self.outputs])
        rates = (
            ca.densify(ca.jtimes(both, dae.u, self._input_rates)) if dae.u.numel() else ca.SX(self.size, 1)
        )
        arguments = [*dae.arguments(), self._w]
        equations = ca.Function("balance", arguments, [ca.densify(both), ca.vec(slopes), rates])
        seen = ca.Function("seen", dae.arguments(), [ca.densify(wanted)])
        return equations.map(self.points), seen.map(self.points)

    @cached_property
    def _w(self) -> Any:
        return ca.SX.sym("w")

    @property
    def _input_rates(self) -> Any:
        """Return how the inputs change with the frequency: order/w of themselves."""
        entries = [self.dae.u[k] * i.order / self._w for k, i in enumerate(self.dae.inputs)]
        return ca.vertcat(*entries)

    def _inputs(self, w: float) -> Array:
        values = np.repeat(self.rest.u[:, None], self.points, axis=1)
        for k, declared in enumerate(self.dae.inputs):
            if declared.path == self.driven:
                turned = np.sin(self._phase + declared.order * np.pi / 2)
                values[k] = declared.sign * self.amplitude * w**declared.order * turned
        return values

    def start(self) -> Array:
        """Return the coefficients of standing still."""
        y = np.zeros((2 * self.harmonics + 1, self.size))
        y[0] = np.r_[self.rest.x, self.rest.z]
        return y.ravel()

    def simulated(self, w: float, periods: int = 60) -> Array:
        """Return the coefficients of the last of some simulated periods."""
        period = 2 * np.pi / w
        held = {i.path: 0.0 for i in self.dae.inputs if i.order == 0 and i.signal is None} | self.signals
        drive: dict[str, Any] = {self.driven: lambda t: self.amplitude * np.sin(w * t)}
        run = simulate(
            self.dae,
            periods * period,
            inputs=held | drive,
            parameters=self.parameters,
            step=period / self.points,
            progress=False,
        )
        times = (periods - 1) * period + self._phase / w
        names = [*self.dae.state_names, *(self.dae.name_of(v) for v in self.dae.algebraic)]
        motion = np.stack([np.interp(times, run.time, run[name]) for name in names], axis=1)
        coefficients: Array = self._analysis @ motion
        return coefficients.ravel()

    def motion(self, y: Array) -> Array:
        """Return states and algebraic unknowns at the instants, (instants, unknowns)."""
        moved: Array = self._synthesis @ y.reshape(-1, self.size)
        return moved

    def residual(self, y: Array, w: float) -> tuple[Array, Array, Array]:
        """Return the residual and its slopes in the coefficients and in w [rad/s]."""
        Y, count = y.reshape(-1, self.size), 2 * self.harmonics + 1
        motion = self.motion(y)
        value, slopes, rates = self._evaluate(motion, w)
        derivative = np.zeros_like(Y)
        derivative[:, : self.n] = self._slope @ Y[:, : self.n]
        missed = self._analysis @ value - w * derivative
        local = slopes.reshape(self.points, self.size, self.size).transpose(0, 2, 1)
        spread = (self._products @ local.reshape(self.points, -1)).reshape(count, count, self.size, self.size)
        spread = spread.transpose(0, 2, 1, 3).copy()
        for j in range(self.n):
            spread[:, j, :, j] -= w * self._slope
        jacobian = spread.reshape(count * self.size, count * self.size)
        of_w = self._analysis @ rates - derivative
        return missed.ravel(), jacobian, of_w.ravel()

    def _evaluate(self, motion: Array, w: float) -> tuple[Array, Array, Array]:
        q = np.repeat(self.rest.q[:, None], self.points, axis=1)
        time = np.full((1, self.points), self.rest.t)
        split = motion.T[: self.n], motion.T[self.n :]
        found = self._functions[0](*split, self._inputs(w), q, time, np.full((1, self.points), w))
        value, slopes, rates = (part.full().T for part in found)
        return value, slopes, rates

    def orbit(self, y: Array, w: float) -> Orbit:
        """Return the periodic motion that coefficients stand for."""
        motion = self.motion(y)
        q = np.repeat(self.rest.q[:, None], self.points, axis=1)
        time = np.full((1, self.points), self.rest.t)
        seen = self._functions[1](motion.T[: self.n], motion.T[self.n :], self._inputs(w), q, time).full()
        lines = np.fft.rfft(seen, axis=1)[:, : self.harmonics + 1] / self.points
        power = np.abs(lines[:, 1:]) ** 2
        tail = power[:, -max(1, self.harmonics // 10) :].sum() / max(float(power.sum()), 1e-300)
        Y = y.reshape(-1, self.size)
        half = (Y[1 : self.harmonics + 1] - 1j * Y[self.harmonics + 1 :]) / 2
        outputs = dict(zip(self.outputs, lines, strict=True))
        return Orbit(
            self.dae,
            w / (2 * np.pi),
            np.vstack([Y[:1] + 0j, half]).astype(np.complex128),
            outputs,
            self._multipliers(motion, w),
            float(tail),
        )

    def _multipliers(self, motion: Array, w: float) -> Complex:
        """Return the Floquet multipliers: the product of exponentials of the slopes along the orbit.

        Source: Friedmann, Hammond & Woo, Int. J. Numer. Methods Eng. 11 (1977) 1117-1136.
        """
        slopes = self._evaluate(motion, w)[1].reshape(self.points, self.size, self.size).transpose(0, 2, 1)
        A, of_z, G, G_z = (
            slopes[:, : self.n, : self.n], slopes[:, : self.n, self.n :],
            slopes[:, self.n :, : self.n], slopes[:, self.n :, self.n :],
        )  # fmt: skip
        if self.m:
            A = A - of_z @ np.linalg.solve(G_z, G)
        steps = _exponentials(A * (2 * np.pi / w / self.points))
        whole = np.eye(self.n)
        for step in steps:
            whole = step @ whole
        multipliers: Complex = np.linalg.eigvals(whole).astype(np.complex128)
        return multipliers


def _exponentials(matrices: Array) -> Array:
    """Return exp of each matrix, (..., n, n), by Pade approximation with scaling and squaring."""
    size = float(np.abs(matrices).sum(axis=-1).max(initial=0.0))
    halvings = max(0, int(np.ceil(np.log2(max(size, 1e-300)))) + 2)
    X = matrices / 2.0**halvings
    eye = np.broadcast_to(np.eye(X.shape[-1]), X.shape)
    X2 = X @ X
    even, odd = eye + X2 * (3 / 28) + X2 @ X2 * (1 / 1680), X @ (eye / 2 + X2 / 84)
    found = np.asarray(np.linalg.solve(even - odd, even + odd), dtype=float)
    for _ in range(halvings):
        found = found @ found
    return found


def _points(harmonics: int) -> int:
    """Return how many instants a period has: a power of two, well above what the harmonics need."""
    return int(2 ** np.ceil(np.log2(max(128, 16 * harmonics))))
