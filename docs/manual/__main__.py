"""Builds the manual into `build/manual/site`: `python -m docs.manual [--last] [--pages] [--refresh]`.

--last     results that are kept are taken although the program has changed since (`make site`)
--pages    write the pages alone, without the site
--refresh  put what the program prints now into the console blocks of README and docs
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

from docs.manual import blocks, reference, runs
from docs.manual.blocks import Page
from docs.manual.links import broken
from docs.manual.runs import ROOT

BUILT = ROOT / "build" / "manual"
PAGES, SITE = BUILT / "pages", BUILT / "site"
_ELSEWHERE = {
    "README.md": "index.md",
    "CONTRIBUTING.md": "contributing.md",
    "CHANGELOG.md": "changelog.md",
    ".github/SECURITY.md": "security.md",
}
"""Pages of the manual that are not in docs/."""
_SHIM = "https://unpkg.com/iframe-worker/shim"


def sources() -> dict[Path, str]:
    """The written pages, each with its file in the manual."""
    folder = ROOT / "docs"
    found = {path: str(path.relative_to(folder)) for path in sorted(folder.rglob("*.md"))}
    return {path: name for path, name in found.items() if "manual" not in name} | {
        ROOT / name: target for name, target in _ELSEWHERE.items()
    }


def write_pages(stale: bool) -> None:
    """Every page with its blocks filled, and the pictures and files that pages name."""
    shutil.rmtree(PAGES, ignore_errors=True)
    written = {path: path.read_text(encoding="utf-8") for path in sources()}
    wanted = [pair for text in written.values() for pair in blocks.commands(text)]
    wanted += reference.commands()
    done = runs.compute(wanted, stale)
    print(f"{len(done)} commands run, {sum(ended.seconds for ended in done):.0f} s")
    old = sum(runs.result(*pair).made_of != runs.program() for pair in dict.fromkeys(wanted))
    if old:
        print(f"{old} results are those of another state of the program: `make docs` renews them")
    for path, target in sources().items():
        _write(Page(path, target, written[path], stale))
    for target, text in reference.pages():
        _write(Page(ROOT / "docs" / target, target, text, stale))
    shutil.copytree(ROOT / "docs" / "manual" / "assets", PAGES / "assets")


def _write(page: Page) -> None:
    target = PAGES / page.target
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text(blocks.expanded(page, map_link), encoding="utf-8")
    for name in page.pictures:
        (PAGES / "pictures").mkdir(exist_ok=True)
        shutil.copyfile(runs.KEPT / name, PAGES / "pictures" / name)


def map_link(page: Page, target: str) -> str:
    """A link of a page of the repository, as it is in the manual; files beside the pages are copied.

    Raises
        ValueError - for a file that is not there
    """
    bare, hash_, anchor = target.partition("#")
    if not bare or "://" in target or target.startswith(("mailto:", "data:")) or "/pictures/" in target:
        return target
    path = (page.source.parent / bare).resolve()
    folder = ROOT / "docs"
    if path in (known := sources()):
        return page.up + known[path] + hash_ + anchor
    if not path.exists():
        if path.is_relative_to(folder):  # a generated page: the site says whether it is there
            return page.up + str(path.relative_to(folder)) + hash_ + anchor
        raise ValueError(f"{page.source}: {target} leads nowhere")
    if path.is_relative_to(ROOT / "designs") and path.suffix == ".yaml" and path.parent.name == "designs":
        return f"{page.up}gallery.md#{path.stem}"
    inside = path.relative_to(folder) if path.is_relative_to(folder) else path.relative_to(ROOT)
    if path.is_file():
        (PAGES / inside).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(path, PAGES / inside)
    return page.up + str(inside)


def build_site() -> None:
    """The site of the pages.

    Raises
        SystemExit - for a warning of the generator, a link that leads nowhere, a resource of another host
    """
    config = BUILT / "zensical.toml"
    text = (ROOT / "docs" / "manual" / "site.toml").read_text(encoding="utf-8")
    tomllib.loads(text)
    config.write_text(text, encoding="utf-8")
    shutil.rmtree(SITE, ignore_errors=True)
    command = [sys.executable, "-m", "zensical", "build", "--clean", "--strict", "--config-file", str(config)]
    ended = subprocess.run(command, cwd=BUILT, text=True, capture_output=True)
    if ended.returncode:
        told = re.sub(r"\x1b\[[0-9;]*m", "", ended.stdout + ended.stderr)
        sys.exit(told.partition("Traceback")[0])
    for path in SITE.rglob("*.html"):
        up = "../" * (len(path.relative_to(SITE).parts) - 1) or "./"
        html = path.read_text(encoding="utf-8")
        path.write_text(html.replace(_SHIM, f"{up}assets/worker.js"), encoding="utf-8")
    if wrong := broken(SITE):
        sys.exit("\n".join(wrong[:40]))


def refresh() -> None:
    """What README and docs say that commands print, as they print it now."""
    for path in sources():
        before = path.read_text(encoding="utf-8")
        after = blocks.refreshed(before)
        if after != before:
            path.write_text(after, encoding="utf-8")
            print(f"{path.relative_to(ROOT)}: output of commands renewed")


if __name__ == "__main__":
    if "--refresh" in sys.argv:
        refresh()
    write_pages("--last" in sys.argv)
    if "--pages" not in sys.argv:
        build_site()
        size = sum(path.stat().st_size for path in SITE.rglob("*") if path.is_file())
        print(f"{SITE}/index.html: {len(list(SITE.rglob('*.html')))} pages, {size / 1e6:.1f} MB")
