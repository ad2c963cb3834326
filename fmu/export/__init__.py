"""A network as an FMU."""
