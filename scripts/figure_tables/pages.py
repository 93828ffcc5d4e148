# SPDX-License-Identifier: Apache-2.0
"""Where tables stand in the docs: between <!-- figures: NAME --> and <!-- /figures -->."""

import re
import textwrap

COLUMNS = 120


def place_of(name, text):
    """What stands between the markers: where it begins and ends. Raises ValueError where they are not there once."""
    found = list(re.finditer(rf"<!-- figures: {re.escape(name)} -->\n(.*?)<!-- /figures -->", text, re.DOTALL))
    if len(found) != 1:
        raise ValueError(f"the markers of {name} are there {len(found)} times, not once")
    return found[0].span(1)


def put(page, name, body):
    text = page.read_text()
    begin, end = place_of(name, text)
    page.write_text(f"{text[:begin]}\n{body.strip()}\n\n{text[end:]}")


def table(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(str(cell) for cell in line) + " |" for line in lines)


def paragraph(text):
    return "\n".join(textwrap.wrap(" ".join(text.split()), COLUMNS, break_long_words=False, break_on_hyphens=False))


def number(value, digits=3):
    """Without noise behind the point: 0.000, 0.00002, 12.3."""
    if value and abs(value) < 10.0**-digits:
        return f"{value:.1g}" if abs(value) >= 1e-4 else f"{value:.6f}".rstrip("0")
    return f"{value:.{digits}f}"


def span_of(values, digits=1):
    """`1.2` or `1.2 to 1.5`."""
    least, most = f"{min(values):.{digits}f}", f"{max(values):.{digits}f}"
    return least if least == most else f"{least} to {most}"
