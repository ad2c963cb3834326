"""`python -m inertance`: the command line."""

from inertance.cli import app

app(prog_name="python -m inertance")
