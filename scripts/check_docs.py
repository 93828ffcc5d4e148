#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What the site's generator does not look at: pages fetch nothing from elsewhere, lines end at 120
columns, the README's links lead somewhere.

Usage: check_docs.py SITE
"""

import html.parser
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
COLUMNS = 120
MADE = {"docs/layout.md"}  # from the schema, whose descriptions are lines of their own
ELSEWHERE = re.compile(r"^\s*(https?:)?//", re.IGNORECASE)
FETCHING = {
    "script": "src",
    "img": "src",
    "iframe": "src",
    "source": "src",
    "video": "src",
    "audio": "src",
    "embed": "src",
    "object": "data",
    "link": "href",
}
STYLE = re.compile(r"""(?:url\(\s*|@import\s+)['"]?((?:https?:)?//[^'")\s]+)""", re.IGNORECASE)


class Fetched(html.parser.HTMLParser):
    """Addresses that a browser would ask for when it shows the page. A canonical link is only a name."""

    def __init__(self):
        super().__init__()
        self.addresses, self.in_style = [], False

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        self.in_style = tag == "style"
        if tag == "link" and found.get("rel") in ("canonical", "next", "prev", "edit"):
            return
        self.addresses += [found.get(FETCHING.get(tag, ""), "") or ""] + (found.get("srcset") or "").split()
        self.addresses += STYLE.findall(found.get("style") or "")
        if "mermaid" in (found.get("class") or "").split():  # the theme would fetch its drawing program
            self.addresses.append("//mermaid")

    def handle_data(self, data):
        if self.in_style:
            self.addresses += STYLE.findall(data)
            self.in_style = False


def fetched_by(path):
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".css":
        return STYLE.findall(text)
    page = Fetched()
    page.feed(text)
    return [address for address in page.addresses if ELSEWHERE.match(address)]


def anchor_of(heading):
    """As forges make them."""
    words = re.sub(r"[`*_]|\]\([^)]*\)|\[", "", heading).strip().lower()
    return re.sub(r"[^\w\- ]", "", words).replace(" ", "-")


def broken_links(path):
    """Links of a page that is not in the site."""
    for target in re.findall(r"\]\(([^)\s]+)\)", path.read_text()):
        if re.match(r"\w+:", target):
            continue
        file, _, anchor = target.partition("#")
        there = path.parent / file if file else path
        if not there.exists():
            yield target
        elif anchor and anchor not in [
            anchor_of(line.lstrip("#")) for line in there.read_text().splitlines() if line.startswith("#")
        ]:
            yield target


def long_lines(path):
    """Tables, and words that nothing can wrap, may be longer."""
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if (
            len(line) > COLUMNS
            and not line.startswith("|")
            and " " in line[:COLUMNS].strip()
            and not line.startswith(("![", "<"))
        ):
            yield number


def main(site):
    wrong = [
        f"{path.relative_to(site)} fetches {address}"
        for path in sorted(site.rglob("*"))
        if path.suffix in (".html", ".css")
        for address in fetched_by(path)
    ]
    if not any(site.rglob("*.html")):
        wrong.append(f"{site} has no pages")
    wrong += [
        f"{name}: {target} leads nowhere"
        for name in ("README.md", "CHANGELOG.md")
        for target in broken_links(ROOT / name)
    ]
    pages = [ROOT / "README.md"] + sorted((ROOT / "docs").rglob("*.md"))
    wrong += [
        f"{path.relative_to(ROOT)}:{number}: more than {COLUMNS} columns"
        for path in pages
        if str(path.relative_to(ROOT)) not in MADE
        for number in long_lines(path)
    ]
    if wrong:
        sys.exit("\n".join(wrong))


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
