"""Write assets/description.md, what a package index shows: README without what leads into the tree.

python docs/make_description.py            writes it
python docs/make_description.py --check    tells whether it is old

An index shows no picture and follows no link by a path of the tree: pictures go with their captions, such
links become plain text, and what installs from the tree installs from the index.
"""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
DESCRIPTION = ROOT / "docs" / "assets" / "description.md"
PICTURE = re.compile(r"!\[[^\]]*\]\((?!https?:)[^)]*\)\n\n(\*[^*]+\*\n\n)?")
LINK = re.compile(r"\[([^\]]+)\]\((?!https?:|#)[^)]*\)")
COMMENT = re.compile(r"<!--.*?-->\n")
TEST = re.compile(r"Test it:\n\n```sh\n.*?```\n\n", re.DOTALL)
END = """
The pages that are named here come with the package: `inertance docs` opens them.
"""


def description(readme: str) -> str:
    """Return what an index can show of README."""
    text = COMMENT.sub("", PICTURE.sub("", readme))
    text = LINK.sub(r"\1", TEST.sub("", text))
    for here, there in (("install .", "install inertance"), ('install ".[', 'install "inertance[')):
        text = text.replace(here, there)
    return text + END


def main() -> int:
    """Write the description, or tell whether it is old."""
    wanted = description((ROOT / "README.md").read_text("utf-8"))
    old = not DESCRIPTION.exists() or DESCRIPTION.read_text("utf-8") != wanted
    if "--check" in sys.argv:
        return int(old)
    DESCRIPTION.write_text(wanted, "utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
