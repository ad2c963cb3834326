"""What was measured on which machine, and what is uncertain about its model."""
