"""The command line: `inertance`."""

from .app import app as app
