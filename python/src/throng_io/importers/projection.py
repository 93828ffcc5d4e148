# SPDX-License-Identifier: Apache-2.0
"""Degrees as metres about a local origin."""
from __future__ import annotations

import numpy

from ..base.errors import ImportFailed, need
from .report import Report

WIDEST = 2.0  # degrees; what is wider is no scene


def to_metres(points: numpy.ndarray, report: Report) -> numpy.ndarray:
    """Longitudes and latitudes, projected by a transverse Mercator of their middle."""
    pyproj = need("pyproj", "import")
    low, high = points.min(axis=0), points.max(axis=0)
    if not numpy.isfinite(points).all() or abs(points[:, 0]).max() > 180 or abs(points[:, 1]).max() > 90:
        raise ImportFailed("expected longitudes from -180 to 180 and latitudes from -90 to 90", report.source)
    if (high - low).max() > WIDEST:
        raise ImportFailed(f"wider than {WIDEST:g} degrees", report.source, hint="cut out the part that you need")
    longitude, latitude = 0.5 * (low + high)
    local = pyproj.CRS.from_proj4(f"+proj=tmerc +lat_0={latitude:.7f} +lon_0={longitude:.7f} +k=1 +ellps=WGS84 "
                                  "+units=m +no_defs")
    change = pyproj.Transformer.from_crs("EPSG:4326", local, always_xy=True)
    report.altered("coordinates", f"metres from longitude {longitude:.7f}, latitude {latitude:.7f}")
    return numpy.column_stack(change.transform(points[:, 0], points[:, 1]))


def between(points: numpy.ndarray, crs: str, report: Report) -> numpy.ndarray:
    """Of a named system of coordinates, first as degrees and then as metres."""
    pyproj = need("pyproj", "import")
    try:
        change = pyproj.Transformer.from_crs(crs, "EPSG:4326", always_xy=True)
    except pyproj.exceptions.CRSError as error:
        raise ImportFailed(f"coordinates of the system {crs!r}, which is not known", report.source) from error
    return to_metres(numpy.column_stack(change.transform(points[:, 0], points[:, 1])), report)
