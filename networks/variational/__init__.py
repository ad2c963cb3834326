"""How a run answers to small changes, over its events too."""
