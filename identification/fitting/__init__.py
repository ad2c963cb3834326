"""Uncertain parameters fitted to records, and how well they are known then."""
