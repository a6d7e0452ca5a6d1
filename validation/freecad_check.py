"""Read pair.step in FreeCAD: two valid closed solids of the right volume. Folder in CENTRODE_FOLDER."""

import json
import os
import pathlib

import Part

folder = pathlib.Path(os.environ["CENTRODE_FOLDER"])
record = json.loads((folder / "design.json").read_text())
shape = Part.read(str(folder / "pair.step"))


def area(ring):
    pairs = zip(ring, ring[1:] + ring[:1])
    return 0.5 * abs(sum(a[0] * b[1] - a[1] * b[0] for a, b in pairs))


wanted = sorted(
    (area(g["outline"]) - (area(g["bore"]) if g["bore"] else 0.0)) * record["thickness"]
    for g in (record["driver"], record["follower"])
)
found = sorted(solid.Volume for solid in shape.Solids)
off = [f / w - 1 for f, w in zip(found, wanted)]
good = shape.isValid() and len(found) == 2 and all(s.isClosed() for s in shape.Shells)
good = good and max(map(abs, off)) < 5e-4
print(
    f"FreeCAD: {len(found)} solids, valid {shape.isValid()},"
    f" volumes off by {', '.join(f'{o:+.1e}' for o in off)}" + ("" if good else " FAILS")
)
