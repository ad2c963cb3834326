"""What a network does near an operating point, at large amplitudes and on a road; designs tuned for it."""

from .networks.analysis import *
