# SPDX-License-Identifier: Apache-2.0
"""What is painted on faces: lips, brows, beards, red cheeks. Functions of the place on the base mesh, seen from ahead,
so one small picture fits everybody."""
import numpy

from . import levels, regions

LOW, HIGH = (-0.090, 0.590), (0.090, 0.860)  # m, to the left and up: the window of the picture
WIDE, TALL = 512, 768


def _grid():
    left = numpy.linspace(LOW[0], HIGH[0], WIDE)
    up = numpy.linspace(LOW[1], HIGH[1], TALL)
    left, up = numpy.meshgrid(left, up)
    places = numpy.zeros((WIDE * TALL, 5))
    places[:, 0], places[:, 1], places[:, 2] = 0.13, left.ravel(), up.ravel()
    places[:, 3], places[:, 4] = -1.0, 1.0
    return places


def _smooth(low, high, value):
    share = numpy.clip((value - low) / (high - low), 0.0, 1.0)
    return share * share * (3.0 - 2.0 * share)


def _drawn(bodies, values):
    """A value of the base mesh's vertices, as a picture from ahead."""
    triangles = levels.triangles_of(bodies, "body", levels.NEAR)
    base = bodies.vertices
    triangles = triangles[(values[triangles] > 0.0).any(axis=1) & (base[triangles][:, :, 0] > 0.09).all(axis=1)]
    picture = numpy.zeros((TALL, WIDE))
    scale = numpy.array([(WIDE - 1) / (HIGH[0] - LOW[0]), (TALL - 1) / (HIGH[1] - LOW[1])])
    for corners in triangles:
        (x0, y0), (x1, y1), (x2, y2) = spots = (base[corners][:, 1:] - LOW) * scale
        area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
        if area <= 1e-9:  # it looks away
            continue
        low = numpy.maximum(numpy.floor(spots.min(axis=0)).astype(int), 0)
        high = numpy.ceil(spots.max(axis=0)).astype(int) + 1
        x, y = numpy.meshgrid(numpy.arange(low[0], high[0]), numpy.arange(low[1], high[1]))
        first = ((x - x0) * (y2 - y0) - (x2 - x0) * (y - y0)) / area
        second = ((x1 - x0) * (y - y0) - (x - x0) * (y1 - y0)) / area
        inside = (first >= -0.02) & (second >= -0.02) & (first + second <= 1.02)
        value = (values[corners[0]] * (1.0 - first - second) + values[corners[1]] * first
                 + values[corners[2]] * second)
        part = picture[low[1]:high[1], low[0]:high[0]]
        fit = inside[:part.shape[0], :part.shape[1]]
        part[fit] = numpy.maximum(part[fit], value[:part.shape[0], :part.shape[1]][fit])
    return picture


def lips_of(bodies):
    """How much each vertex of the base mesh is of the lips: those that targets of theirs move."""
    values = numpy.zeros(len(bodies.vertices))
    for name in ("mouth/mouth-upperlip-volume-incr", "mouth/mouth-lowerlip-volume-incr"):
        found = bodies.target(name)
        if found:
            moved = numpy.linalg.norm(found[1], axis=1)
            values[found[0]] = numpy.maximum(values[found[0]], moved / moved.max())
    return values


def masks(bodies):
    """(TALL, WIDE, 3): brows and lash lines, beards, lips; and another: red cheeks, shade round the eyes, freckles."""
    draw, places = numpy.random.default_rng(7), _grid()
    left, up = numpy.abs(places[:, 1]), places[:, 2]
    strokes = 0.5 + 0.5 * numpy.sin((left * 1.6 - up * 1.2) * 900.0 + 3.0 * numpy.sin(left * 420.0))
    brows = _smooth(-0.0012, 0.0022, regions.brow(places)) * (0.65 + 0.35 * strokes)
    lid = 0.7290 + 0.0062 * numpy.sqrt(numpy.clip(1.0 - ((left - 0.0315) / 0.0165) ** 2, 0.0, 1.0))
    line = numpy.exp(-((up - lid) / 0.0011) ** 2) * (numpy.abs(left - 0.0315) < 0.0165) * 0.7
    speckles = draw.random(len(left))
    beard = _smooth(-0.010, 0.008, regions.beard(places)) * (0.55 + 0.45 * speckles)
    lips = _smooth(0.12, 0.50, _drawn(bodies, lips_of(bodies)).ravel())
    cheeks = (numpy.exp(-((left - 0.043) / 0.020) ** 2 - ((up - 0.697) / 0.019) ** 2)
              + 0.9 * numpy.exp(-(left / 0.018) ** 2 - ((up - 0.700) / 0.014) ** 2) + 0.6 * _smooth(0.066, 0.075, left))
    shade = (numpy.exp(-((left - 0.030) / 0.018) ** 2 - ((up - 0.7135) / 0.007) ** 2)
             + 0.7 * numpy.exp(-((left - 0.031) / 0.021) ** 2 - ((up - 0.741) / 0.005) ** 2)
             + 0.5 * numpy.exp(-((left - 0.014) / 0.004) ** 2 - ((up - 0.722) / 0.010) ** 2))
    first = numpy.stack([numpy.maximum(brows, line), beard, lips], axis=1)
    second = numpy.stack([cheeks, shade, speckles], axis=1)
    return [numpy.clip(each, 0.0, 1.0).reshape(TALL, WIDE, 3) for each in (first, second)]
