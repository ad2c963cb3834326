"""What MkDocs does not find below docs/: pages from elsewhere in the tree, the reference, source files.

MkDocs calls `on_config` and `on_files` before it reads pages, the others with each; see mkdocs.yml.
"""

from __future__ import annotations

import logging
import re
from pathlib import Path, PurePosixPath
from posixpath import normpath, relpath

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page
from site_reference import reference_pages

ROOT = Path(__file__).parents[1]
ELSEWHERE = {
    "README.md": "index.md",
    "CHANGELOG.md": "changes.md",
    "CONTRIBUTING.md": "contributing.md",
    "benchmarks/README.md": "benchmarks.md",
    "benchmarks/blind/README.md": "blind-benchmark.md",
    "examples/README.md": "examples.md",
}
ASKED = re.compile(r'<(?:script|img|iframe)[^>]*src="?http|<link[^>]*stylesheet[^>]*href="?http')
LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\((?!\w+:|#)([^)#\s]+)(#[^)\s]*)?\)")
TITLE = re.compile(r"^# .+\n", re.MULTILINE)
TIMED = re.compile(r"^\| \[.*?\]\((\S+\.md)\) \|.*\| (\d+) \|$", re.MULTILINE)
log = logging.getLogger("mkdocs.hooks.site")
_reference: dict[str, str] = {}
_origin: dict[str, str] = {}  # page -> file of the tree, where that is elsewhere
_seconds: dict[str, str] = {}


def on_config(config: MkDocsConfig) -> None:
    """Put the pages of the reference where the navigation has `Reference`."""
    _reference.update(reference_pages())
    for entry in config.nav or ():
        if "Reference" in entry:
            entry["Reference"] = list(_reference)


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add the pages that stand elsewhere, the reference, and the files to which pages link."""
    for file, page in ELSEWHERE.items():
        if (ROOT / file).exists():
            files.append(File.generated(config, page, abs_src_path=str(ROOT / file)))
            _origin[page] = file
    for page, text in _reference.items():
        files.append(File.generated(config, page, content=text))
    for file in {target for page in files.documentation_pages() for target in _sources(page)}:
        files.append(File.generated(config, _copy(file), content=(ROOT / file).read_bytes()))
    _seconds.update(TIMED.findall((ROOT / "docs" / "tutorials.md").read_text(encoding="utf-8")))
    return files


def on_page_markdown(markdown: str, page: Page, config: MkDocsConfig, files: Files) -> str:
    """Let links lead to where files stand in the site, and tell what the lines of a page took."""
    uri = page.file.src_uri
    linked = LINK.sub(lambda link: _link(link, uri, files), markdown)
    if uri not in _seconds:
        return linked
    told = f'\n!!! info "The Python lines of this page ran in {_seconds[uri]} s; every test runs them."\n'
    return TITLE.sub(lambda title: title[0] + told, linked, count=1)


def on_post_page(output: str, page: Page, config: MkDocsConfig) -> str:
    """Warn of a page that a browser could not show without a network."""
    if asked := ASKED.search(output):
        log.warning("%s asks another host: %s", page.file.src_uri, asked[0])
    return output


def _from(page: str) -> PurePosixPath:
    """Return the folder of the tree in which the text of a page stands."""
    return PurePosixPath(_origin.get(page, f"docs/{page}")).parent


def _target(page: str, link: str) -> str:
    """Return the file of the tree to which a page links."""
    return normpath(str(_from(page) / link))


def _sources(page: File) -> set[str]:
    """Return the files of the tree to which a page links and which are no pages."""
    text = page.content_string
    targets = {_target(page.src_uri, link[3]) for link in LINK.finditer(text)}
    return {t for t in targets if _in_site(t) is None and (ROOT / t).is_file()}


def _in_site(target: str) -> str | None:
    """Return under which name a file of the tree, or what stands for a folder, is a page or picture."""
    if target in ELSEWHERE or f"{target}/README.md" in ELSEWHERE:
        return ELSEWHERE.get(target) or ELSEWHERE[f"{target}/README.md"]
    inside = target.removeprefix("docs/")
    return inside if inside != target and not inside.endswith(".py") else None


def _copy(file: str) -> str:
    return f"source/{file}.txt"  # so that a browser shows it


def _link(link: re.Match[str], page: str, files: Files) -> str:
    mark, text, target, anchor = link[1], link[2], _target(page, link[3]), link[4] or ""
    if page.startswith("reference/"):
        return link[0]
    place = _in_site(target) or _copy(target)
    if files.get_file_from_path(place) is None:
        if not (ROOT / target).is_dir():
            log.warning("%s: '%s' leads nowhere", page, link[3])
        return text
    return f"{mark}[{text}]({relpath(place, PurePosixPath(page).parent)}{anchor})"
