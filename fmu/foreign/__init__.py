"""FMUs of any tool: read, checked, loaded, run."""
