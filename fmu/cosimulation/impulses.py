"""Impulses: what passes in no time between a network and an FMU, for which FMI has no signal."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from ...base import Array
from ...networks import Event, Stepwise
from ..errors import FMUError
from .components import FMUBlock
from .coupling import Coupling

REMEDY = (
    "FMI has no signal for impulses; put a spring between, or all that is struck together on one side, in "
    "the network or in the FMU"
)


class Impulses:
    """Refuses shocks that would act on both sides at once, of which one would know nothing."""

    def __init__(self, network: Stepwise, couplings: Mapping[str, Coupling]) -> None:
        self._network, self._couplings = network, couplings
        self._feels = [p for p, one in couplings.items() if not isinstance(one.component, FMUBlock)]
        self._answer = {
            shock: path
            for path in self._feels
            for taken in couplings[path].component.taken
            for shock in network.shocks(f"{path}.{taken.name}", taken.order)
        }

    def check_shocks(self, events: Sequence[Event]) -> None:
        """Refuse events of the network whose impulse would act on an FMU.

        Raises:
            FMUError: naming the event and the FMU.
        """
        for event in events:
            path = event.mode.rpartition(".")[0]
            if self._feels and event.mode not in self._network.modes:
                raise FMUError(
                    f"'{self._network.name}': {event.component} jumps at t = {event.time:.9g} s, and what "
                    f"that does to the FMU '{self._feels[0]}' cannot be told; give a ramp, or exact=False"
                )
            if event.impulse and path in self._answer:
                raise FMUError(
                    f"'{self._network.name}': the impulse of {event.component} at t = {event.time:.9g} s "
                    f"({event.impulse:.4g} N.s, or N.m.s) acts on the FMU '{self._answer[path]}', too, which "
                    f"cannot be told; {REMEDY}"
                )

    def check_jumps(self, gave: Mapping[str, Array], give: Mapping[str, Array]) -> None:
        """Refuse jumps of an FMU's velocity that move inertia of the network with it.

        Args:
            gave: what the FMUs gave before they jumped, by path.
            give: what they give now.

        Raises:
            FMUError: naming the FMU and the inertia.
        """
        for path, one in self._couplings.items():
            for name, course, jump in one.jumps(gave[path], give[path]):
                wanted = [(f"{path}.{taken.name}", 0) for taken in one.component.taken]
                self._network.set({name: course})
                still = self._network.observe(wanted)
                self._network.set({name: [*course, 0.5]})
                inertia = float(np.abs(self._network.observe(wanted) - still).max())
                self._network.set({name: course})
                if inertia > 0:
                    raise FMUError(
                        f"'{self._network.name}': at t = {self._network.time:.9g} s an event of an FMU lets "
                        f"the velocity of '{name}' jump by {jump:.4g} m/s (or rad/s), and {inertia:.4g} kg "
                        "(or kg.m2) of the network with it, whose impulse the FMU cannot be told; " + REMEDY
                    )
