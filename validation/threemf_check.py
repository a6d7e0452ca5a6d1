#!/usr/bin/env python3
"""Read pair.3mf back with lib3mf, the consortium's own reader, and judge it (pip install lib3mf).

Strict mode, no warnings, millimetres; every object named, valid, manifold and oriented; the gears at the distance of their
axes; a thumbnail that is a PNG.

Exit 0 when all holds, 1 when something does not, 2 when the folder cannot be used.
"""

import json
import pathlib
import sys

import lib3mf


def objects(model):
    found = model.GetMeshObjects()
    while found.MoveNext():
        yield found.GetCurrentMeshObject()


def places(model):
    found = model.GetBuildItems()
    while found.MoveNext():
        item = found.GetCurrent()
        fields = item.GetObjectTransform().Fields
        yield item.GetObjectResource().GetName(), (fields[3][0], fields[3][1])


def main(folder):
    folder = pathlib.Path(folder)
    try:
        record = json.loads((folder / "design.json").read_text())
        path = folder / "pair.3mf"
        path.stat()
    except (OSError, ValueError) as error:
        print(f"{folder}: {error}; give folders that `centrode design` made")
        return 2
    model = lib3mf.get_wrapper().CreateModel()
    reader = model.QueryReader("3mf")
    reader.SetStrictModeActive(True)
    faults = []
    try:
        reader.ReadFromFile(str(path))
    except lib3mf.Lib3MF.ELib3MFException as error:
        print(f"{folder.name}: pair.3mf cannot be read: {error}")
        return 1
    if reader.GetWarningCount():
        faults += [reader.GetWarning(i)[1] for i in range(reader.GetWarningCount())]
    if model.GetUnit() != lib3mf.Lib3MF.ModelUnit.MilliMeter:
        faults.append(f"unit {model.GetUnit()}")
    names = []
    for thing in objects(model):
        names.append(thing.GetName())
        if not thing.IsValid() or not thing.IsManifoldAndOriented():
            faults.append(f"{thing.GetName()}: not a closed, oriented manifold")
    if names[:2] != ["driver", "follower"]:
        faults.append(f"objects {names}")
    place = dict(places(model))
    if {"driver", "follower"} <= place.keys():
        (x0, y0), (x1, y1) = place["driver"], place["follower"]
        if abs(x1 - x0 - record["center_distance"]) > 1e-4 or abs(y1 - y0) > 1e-4:
            faults.append(f"axes {x1 - x0:.5f}, {y1 - y0:.5f} mm apart")
    if not model.HasPackageThumbnailAttachment():
        faults.append("no thumbnail")
    print(f"{folder.name}: pair.3mf {', '.join(names)}: strict, no warnings" if not faults else folder.name)
    for fault in faults:
        print(f"  FAULT {fault}")
    return 1 if faults else 0


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit("usage: threemf_check.py FOLDER...")
    sys.exit(max(main(folder) for folder in sys.argv[1:]))
