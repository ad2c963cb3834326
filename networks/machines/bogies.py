"""A railway bogie in the vertical: a frame that bounces and pitches between two wheelsets and a car body."""

from __future__ import annotations

from ...base import above, demand
from ...components import Component, Mass, Position, Spring, SpringDamper
from ..given import element_of
from ..network import Network
from .vehicles import PitchingBody


def bogie(
    primary: Component | None = None,
    secondary: Component | None = None,
    *,
    m_c: float = 15e3,
    m: float = 2.5e3,
    J: float = 2.0e3,
    l: float = 1.25,  # noqa: E741
    m_w: float = 1.2e3,
    k_r: float = 1e9,
) -> Network:
    """Return half a coach on a bogie: `front_rail`, `front_contact`, `front_wheelset`, `front`, ..., `body`.

    Both rails move as prescribed, `front_rail.s_ref` and `rear_rail.s_ref`. Over a sine of wavelength
    2 l/(n + 1/2) the axles move oppositely, and the frame pitches without bouncing; of 2 l/n it bounces
    without pitching.

    Args:
        primary: suspension of a wheelset, its flange_a below; 1.2 MN/m and 10 kN.s/m if None.
        secondary: suspension of the car body; 0.6 MN/m and 20 kN.s/m if None.
        m_c: mass of the car body on this bogie [kg].
        m: mass of the frame [kg].
        J: its moment of inertia in pitch [kg.m2].
        l: from its middle to each axle, half the wheelbase [m].
        m_w: mass of a wheelset [kg].
        k_r: stiffness of the contact of its wheels with the rails [N/m].
    """
    demand("bogie()", l=(l, above(0, "m")))
    link = element_of(SpringDamper(k=1.2e6, d=10e3) if primary is None else primary)
    train = Network(
        "bogie",
        frame=PitchingBody(m=m, J=J, l_f=l, l_r=l),
        secondary=SpringDamper(k=0.6e6, d=20e3) if secondary is None else element_of(secondary),
        body=Mass(m=m_c),
    )
    for axle in ("front", "rear"):
        rail, contact, wheelset, strut = Position(s_ref=0.0), Spring(k=k_r), Mass(m=m_w), link.clone()
        train.add(
            **{f"{axle}_rail": rail, f"{axle}_contact": contact, f"{axle}_wheelset": wheelset, axle: strut}
        )
        train.connect(rail.flange, contact.flange_a)
        train.connect(contact.flange_b, wheelset.flange, strut.flange_a)
        train.connect(strut.flange_b, getattr(train.frame, axle))
    train.connect(train.frame.centre, train.secondary.flange_a)
    return train.connect(train.secondary.flange_b, train.body.flange)
