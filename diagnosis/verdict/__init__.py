"""From fitted models to what is said of the gap."""
