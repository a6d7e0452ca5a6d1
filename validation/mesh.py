#!/usr/bin/env python3
"""Judge the meshes of a design folder with trimesh: driver.stl, follower.stl, pair.obj, pair.glb.

Every body must be

  closed      watertight, consistently wound, in one piece, of the Euler number its bore asks for
  outward     every wall has material behind it and air before it, by the outline in design.json; the
              normals that the file stores look to the same side as its corners' order
  the size    volume of (outline - bore) x thickness, extents of the outline in all three directions,
              in the place and unit of its format: STL in the gear's own frame, OBJ in the first
              pose of the pair, GLB likewise but in metres with y up

Exit 0 when all pass, 1 when one fails, 2 when design.json cannot be used.
"""

import argparse
import itertools
import json
import pathlib
import sys

import numpy as np
import shapely
import shapely.affinity
import trimesh

# Relative: f32 meshes of 100 mm gears keep about 1e-6, curves flattened to chords about 1e-4.
VOLUME_TOLERANCE = 1e-3
# mm, for extents: f32 coordinates and six decimals of OBJ.
EXTENT_TOLERANCE = 2e-3


# mm before and behind a wall at which its sides are looked at; f32 moves a wall by 1e-5.
PROBE = 1e-3
# Share of the walls' area that may be too near another wall, or too small, to be probed so.
PROBE_SLACK = 1e-3
# Stored normals of a smooth surface lean from the facet's, by less than the crease angle.
LEAST_AGREEMENT = 0.5
# Height of a facet, over the longest edge of all, from which its direction counts.
SLIVER = 1e-5


def stl_normals(path):
    """Facet normals as they stand in a binary STL file."""
    record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])
    return np.fromfile(path, record, offset=84)["normal"].astype(float)


def obj_normals(path):
    """Normals of each corner as they stand in an OBJ file, faces by 3 by 3."""
    normals, faces = [], []
    with open(path, encoding="utf-8") as file:
        for words in map(str.split, file):
            if words[:1] == ["vn"]:
                normals.append([float(w) for w in words[1:4]])
            elif words[:1] == ["f"]:
                faces.append([int(w.split("/")[2]) - 1 for w in words[1:4]])
    return np.array(normals)[np.array(faces)]


def agreement(mesh, normals):
    """Least cosine between the facets of a mesh and the normals stored for them."""
    cross = np.cross(mesh.triangles[:, 1] - mesh.triangles[:, 0],
                     mesh.triangles[:, 2] - mesh.triangles[:, 0])
    length = np.linalg.norm(cross, axis=1)
    if normals.ndim == 2:
        normals = normals[:, None, :]
    size = np.linalg.norm(normals, axis=2)
    cosine = np.einsum("fi,fki->fk", cross, normals) / np.maximum(length[:, None] * size, 1e-300)
    # Slivers have no direction of their own in f32.
    longest = np.linalg.norm(mesh.triangles - np.roll(mesh.triangles, 1, axis=1), axis=2).max(axis=1)
    wide = length > SLIVER * longest * longest.max()
    return float(cosine[wide].min()) if wide.any() else 1.0


def bodies(path):
    """Closed bodies of a file in mm, z up, and the least agreement of its stored normals."""
    loaded = trimesh.load(path, process=False)
    meshes = loaded.dump() if isinstance(loaded, trimesh.Scene) else [loaded]
    if path.suffix == ".stl":
        agree = agreement(meshes[0], stl_normals(path))
    elif path.suffix == ".obj":
        agree = agreement(meshes[0], obj_normals(path)) if len(meshes) == 1 else 1.0
    else:
        agree = min(agreement(m, m.vertex_normals[m.faces]) for m in meshes)
    for mesh in meshes:
        if path.suffix == ".glb":
            # Metres with y up.
            mesh.apply_transform([[1000, 0, 0, 0], [0, 0, -1000, 0], [0, 1000, 0, 0], [0, 0, 0, 1]])
        # Formats store corners per face or per normal; the same place is the same vertex.
        mesh.merge_vertices(merge_norm=True, merge_tex=True)
        mesh.remove_unreferenced_vertices()
    return meshes, agree


def expected(gear, thickness, axis):
    outline, bore = gear["outline"], gear.get("bore")
    polygon = shapely.Polygon(outline, [bore] if bore else None)
    polygon = shapely.affinity.translate(polygon, axis, 0)
    west, south, east, north = polygon.bounds
    return {
        "polygon": polygon,
        "volume": polygon.area * thickness,
        "euler": 0 if bore else 2,
        "bounds": np.array([[west, south, 0], [east, north, thickness]]),
    }


def judge_body(mesh, want):
    """Reasons why a body fails."""
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
    if abs(mesh.volume / want["volume"] - 1) > VOLUME_TOLERANCE:
        failures.append(f"volume {mesh.volume:.4f}, not {want['volume']:.4f}")
    if np.abs(mesh.bounds - want["bounds"]).max() > EXTENT_TOLERANCE:
        failures.append(f"extents {np.round(mesh.bounds, 4).tolist()}, "
                        f"not {np.round(want['bounds'], 4).tolist()}")
    wrong = inward(mesh, want)
    if wrong > PROBE_SLACK:
        failures.append(f"{100 * wrong:.2f} % of the surface faces inward")
    return failures


def inward(mesh, want):
    """Share of the area whose normal does not lead out of the material."""
    centers, normals, areas = mesh.triangles_center, mesh.face_normals, mesh.area_faces
    top = want["bounds"][1, 2]
    flat = np.abs(normals[:, 2]) > 0.5
    up = np.where(centers[:, 2] > 0.5 * top, 1.0, -1.0)
    bad = flat & (normals[:, 2] * up < 0)
    walls = np.flatnonzero(~flat)
    shapely.prepare(want["polygon"])
    before, behind = (
        shapely.contains_xy(want["polygon"], *(centers + side * PROBE * normals)[walls, :2].T)
        for side in (1, -1))
    bad[walls] = before | ~behind
    return float(areas[bad].sum() / areas.sum())


def judge(folder):
    design = json.loads((folder / "design.json").read_text(encoding="utf-8"))
    thickness = float(design["thickness"])
    axes = {"driver": 0.0, "follower": float(design["center_distance"])}
    results = {}
    for name in axes:
        want = [(name, expected(design[name], thickness, 0.0))]
        results[f"{name}.stl"] = check_file(folder / f"{name}.stl", want)
    wants = [(name, expected(design[name], thickness, axis)) for name, axis in axes.items()]
    for name in ("pair.obj", "pair.glb"):
        results[name] = check_file(folder / name, wants)
    return results


def check_file(path, wants):
    if not path.exists():
        return ["missing"]
    try:
        found, agree = bodies(path)
    except Exception as error:  # any reader error is the file's failure
        return [f"unreadable: {error}"]
    if len(found) == 1 and len(wants) == 2:
        # One object that holds both gears, as some readers join the objects of an OBJ file.
        found = list(found[0].split(only_watertight=False))
    if len(found) != len(wants):
        return [f"{len(found)} bodies, not {len(wants)}"]
    failures = []
    if agree < LEAST_AGREEMENT:
        failures.append(f"a stored normal looks away from its face (cosine {agree:.3f})")
    # A file may list the gears in any order: the kindest reading counts.
    readings = [judge_bodies(order, wants) for order in itertools.permutations(found)]
    return failures + min(readings, key=len)


def judge_bodies(found, wants):
    return [f"{name}: {failure}"
            for mesh, (name, want) in zip(found, wants) for failure in judge_body(mesh, want)]


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
