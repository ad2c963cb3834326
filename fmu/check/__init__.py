"""FMUs held against their network, against the standard and against themselves."""
