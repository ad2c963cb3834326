"""The report of a verdict."""
