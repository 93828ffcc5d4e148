#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws diagrams.png and proximity.png from what `throng bench` has written.

Usage: plot_benchmarks.py FOLDER   (needs matplotlib)

FOLDER holds diagrams.csv, proximity.csv or both; the plots lie beside them.
"""

import csv
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

# One colour for each family of methods; its members differ by their dashes.
STYLES = {
    "binned": ("#1b6ca8", "-"),
    "per-site": ("#1b6ca8", "--"),
    "per-pixel": ("#1b6ca8", ":"),
    "gradient1": ("#c2571a", "-"),
    "gradient2": ("#c2571a", "--"),
    "gradient2-packed": ("#c2571a", ":"),
    "cones, 16 sides": ("#7a3e9d", "-"),
    "jfa": ("#3b7d3b", "-"),
    "1+jfa": ("#3b7d3b", "--"),
    "jfa+1": ("#3b7d3b", ":"),
    "jfa-r": ("#3b7d3b", "-."),
    "voronoi": ("#1b6ca8", "-"),
    "grid": ("#c2571a", "-"),
    "brute": ("#666666", "-"),
}
AUTO = "auto"
DRAWING_ALONE = "gradient1, drawing alone"  # the yardstick of the table: beside gradient1 it would only hide it


def rows_of(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def series(rows, name, x, y, named):
    points = sorted((float(row[x]), float(row[y])) for row in rows if row[named] == name)
    return [at for at, _ in points], [value for _, value in points]


def axes_of(axes, title, along, ticks):
    """@param ticks {count: what stands below it}"""
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_title(title, loc="left", fontsize=10, fontweight="bold")
    axes.set_xlabel(along)
    axes.set_ylabel("ms, median")
    axes.set_xticks(list(ticks), list(ticks.values()))
    axes.minorticks_off()
    axes.yaxis.set_major_formatter(lambda value, _: f"{value:,g}")
    axes.grid(True, color="#dddddd", linewidth=0.6)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def diagrams(folder):
    rows = [row for row in rows_of(folder / "diagrams.csv") if row["source"] == "measured"]
    names = [name for name in dict.fromkeys(row["method"] for row in rows) if name != DRAWING_ALONE]
    radii = {int(row["sites"]): row["radius_px"] for row in rows}
    ticks = {sites: f"{sites:,}\nr {radius} px" for sites, radius in sorted(radii.items())}
    figure, axes = plt.subplots(figsize=(9, 5.5), layout="constrained")
    axes_of(axes, "Building a diagram of 1,024 x 1,024 pixels", "sites, and the radius of their tiles", ticks)
    for name in names:
        x, y = series(rows, name, "sites", "median_ms", "method")
        if name == AUTO:
            axes.plot(x, y, "o", color="black", markersize=8, markerfacecolor="none", label=AUTO, zorder=3)
        else:
            colour, dashes = STYLES.get(name, ("#999999", "-"))
            axes.plot(x, y, dashes, color=colour, marker=".", linewidth=1.6, label=name)
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False, fontsize=9)
    figure.savefig(folder / "diagrams.png", dpi=110)
    plt.close(figure)


def proximity(folder):
    rows = rows_of(folder / "proximity.csv")
    ticks = {people: f"{people:,}" for people in sorted({int(row["people"]) for row in rows})}
    figure, pair = plt.subplots(1, 2, figsize=(10, 4.2), sharey=True, layout="constrained")
    for axes, title, column in zip(pair, ("Finding neighbours", "The whole step"), ("search_ms", "step_ms")):
        axes_of(axes, title, "people", ticks)
        for name in dict.fromkeys(row["way"] for row in rows):
            x, y = series(rows, name, "people", column, "way")
            axes.plot(x, y, STYLES[name][1], color=STYLES[name][0], marker=".", linewidth=1.6, label=name)
    pair[1].set_ylabel("")
    pair[0].legend(frameon=False)
    figure.savefig(folder / "proximity.png", dpi=110)
    plt.close(figure)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    drawers = {"diagrams.csv": diagrams, "proximity.csv": proximity}
    there = [draw for name, draw in drawers.items() if (folder / name).exists()]
    if not there:
        sys.exit(f"{folder} has neither diagrams.csv nor proximity.csv")
    for draw in there:
        draw(folder)


if __name__ == "__main__":
    main()
