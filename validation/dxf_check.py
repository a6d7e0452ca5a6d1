#!/usr/bin/env python3
"""Read pair.dxf, driver.dxf and follower.dxf back with ezdxf and judge them (pip install ezdxf shapely).

Audit without errors or fixes, millimetres, one closed path per contour on its layer; every vertex of the outline in
design.json within the tolerance of the arcs; every point of the arcs within 2.5 tolerances of the outline, besides
what the outline's own chords cut off (their bow, judged by how they turn). Vertices at which the outline folds
back on itself without width are left out: no file draws them.

Exit 0 when all holds, 1 when something does not, 2 when a folder cannot be used.
"""

import argparse
import json
import pathlib
import sys

import ezdxf
import numpy as np
import shapely
from ezdxf import units
from ezdxf.math import bulge_to_arc


def arcs_of(entity):
    """(start, end, bulge) of a closed polyline in either dialect."""
    if entity.dxftype() == "LWPOLYLINE":
        corners = [(x, y, b) for x, y, b in entity.get_points("xyb")]
    else:
        corners = [(v.dxf.location.x, v.dxf.location.y, v.dxf.bulge) for v in entity.vertices]
    return [
        (np.array(p[:2]), np.array(q[:2]), p[2]) for p, q in zip(corners, corners[1:] + corners[:1])
    ]


def points_on(start, end, bulge, count):
    """Points along an arc, ends included."""
    if bulge == 0:
        return start + np.linspace(0, 1, count)[:, None] * (end - start)
    center, first, last, radius = bulge_to_arc(start, end, bulge)
    if last < first:
        last += 2 * np.pi
    # ezdxf turns every arc counter-clockwise; a negative bulge runs it backwards.
    angle = np.linspace(first, last, count) if bulge > 0 else np.linspace(last, first, count)
    return np.array([center.x, center.y]) + radius * np.column_stack([np.cos(angle), np.sin(angle)])


def bows(ring):
    """How far a curve through the vertices may stand off each chord: twice the estimate at the middle."""
    edges = np.roll(ring, -1, 0) - ring
    length = np.hypot(*edges.T)
    before = np.roll(edges, 1, 0)
    cross = before[:, 0] * edges[:, 1] - before[:, 1] * edges[:, 0]
    turn = np.abs(np.arctan2(cross, (before * edges).sum(1)))
    bend = 2 * turn / (length + np.roll(length, 1))
    return 2 * np.maximum(bend, np.roll(bend, -1)) * length**2 / 8


def without_folds(ring, width):
    """The vertices that remain when folds narrower than `width` are cut off, tip by tip."""
    ring = list(map(tuple, ring))
    i, quiet = 0, 0
    while quiet < len(ring):
        n = len(ring)
        a, b, c = (np.array(ring[(i + k) % n]) for k in (-1, 0, 1))
        e, f = b - a, c - b
        near, far = (a, c) if np.hypot(*e) < np.hypot(*f) else (c, a)
        back = e @ f < np.cos(np.radians(149)) * np.hypot(*e) * np.hypot(*f)
        if back and shapely.LineString([b, far]).distance(shapely.Point(near)) < width:
            del ring[i % n]
            i, quiet = max(i - 2, 0), 0
        else:
            i, quiet = (i + 1) % n, quiet + 1
    return np.array(ring)


def judge(outline, arcs, tolerance, straight):
    """Greatest distances vertex to arcs, arcs to outline beyond the bow, arcs to outline."""
    fine = np.vstack([points_on(*arc, 65)[:-1] for arc in arcs])
    drawn = shapely.LinearRing(fine)
    outline = without_folds(outline, tolerance)
    bow = bows(outline)
    # Sampled arcs lie inside the arcs by up to their sagitta; it is far below the tolerance.
    vertices = shapely.distance(drawn, shapely.points(outline)).max()
    tree = shapely.STRtree(
        [shapely.LineString([a, b]) for a, b in zip(outline, np.roll(outline, -1, 0))]
    )
    places = shapely.points(fine)
    index, distance = tree.query_nearest(places, return_distance=True, all_matches=False)
    beyond = (distance - (0 if straight else bow[index[1]])).max()
    closed = shapely.Polygon(fine).is_valid
    return vertices, beyond, distance.max(), closed


def main(folder, tolerance):
    try:
        record = json.loads((folder / "design.json").read_text())
    except (OSError, ValueError) as error:
        print(f"cannot use {folder}: {error}", file=sys.stderr)
        return 2
    faults, said = [], []
    files = {"pair.dxf": ["driver", "follower"], "driver.dxf": ["driver"], "follower.dxf": ["follower"]}
    for file, gears in files.items():
        document = ezdxf.readfile(folder / file)
        audit = document.audit()
        if audit.errors or audit.fixes:
            faults.append(f"{file}: audit {[e.message for e in audit.errors + audit.fixes][:3]}")
        if document.dxfversion > "AC1009" and document.units != units.MM:
            faults.append(f"{file}: units {document.units}")
        space = document.modelspace()
        bores = 0
        for gear in gears:
            on_layer = [e for e in space if e.dxf.layer == gear]
            if len(on_layer) != 1 or not on_layer[0].is_closed:
                faults.append(f"{file}: {len(on_layer)} entities on layer {gear}, or open")
                continue
            arcs = arcs_of(on_layer[0])
            shift = (record["center_distance"] if gear == "follower" and len(gears) > 1 else 0.0, 0.0)
            outline = np.asarray(record[gear]["outline"]) + shift
            straight = all(arc[2] == 0 for arc in arcs)
            vertices, beyond, most, valid = judge(outline, arcs, tolerance, straight)
            if not vertices <= 1.1 * tolerance or not beyond <= 2.5 * tolerance or not valid:
                faults.append(f"{file} {gear}: {vertices:.5f} {beyond:.5f} mm off, simple {valid}")
            teeth = record[gear]["teeth"]
            said.append(
                f"{file} {gear} {len(arcs) / teeth:.1f} arcs a tooth,"
                f" vertices within {1000 * vertices:.2f} um, chords {1000 * most:.1f} um"
            )
            bores += record[gear]["bore"] is not None
        found = [e for e in space if e.dxf.layer == "bores"]
        if len(found) != bores or any(e.dxftype() != "CIRCLE" and not e.is_closed for e in found):
            faults.append(f"{file}: {len(found)} bores instead of {bores}")
        curves = [e for e in space if e.dxf.layer == "pitch-curves"]
        centres = [e for e in space if e.dxf.layer == "centres"]
        if len(curves) != len(gears) or len(centres) != len(gears):
            faults.append(f"{file}: {len(curves)} pitch curves, {len(centres)} centres")
    print(f"{folder.name}: " + "; ".join(said[:2]))
    for fault in faults:
        print(f"  FAULT {fault}")
    return 1 if faults else 0


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path, nargs="+")
    parser.add_argument("--tolerance", type=float, default=0.002, help="mm")
    options = parser.parse_args()
    sys.exit(max(main(folder, options.tolerance) for folder in options.folder))
