"""Ready-made inerters, absorbers, dampers, suspensions, vehicles, frames, and a rig to test them."""

from .networks.machines import *
