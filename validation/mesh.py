#!/usr/bin/env python3
"""Judge the meshes of a design folder with trimesh: driver.stl, follower.stl, pair.obj, pair.glb.

Every body must be closed, consistently wound with normals outward, in one piece, of the genus
that its bore asks for, as large as its outline says, and hold (outline - bore) x thickness.

Exit 0 when all pass, 1 when one fails, 2 when design.json cannot be used.
"""

import argparse
import itertools
import json
import pathlib
import sys

import numpy as np
import shapely
import trimesh

# Relative: f32 meshes of 100 mm gears keep about 1e-6, curves flattened to chords about 1e-4.
VOLUME_TOLERANCE = 1e-3
# mm, for extents: f32 coordinates and six decimals of OBJ.
EXTENT_TOLERANCE = 2e-3


def bodies(path):
    """Closed bodies of a file, in its own units, transforms applied."""
    loaded = trimesh.load(path, process=False)
    meshes = loaded.dump() if isinstance(loaded, trimesh.Scene) else [loaded]
    for mesh in meshes:
        # Formats store corners per face or per normal; the same place is the same vertex.
        mesh.merge_vertices(merge_norm=True, merge_tex=True)
        mesh.remove_unreferenced_vertices()
    return meshes


def expected(gear, thickness):
    outline, bore = gear["outline"], gear.get("bore")
    polygon = shapely.Polygon(outline, [bore] if bore else None)
    return {
        "area": polygon.area,
        "volume": polygon.area * thickness if thickness else None,
        "euler": 0 if bore else 2,
        "bounds": np.array(shapely.Polygon(outline).bounds),
    }


def judge_body(mesh, want, scale, flat):
    """Reasons why a body fails. `flat`: extents can be compared in the gear's own frame."""
    mesh = mesh.copy()
    mesh.apply_scale(scale)
    failures = []
    if not mesh.is_watertight:
        failures.append("not watertight")
    if not mesh.is_winding_consistent:
        failures.append("winding inconsistent")
    if mesh.volume <= 0:
        failures.append("normals inward")
    count = mesh.body_count
    if count != 1:
        failures.append(f"{count} bodies")
    if mesh.euler_number != want["euler"]:
        failures.append(f"Euler number {mesh.euler_number}, not {want['euler']}")
    # The axis is the direction of the greatest flat face pair; its extent is the thickness.
    height = thickness_of(mesh)
    volume = want["volume"] or want["area"] * height
    if abs(mesh.volume / volume - 1) > VOLUME_TOLERANCE:
        failures.append(f"volume {mesh.volume:.4f}, not {volume:.4f}")
    if want["volume"] and abs(height - want["volume"] / want["area"]) > EXTENT_TOLERANCE:
        failures.append(f"thickness {height:.4f}")
    if flat:
        found = mesh.bounds[:, :2].ravel()
        if np.abs(found - want["bounds"]).max() > EXTENT_TOLERANCE:
            failures.append(f"extents {np.round(found, 4)}, not {np.round(want['bounds'], 4)}")
    return failures


def thickness_of(mesh):
    normals = np.abs((mesh.face_normals * mesh.area_faces[:, None]))
    axis = int(np.argmax(normals.sum(axis=0)))
    return float(mesh.extents[axis])



def judge(folder):
    design = json.loads((folder / "design.json").read_text(encoding="utf-8"))
    thickness = find_thickness(design)
    wants = {name: expected(design[name], thickness) for name in ("driver", "follower")}
    results = {}
    for name in ("driver", "follower"):
        path = folder / f"{name}.stl"
        results[path.name] = check_file(path, [(name, wants[name])], True)
    for name in ("pair.obj", "pair.glb"):
        results[name] = check_file(folder / name, list(wants.items()), False)
    return results


def find_thickness(design):
    """In mm where the settings tell it, else None: then it is read off the mesh."""
    value = design.get("settings", {}).get("thickness", design.get("thickness"))
    return float(value) if isinstance(value, (int, float)) else None


def check_file(path, wants, flat):
    if not path.exists():
        return ["missing"]
    try:
        found = bodies(path)
    except Exception as error:  # any reader error is the file's failure
        return [f"unreadable: {error}"]
    if len(found) == 1 and len(wants) == 2:
        # One object that holds both gears, as some readers join the objects of an OBJ file.
        found = list(found[0].split(only_watertight=False))
    if len(found) != len(wants):
        return [f"{len(found)} bodies, not {len(wants)}"]
    # A file may list the gears in any order: the kindest reading counts.
    readings = [judge_bodies(order, wants, flat) for order in itertools.permutations(found)]
    return min(readings, key=len)


def judge_bodies(found, wants, flat):
    failures = []
    for mesh, (name, want) in zip(found, wants):
        # Scenes may be in metres (glTF) or mm: the size of the bodies says which.
        span = max(want["bounds"][2] - want["bounds"][0], want["bounds"][3] - want["bounds"][1])
        scale = 1000.0 if max(mesh.extents) < 0.1 * span else 1.0
        failures += [f"{name}: {f}" for f in judge_body(mesh, want, scale, flat)]
    return failures


def main():
    parser = argparse.ArgumentParser(description="Soundness of the meshes of a design.")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    try:
        results = judge(options.folder)
    except (OSError, ValueError, KeyError, TypeError) as error:
        print(f"{options.folder}: {type(error).__name__}: {error}", file=sys.stderr)
        return 2
    if options.json:
        print(json.dumps(results))
    else:
        for name, failures in results.items():
            print(f"{name}: {'; '.join(failures) if failures else 'sound'}")
    return 1 if any(results.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
