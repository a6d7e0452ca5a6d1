"""Gears under version control: a pull request fails when a pair stops meshing.

Copy this file beside your gears, and edit the table. Run: pytest test_gears_mesh.py
"""

from __future__ import annotations

from pathlib import Path

import pytest

import centrode

GEARS = Path(__file__).parents[2] / "tests" / "data"

# driver, follower, and what is known of the pair: distance of the axes in mm, turns of the driver for one of the follower
PAIRS = [
    ("involute_24_driver.csv", "involute_48_follower.csv", {"center_distance": 72.0, "ratio": 2}),
    ("involute_24_driver.csv", "involute_48_follower.csv", {"center_distance": 72.1}),
]

# The project's own limits; what is left out keeps its default (docs/python.md lists them).
LIMITS = {"transmission_error": 0.05, "overlap": 0.01}


@pytest.mark.parametrize(("driver", "follower", "facts"), PAIRS)
def test_pair_meshes(driver: str, follower: str, facts: dict[str, float]) -> None:
    report = centrode.check(GEARS / driver, GEARS / follower, limits=LIMITS, **facts)
    assert report, str(report)
