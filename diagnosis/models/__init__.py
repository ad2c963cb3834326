"""What predicts the outputs of a campaign: networks by their equations, FMUs by their runs."""
