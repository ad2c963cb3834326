"""What a model may be missing, and where it may be missing."""
