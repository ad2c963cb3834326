"""What was measured: tables, units, channels, filters, noise."""
