"""Docstrings as griffe takes them: a section `Example:` holds lines of a Python session."""

import re
from typing import Any

import griffe


class Examples(griffe.Extension):
    """Calls the section of examples as griffe does."""

    def on_object(self, *, obj: griffe.Object, **_: Any) -> None:
        """Change the docstring of an object that was read."""
        if obj.docstring:
            obj.docstring.value = re.sub(r"^Example:$", "Examples:", obj.docstring.value, flags=re.MULTILINE)
