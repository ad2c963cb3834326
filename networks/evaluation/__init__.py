"""Equations as compiled functions, called on NumPy arrays, at many points at once."""
