"""The next experiment: what a rig may be asked, what would be seen, and what that would tell."""
