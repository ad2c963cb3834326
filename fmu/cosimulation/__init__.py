"""FMUs beside each other and inside networks, exchanging at communication points."""
