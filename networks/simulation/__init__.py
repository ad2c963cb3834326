"""Runs: start values, integrators, legs of what is given, events on the way."""
