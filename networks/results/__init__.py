"""What a run leaves: signals by name, averages over time, plots, tables, files."""
