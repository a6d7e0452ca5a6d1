#!/usr/bin/env python3
"""Write design.json, meshes included, of a standard involute pair: an oracle for the checks.

Play on either side is 2 * thinning / follower radius / 2; --extra moves the axes apart,
--missing removes driver teeth.
"""

import argparse
import json
import math
import pathlib

import numpy as np


def spur(teeth, module, thinning, start, present=None, alpha=math.radians(20), points=40):
    radius = 0.5 * module * teeth
    base, tip, root = radius * math.cos(alpha), radius + module, radius - 1.25 * module
    inv = lambda a: math.tan(a) - a
    half = (0.5 * math.pi * module - thinning) / (2 * radius) + inv(alpha)
    roll = lambda r: math.tan(math.acos(min(1.0, base / r)))
    flank = [(root, half)]
    for t in np.linspace(roll(max(base, root)), roll(tip), points):
        flank.append((base * math.hypot(t, 1), half - inv(math.atan(t))))
    out = []
    for tooth in range(teeth):
        center = start + 2 * math.pi * tooth / teeth
        if present is None or tooth < present:
            polar = [(r, center - a) for r, a in flank] + [(r, center + a) for r, a in flank[::-1]]
        else:
            polar = [(root, center - half), (root, center + half)]
        out += [[r * math.cos(a), r * math.sin(a)] for r, a in polar]
    return out


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--teeth", type=int, nargs=2, default=(30, 40))
    parser.add_argument("--module", type=float, default=2.0)
    parser.add_argument("--thinning", type=float, default=0.06)
    parser.add_argument("--extra", type=float, default=0.0)
    parser.add_argument("--missing", type=int, default=0)
    parser.add_argument("--meshes", action="store_true", help="write the solids as well")
    o = parser.parse_args()
    z1, z2 = o.teeth
    turns = z2 // math.gcd(z1, z2)
    phi = np.linspace(0, 2 * math.pi * turns, 1025)
    gears = [spur(z1, o.module, o.thinning, 0, z1 - o.missing),
             spur(z2, o.module, o.thinning, math.pi + math.pi / z2)]
    bore = [[2.5 * math.cos(a), 2.5 * math.sin(a)] for a in np.linspace(0, 2 * math.pi, 65)[:-1]]
    distance = 0.5 * o.module * (z1 + z2) + o.extra
    design = {
        "centrode": "oracle", "units": "mm", "ratio": z2 / z1, "center_distance": distance,
        "module": o.module,
        "driver": {"teeth": z1, "outline": gears[0], "bore": bore},
        "follower": {"teeth": z2, "outline": gears[1], "bore": bore},
        "motion": {"driver_angle": phi.tolist(), "follower_angle": (phi * z1 / z2).tolist()},
        "settings": {"thickness": 6.0},
    }
    o.folder.mkdir(parents=True, exist_ok=True)
    (o.folder / "design.json").write_text(json.dumps(design))
    if o.meshes:
        write_meshes(o.folder, gears, bore, distance)


def write_meshes(folder, gears, bore, distance):
    import shapely
    import trimesh
    solids = [trimesh.creation.extrude_polygon(shapely.Polygon(g, [bore]), 6.0) for g in gears]
    for name, solid in zip(("driver", "follower"), solids):
        solid.export(folder / f"{name}.stl")
    solids[1].apply_translation((distance, 0, 0))
    scene = trimesh.Scene(dict(zip(("driver", "follower"), solids)))
    scene.export(folder / "pair.glb")
    scene.export(folder / "pair.obj")


if __name__ == "__main__":
    main()
