"""A measure of a network at many points, in many processes, resumable."""
