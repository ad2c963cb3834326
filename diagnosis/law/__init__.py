"""The law of what a model lacks: its force over time, what it depends on, and a component that has it."""
