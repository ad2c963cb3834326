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

from ...base import Array, Complex, ModelError, between, demand, listed, named, nearest, text, whole
from ..dae import DAE
from ..given import dae_of
from ..network import Network
from ..simulation.simulate import simulate
from .operating import inputs_at_rest, operating_point
from .orbits import Orbit, drive_amplitude


class Balance:
    """The residual of harmonic balance for a network driven by amplitude sin(w t) at one input.

    Args:
        network, driven, amplitude, outputs, harmonics, signals, parameters: as for `harmonic_response`.
    """

    def __init__(
        self,
        network: Network | DAE,
        driven: str,
        amplitude: float,
        outputs: Sequence[str],
        harmonics: int,
        signals: Mapping[str, float] | None,
        parameters: Mapping[str, float] | None,
    ) -> None:
        dae = dae_of(network)
        self.signals, self.parameters = named("signals", signals), named("parameters", parameters)
        if dae.hybrid:
            raise ModelError(
                f"'{dae.name}' switches modes, and harmonic balance is for smooth equations; give friction "
                "regularised=, or use stepped_sine()"
            )
        demand(
            "harmonic balance",
            amplitude=(amplitude, drive_amplitude),
            harmonics=(harmonics, lambda count: whole(1)(count) or between(1, 1000)(count)),
        )
        if text(driven) or driven not in dae.input_names:
            told = nearest(str(driven), dae.input_names)
            raise ModelError(f"'{dae.name}' has no input '{driven}'{told}")
        self.dae, self.driven, self.amplitude = dae, driven, amplitude
        self.outputs = list(listed("outputs", outputs))
        self.harmonics = harmonics
        self.points = int(2 ** np.ceil(np.log2(max(128, 16 * harmonics))))  # well above what these need
        self.rest = operating_point(dae, inputs={**self.signals, driven: 0.0}, parameters=self.parameters)
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
        """Return the equations with slopes in unknowns and frequency, and the outputs, at all instants."""
        dae, w = self.dae, ca.SX.sym("w")
        both = ca.vertcat(dae.ode, dae.alg)
        slopes = ca.densify(ca.jacobian(both, ca.vertcat(dae.x, dae.z)))
        input_rates = [dae.u[k] * declared.order / w for k, declared in enumerate(dae.inputs)]
        rates = ca.densify(ca.jtimes(both, dae.u, ca.vertcat(ca.SX(0, 1), *input_rates)))
        outputs = ca.vertcat(ca.SX(0, 1), *[dae.expression(name) for name in self.outputs])
        equations = ca.Function("balance", [*dae.arguments(), w], [ca.densify(both), ca.vec(slopes), rates])
        seen = ca.Function("seen", dae.arguments(), [ca.densify(outputs)])
        return equations.map(self.points), seen.map(self.points)

    def _arguments(self, motion: Array, w: float) -> tuple[Array, ...]:
        """Return what the equations depend on, one column an instant."""
        q = np.repeat(self.rest.q[:, None], self.points, axis=1)
        time = np.full((1, self.points), self.rest.t)
        return motion.T[: self.n], motion.T[self.n :], self._inputs(w), q, time

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
        drive: dict[str, Any] = {self.driven: lambda t: self.amplitude * np.sin(w * t)}
        step, given = period / self.points, inputs_at_rest(self.dae) | self.signals | drive
        run = simulate(
            self.dae, periods * period, inputs=given, parameters=self.parameters, step=step, progress=False
        )
        times = (periods - 1) * period + self._phase / w
        names = [*self.dae.state_names, *(self.dae.name_of(v) for v in self.dae.algebraic)]
        motion = np.stack([np.interp(times, run.time, run[name]) for name in names], axis=1)
        return np.ravel(self._analysis @ motion)

    def motion(self, y: Array) -> Array:
        """Return states and algebraic unknowns at the instants, (instants, unknowns)."""
        return np.asarray(self._synthesis @ y.reshape(-1, self.size))

    def residual(self, y: Array, w: float) -> tuple[Array, Array, Array]:
        """Return the residual and its slopes in the coefficients and in w [rad/s]."""
        Y, count = y.reshape(-1, self.size), 2 * self.harmonics + 1
        motion = self.motion(y)
        value, local, rates = self._evaluate(motion, w)
        derivative = np.zeros_like(Y)
        derivative[:, : self.n] = self._slope @ Y[:, : self.n]
        missed = self._analysis @ value - w * derivative
        spread = (self._products @ local.reshape(self.points, -1)).reshape(count, count, self.size, self.size)
        spread = spread.transpose(0, 2, 1, 3).copy()
        for j in range(self.n):
            spread[:, j, :, j] -= w * self._slope
        jacobian = spread.reshape(count * self.size, count * self.size)
        of_w = self._analysis @ rates - derivative
        return missed.ravel(), jacobian, of_w.ravel()

    def _evaluate(self, motion: Array, w: float) -> tuple[Array, Array, Array]:
        """Return the residual at the instants, its slopes in the unknowns and its rates in w."""
        found = self._functions[0](*self._arguments(motion, w), np.full((1, self.points), w))
        value, slopes, rates = (part.full().T for part in found)
        return value, slopes.reshape(self.points, self.size, self.size).transpose(0, 2, 1), rates

    def orbit(self, y: Array, w: float) -> Orbit:
        """Return the periodic motion that coefficients stand for."""
        motion = self.motion(y)
        seen = self._functions[1](*self._arguments(motion, w)).full()
        lines = np.fft.rfft(seen, axis=1)[:, : self.harmonics + 1] / self.points
        power = np.abs(lines[:, 1:]) ** 2
        tail = power[:, -max(1, self.harmonics // 10) :].sum() / max(float(power.sum()), 1e-300)
        Y = y.reshape(-1, self.size)
        half = (Y[1 : self.harmonics + 1] - 1j * Y[self.harmonics + 1 :]) / 2
        coefficients = np.vstack([Y[:1] + 0j, half]).astype(np.complex128)
        outputs = dict(zip(self.outputs, lines, strict=True))
        multipliers = self._multipliers(motion, w)
        return Orbit(self.dae, w / (2 * np.pi), coefficients, outputs, multipliers, float(tail))

    def _multipliers(self, motion: Array, w: float) -> Complex:
        """Return the Floquet multipliers: the eigenvalues of the monodromy matrix.

        It is the product of exponentials of the slopes along the orbit.

        Source: Friedmann, Hammond & Woo, Int. J. Numer. Methods Eng. 11 (1977) 1117-1136.
        """
        of_x, of_z = np.split(self._evaluate(motion, w)[1], [self.n], axis=2)
        A = of_x[:, : self.n]
        if self.m:
            A = A - of_z[:, : self.n] @ np.linalg.solve(of_z[:, self.n :], of_x[:, self.n :])
        monodromy = np.eye(self.n)
        for step in _exponentials(A * (2 * np.pi / w / self.points)):
            monodromy = step @ monodromy
        return np.linalg.eigvals(monodromy).astype(np.complex128)


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
