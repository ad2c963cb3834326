"""Events: watched, located, landed on, and what they change."""
