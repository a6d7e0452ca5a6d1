#!/usr/bin/env python3
"""Read pair.step back with OpenCascade and judge it (pip install cadquery-ocp).

Two named, coloured parts in an assembly at the right distance; each one valid closed solid; volume within 1e-4 of
(outline - bore - other holes) x thickness and the hub; fewer than 12 faces a tooth; under 3 MB for 32 teeth.

Exit 0 when all holds, 1 when something does not, 2 when the folder cannot be used.
"""

import json
import math
import pathlib
import sys
import time

import numpy as np
from OCP.Bnd import Bnd_Box
from OCP.BRep import BRep_Tool
from OCP.BRepBndLib import BRepBndLib
from OCP.BRepCheck import BRepCheck_Analyzer
from OCP.BRepGProp import BRepGProp
from OCP.GProp import GProp_GProps
from OCP.IFSelect import IFSelect_RetDone
from OCP.Quantity import Quantity_Color
from OCP.STEPCAFControl import STEPCAFControl_Reader
from OCP.TCollection import TCollection_ExtendedString
from OCP.TDataStd import TDataStd_Name
from OCP.TDF import TDF_Label
from OCP.collections import Sequence_TDF_Label as LabelSequence
from OCP.TDocStd import TDocStd_Document
from OCP.TopAbs import TopAbs_FACE, TopAbs_SHELL, TopAbs_SOLID
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS
from OCP.XCAFDoc import XCAFDoc_ColorType, XCAFDoc_DocumentTool, XCAFDoc_ShapeTool

VOLUME = 1e-4
FACES = 12
BYTES_PER_TOOTH = 3e6 / 64  # 3 MB for a pair of 32 teeth each


def area(ring):
    x, y = np.asarray(ring).T
    return 0.5 * abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))


def hole_area(ring):
    """Area of a drawn hole; a regular polygon stands for its inscribed circle."""
    ring = np.asarray(ring)
    n = len(ring)
    radii = np.hypot(*ring.T)
    if n >= 12 and np.ptp(radii) < 1e-9 * radii[0]:
        return math.pi * (radii[0] * math.cos(math.pi / n)) ** 2
    return area(ring)


def explore(shape, kind):
    explorer = TopExp_Explorer(shape, kind)
    while explorer.More():
        yield explorer.Current()
        explorer.Next()


def name(label):
    attribute = TDataStd_Name()
    found = label.FindAttribute(TDataStd_Name.GetID_s(), attribute)
    return attribute.Get().ToExtString() if found else None


def main(folder):
    folder = pathlib.Path(folder)
    try:
        record = json.loads((folder / "design.json").read_text())
    except (OSError, ValueError) as error:
        print(f"cannot use {folder}: {error}", file=sys.stderr)
        return 2
    path = folder / "pair.step"
    start = time.time()
    document = TDocStd_Document(TCollection_ExtendedString("x"))
    reader = STEPCAFControl_Reader()
    reader.SetNameMode(True)
    reader.SetColorMode(True)
    faults = []
    if reader.ReadFile(str(path)) != IFSelect_RetDone or not reader.Transfer(document):
        print(f"{path}: OpenCascade cannot read it")
        return 1
    seconds = time.time() - start
    shapes = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    colors = XCAFDoc_DocumentTool.ColorTool_s(document.Main())
    roots = LabelSequence()
    shapes.GetFreeShapes(roots)
    if roots.Length() != 1 or not XCAFDoc_ShapeTool.IsAssembly_s(roots.Value(1)):
        faults.append(f"{roots.Length()} roots instead of one assembly")
    parts = LabelSequence()
    XCAFDoc_ShapeTool.GetComponents_s(roots.Value(1), parts)
    said = []
    for i in range(1, parts.Length() + 1):
        part = parts.Value(i)
        referred = TDF_Label()
        XCAFDoc_ShapeTool.GetReferredShape_s(part, referred)
        gear = name(referred)
        if gear not in ("driver", "follower"):
            faults.append(f"a part is named {gear!r}")
            continue
        data = record[gear]
        shape = XCAFDoc_ShapeTool.GetShape_s(referred)
        if not BRepCheck_Analyzer(shape).IsValid():
            faults.append(f"{gear}: not valid")
        if len(list(explore(shape, TopAbs_SOLID))) != 1:
            faults.append(f"{gear}: not one solid")
        for shell in explore(shape, TopAbs_SHELL):
            if not BRep_Tool.IsClosed_s(shell):
                faults.append(f"{gear}: open shell")
        properties = GProp_GProps()
        BRepGProp.VolumeProperties_s(shape, properties)
        bore = hole_area(data["bore"]) if data["bore"] else 0.0
        fittings = data.get("fittings") or {}
        holes = sum(hole_area(opening["ring"]) for opening in fittings.get("openings", []))
        wanted = (area(data["outline"]) - bore - holes) * record["thickness"]
        hub = fittings.get("hub")
        if hub:
            wanted += (math.pi * hub["radius"] ** 2 - bore) * hub["height"]
        off = properties.Mass() / wanted - 1
        if not abs(off) < VOLUME:
            faults.append(f"{gear}: volume off by {off:.1e}")
        faces = len(list(explore(shape, TopAbs_FACE))) / data["teeth"]
        if not faces < FACES:
            faults.append(f"{gear}: {faces:.1f} faces a tooth")
        color = Quantity_Color()
        solid = next(explore(shape, TopAbs_SOLID))
        kinds = (XCAFDoc_ColorType.XCAFDoc_ColorSurf, XCAFDoc_ColorType.XCAFDoc_ColorGen)
        if not any(colors.GetColor(s, k, color) for s in (shape, solid) for k in kinds):
            faults.append(f"{gear}: no colour")
        shift = XCAFDoc_ShapeTool.GetLocation_s(part).Transformation().TranslationPart()
        place = 0.0 if gear == "driver" else record["center_distance"]
        if math.hypot(shift.X() - place, shift.Y(), shift.Z()) > 1e-9:
            faults.append(f"{gear}: stands at {shift.X()}, {shift.Y()}, {shift.Z()}")
        box = Bnd_Box()
        BRepBndLib.AddOptimal_s(shape, box, False, False)
        low, high = box.CornerMin(), box.CornerMax()
        outline = np.asarray(data["outline"])
        top = record["thickness"] + (hub["height"] if hub else 0.0)
        extent = [*outline.min(0), 0.0, *outline.max(0), top]
        if np.abs(np.subtract([f() for p in (low, high) for f in (p.X, p.Y, p.Z)], extent)).max() > 0.02:
            faults.append(f"{gear}: extent differs")
        said.append(f"{gear} {faces:.1f} faces a tooth, volume {off:+.1e}")
    if parts.Length() != 2:
        faults.append(f"{parts.Length()} parts")
    size = path.stat().st_size
    teeth = record["driver"]["teeth"] + record["follower"]["teeth"]
    if size > BYTES_PER_TOOTH * teeth:
        faults.append(f"{size} bytes")
    print(f"{folder.name}: read in {seconds:.2f} s, {size / 1e6:.2f} MB; " + "; ".join(said))
    for fault in faults:
        print(f"  FAULT {fault}")
    return 1 if faults else 0


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit("usage: step_check.py FOLDER...")
    sys.exit(max(main(folder) for folder in sys.argv[1:]))
