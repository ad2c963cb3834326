"""Runs of one model side by side in lanes: what is asked of them, and what comes of it."""
