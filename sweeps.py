"""Many designs, a measure of a network at each in many processes, and the indices of its variance."""

from .networks.sweeps import *
