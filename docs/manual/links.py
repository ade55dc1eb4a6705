"""Links of a built site: each leads to a file and an anchor of it, and nothing is loaded from another host."""

from __future__ import annotations

from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class _Names(HTMLParser):
    """Anchors of a page, what it links to, what it loads."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.anchors: set[str] = set()
        self.links: list[str] = []
        self.loaded: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = {name: value or "" for name, value in attrs}
        self.anchors |= {given[name] for name in ("id", "name") if name in given}
        if "href" in given:
            canonical = tag == "link" and given.get("rel") in ("canonical", "prev", "next")
            (self.links if tag == "a" or canonical else self.loaded).append(given["href"])
        if "src" in given:
            self.loaded.append(given["src"])


def broken(site: Path) -> list[str]:
    """What is wrong with the links of a site, one line each; none: nothing.

    Parameters
        site : Path - the folder with index.html
    """

    @cache
    def names(path: Path) -> _Names:
        return _Names(path.read_text(encoding="utf-8"))

    wrong = []
    for page in sorted(site.rglob("*.html")):
        if page.name == "404.html":  # its links are those of a server
            continue
        found = names(page)
        own = page.relative_to(site)
        for target in found.loaded:
            if urlsplit(target).scheme in ("http", "https") or target.startswith("//"):
                wrong.append(f"{own} loads {target} from another host")
        for target in [*found.links, *found.loaded]:
            parts = urlsplit(target)
            if parts.scheme or target.startswith("//"):
                continue
            path = (page.parent / unquote(parts.path)).resolve() if parts.path else page
            path = path / "index.html" if path.is_dir() else path
            if not path.is_file():
                wrong.append(f"{own}: {target} is not there")
            elif parts.fragment and path.suffix == ".html" and unquote(parts.fragment) not in names(path).anchors:
                wrong.append(f"{own}: {target} has no such anchor")
    return wrong
