"""The table and the sheet of examples that validation/random_silhouettes writes into the docs."""

import collections
import json

import numpy as np
import shapely

FINE = 0.1  # mm, what a picture of 80 mm may leave out


def picture(path):
    """The outlines and drawings of a design, coarse enough to keep: driver, follower."""
    with open(path, encoding="utf-8") as file:
        design = json.load(file)
    thin = lambda points: np.round(np.asarray(shapely.Polygon(points).simplify(FINE).exterior.coords)[:-1], 2).tolist()
    gears = [{"outline": thin(design[name]["outline"]), "input": thin(design[name]["input"])}
             for name in ("driver", "follower")]
    return {"distance": design["center_distance"], "gears": gears}
