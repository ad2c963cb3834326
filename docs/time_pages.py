"""Run the Python lines of the pages that tutorials.md lists, and write there how many seconds each page took.

python docs/time_pages.py [PAGE.md ...]
"""

import re
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

FOLDER = Path(__file__).parent
LIST = FOLDER / "tutorials.md"
ROW = re.compile(r"^(\| \[.*?\]\((\S+?\.md)\) \|.*\|) [\d.]* ?\|$", re.MULTILINE)
LINES = re.compile(r"^```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def seconds(page: str) -> str:
    """Return how long the lines of a page take, in a process of their own, the start of Python included."""
    code = "\n".join(LINES.findall((FOLDER / page).read_text(encoding="utf-8")))
    with TemporaryDirectory() as folder:
        Path(folder, "page.py").write_text(code, encoding="utf-8")
        begin = perf_counter()
        command = [sys.executable, "-c", "import matplotlib; matplotlib.use('Agg'); import page"]
        subprocess.run(command, cwd=folder, check=True, stdout=subprocess.DEVNULL)
        return f"{perf_counter() - begin:.0f}"


def timed(row: re.Match[str]) -> str:
    """Return a row with what its page takes, if that is wanted."""
    wanted = sys.argv[1:] or [row[2]]
    if row[2] not in wanted:
        return row[0]
    told = f"{row[1]} {seconds(row[2])} |"
    print(told, flush=True)
    return told


if __name__ == "__main__":
    LIST.write_text(ROW.sub(timed, LIST.read_text(encoding="utf-8")), encoding="utf-8")
