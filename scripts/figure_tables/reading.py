# SPDX-License-Identifier: Apache-2.0
"""What only the streams of a bake tell. Each takes a bake's folder and returns figures."""

import csv
import json

import numpy

MIDDLE = 15.0  # m: between rimea-11's doors
WEIDMANN = (1.34, 1.913, 5.4)  # m/s, 1/m^2, 1/m^2: free speed, gauge, density at standstill
STRETCH = (45.0, 65.0)  # m along rimea-4's corridors
HALF_STREET = 15.0  # m: half the width of the crossing's streets
CARRIED_OFF = 15.0  # m beyond them


def people_of(bake):
    with open(bake / "agents.csv", newline="") as file:
        return list(csv.DictReader(file))


def stream(bake, name):
    return numpy.load(bake / "streams" / f"{name}.npy", mmap_mode="r")


def further_door(bake):
    """How many of rimea-11 leave by the door that is further from where they began."""
    ways = stream(bake, "pos")[:, :, 0]
    return {"further": int(((ways[0] > MIDDLE) != (ways[-1] > MIDDLE)).sum())}


def own_exits(bake):
    """How many of rimea-10's cabins leave by their exits: the first eight to the west."""
    ends = stream(bake, "pos")[-1]
    cabins = [int(person["group"][-2:]) for person in people_of(bake)]
    return {"own_exit": sum(bool(end[0] < -3.0) == (cabin <= 8) for end, cabin in zip(ends, cabins))}


def company(bake):
    """How far members are from the middle of their group, and how long after the first the last arrives."""
    people, fps = people_of(bake), json.loads((bake / "bake.json").read_text())["fps"]
    position, there = stream(bake, "pos"), stream(bake, "state")[:, :, 0] > 0.5
    party = numpy.array([int(person["party"]) for person in people])
    arrival = numpy.array([float(person["arrival_frame"] or "nan") for person in people])
    away, late = [numpy.zeros(1)], [0.0]
    for first in numpy.unique(party):
        members = numpy.nonzero(party == first)[0]
        if len(members) < 2:
            continue
        places = position[there[:, members].all(axis=1)][:, members, :2]
        away.append(numpy.linalg.norm(places - places.mean(axis=1, keepdims=True), axis=2).max(axis=1))
        late.append(float(arrival[members].max() - arrival[members].min()) / fps)
    away = numpy.concatenate(away[1:] or away)
    return {"apart": float(numpy.median(away)), "furthest": float(away.max()), "late": float(numpy.nanmax(late))}


def carried_off(bake):
    """How far beyond their street the crossing's people get: from where their group stands to where it goes."""
    people, position = people_of(bake), stream(bake, "pos")
    goals = numpy.array([[float(person["goal_x"]), float(person["goal_y"])] for person in people])
    groups = numpy.array([person["group"] for person in people])
    off = numpy.zeros(len(people))
    for group in numpy.unique(groups):
        rows = numpy.nonzero(groups == group)[0]
        start = position[0][rows, :2].mean(axis=0)
        along = goals[rows].mean(axis=0) - start
        aside = numpy.array([-along[1], along[0]]) / numpy.hypot(*along)
        for frame in range(0, len(position), 15):
            off[rows] = numpy.maximum(off[rows], numpy.abs((position[frame][rows, :2] - start) @ aside))
    beyond = off - HALF_STREET
    return {"off": int((beyond > CARRIED_OFF).sum()), "furthest_off": float(beyond.max())}


def speed_and_density(bake):
    """Mean density and speed in a stretch of rimea-4's corridors, from the second second on; Weidmann's for it."""
    about = json.loads((bake / "bake.json").read_text())
    sides = [abs(point[1]) - wall["thickness"] / 2.0 for wall in about["geometry"]["walls"] for point in wall["points"]]
    place, speed = stream(bake, "pos"), stream(bake, "dir")
    there = stream(bake, "state")[:, :, 0] > 0.5
    begin = round(about["fps"])
    x = place[begin:, :, 0] + about["origin"][0]
    inside = there[begin:] & (x >= STRETCH[0]) & (x < STRETCH[1])
    density = float(inside.sum(axis=1).mean()) / ((STRETCH[1] - STRETCH[0]) * 2.0 * min(sides))
    free, gauge, jam = WEIDMANN
    usual = free * (1.0 - numpy.exp(-gauge * (1.0 / density - 1.0 / jam)))
    return {"density": density, "speed": float(speed[begin:, :, 2][inside].mean()), "usual": float(usual)}


# What is read besides whenever one of these is baked, so that no table bakes it again.
OF = {
    "company": company,
    "crossing": carried_off,
    "crossing-adults": carried_off,
    "rimea-10": own_exits,
    "rimea-11": further_door,
}
