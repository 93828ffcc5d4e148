# SPDX-License-Identifier: Apache-2.0
"""A fair: stands in rows, and visitors each of whom goes to places of its own."""

import random

STAND = (3.0, 2.0)  # m
AISLE = 3.0  # m
COLUMNS = 12
CLEAR = 0.5  # m, from where people stand or go to the stands and the hall
STEP = 0.8  # m, between places


def corners(stands):
    """The lower left corner of each stand."""
    return [
        (AISLE + i % COLUMNS * (STAND[0] + AISLE), AISLE + i // COLUMNS * (STAND[1] + AISLE)) for i in range(stands)
    ]


def free_places(width, height, stands):
    def is_free(x, y):
        return not any(
            left - CLEAR < x < left + STAND[0] + CLEAR and low - CLEAR < y < low + STAND[1] + CLEAR
            for left, low in corners(stands)
        )

    across, up = (int((length - 2 * STEP) / STEP) + 1 for length in (width, height))
    every = [(round(STEP * (i + 1), 2), round(STEP * (j + 1), 2)) for i in range(across) for j in range(up)]
    return [place for place in every if is_free(*place)]


def layout(people=1025, stands=118, visits=2, seconds=60):
    """Walls of 4 segments a stand and 6 of the hall: 478 as it stands."""
    draw = random.Random(1)
    rows = -(-stands // COLUMNS)
    width, height = COLUMNS * (STAND[0] + AISLE) + AISLE, rows * (STAND[1] + AISLE) + AISLE
    hall = [(0, 0), (width / 2, 0), (width, 0), (width, height), (width / 2, height), (0, height), (0, 0)]
    walls = [{"id": "hall", "points": hall}] + [
        {
            "id": f"stand {number}",
            "closed": True,
            "points": [(x, y), (x + STAND[0], y), (x + STAND[0], y + STAND[1]), (x, y + STAND[1])],
        }
        for number, (x, y) in enumerate(corners(stands), 1)
    ]
    places = free_places(width, height, stands)
    agents = [
        {
            "position": start,
            "via": [{"point": draw.choice(places), "wait": 3} for _ in range(visits)],
            "goal": draw.choice(places),
        }
        for start in draw.sample(places, people)
    ]
    return {
        "throng": 1,
        "name": "fair",
        "simulation": {"duration": seconds},
        "walls": walls,
        "formations": [{"id": "visitors", "type": "agents", "agents": agents}],
    }
