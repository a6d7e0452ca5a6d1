#!/usr/bin/env python3
"""Read pair.step back with OpenCascade and judge it (pip install cadquery-ocp).

Named, coloured parts in an assembly at the right distance, two gears and what stands beside them; each one valid closed
solid; volume within 1e-4 of (outline - bore - other holes) x thickness, hub, letters and marks, or of the plate with its posts
and pockets; fewer than 12 faces a tooth besides letters; under 3 MB for 32 teeth. With --chamfer the upper edges of each gear
are bevelled by 0.3 mm in OpenCascade, which must give a valid solid.

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
from OCP.BRepAdaptor import BRepAdaptor_Curve, BRepAdaptor_Surface
from OCP.BRepBndLib import BRepBndLib
from OCP.BRepCheck import BRepCheck_Analyzer
from OCP.BRepFilletAPI import BRepFilletAPI_MakeChamfer
from OCP.BRepGProp import BRepGProp
from OCP.GProp import GProp_GProps
from OCP.GeomAbs import GeomAbs_Plane
from OCP.IFSelect import IFSelect_RetDone
from OCP.Quantity import Quantity_Color
from OCP.STEPCAFControl import STEPCAFControl_Reader
from OCP.TCollection import TCollection_ExtendedString
from OCP.TDataStd import TDataStd_Name
from OCP.TDF import TDF_Label
from OCP.collections import Sequence_TDF_Label as LabelSequence
from OCP.TDocStd import TDocStd_Document
from OCP.TopAbs import TopAbs_EDGE, TopAbs_FACE, TopAbs_REVERSED, TopAbs_SHELL, TopAbs_SOLID
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS
from OCP.XCAFDoc import XCAFDoc_ColorType, XCAFDoc_DocumentTool, XCAFDoc_ShapeTool

VOLUME = 1e-4
QUADRATURE = 1e-9
CHAMFER = 0.3
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


def volume(shape):
    """Volume between level faces, by the divergence of (0, 0, z): upright walls give nothing.

    OpenCascade's own volume integrates over the walls with few points: up to 2e-4 off on gears whose
    curves have many spans.
    """
    total = 0.0
    for found in explore(shape, TopAbs_FACE):
        face = TopoDS.Face_s(found) if hasattr(TopoDS, "Face_s") else TopoDS.Face(found)
        surface = BRepAdaptor_Surface(face)
        if surface.GetType() != GeomAbs_Plane:
            continue
        plane = surface.Plane()
        up = plane.Axis().Direction().Z() * (1 if plane.Direct() else -1)
        if abs(up) < 0.5:
            continue
        properties = GProp_GProps()
        BRepGProp.SurfaceProperties_s(face, properties, QUADRATURE)
        side = -1 if face.Orientation() == TopAbs_REVERSED else 1
        total += side * up * plane.Location().Z() * properties.Mass()
    return total


def sharp_top_edges(shape, top):
    """Edges in the plane z = top."""
    for edge in explore(shape, TopAbs_EDGE):
        edge = TopoDS.Edge_s(edge) if hasattr(TopoDS, "Edge_s") else TopoDS.Edge(edge)
        curve = BRepAdaptor_Curve(edge)
        ends = [curve.Value(t).Z() for t in (curve.FirstParameter(), curve.LastParameter())]
        if all(abs(z - top) < 1e-6 for z in ends):
            yield edge


def bevelled(shape, top):
    """Whether all edges of the upper face take a bevel."""
    maker = BRepFilletAPI_MakeChamfer(shape)
    seen = set()
    for edge in sharp_top_edges(shape, top):
        if hash(edge) not in seen:
            seen.add(hash(edge))
            maker.Add(CHAMFER, edge)
    try:
        maker.Build()
    except Exception:
        return False
    return maker.IsDone() and BRepCheck_Analyzer(maker.Shape()).IsValid()


def plate_volume(part):
    """A fixture of the record: its plate, posts and pockets less its holes."""
    volume = area(part["outline"]) * part["thickness"]
    tops = [part["thickness"]] * len(part["holes"])
    for post in part["posts"]:
        volume += area(post["ring"]) * (post["to"] - post["from"])
        if post["hole"] is not None:
            tops[post["hole"]] = max(tops[post["hole"]], post["to"])
    volume -= sum(hole_area(hole) * top for hole, top in zip(part["holes"], tops))
    for pocket in part.get("pockets", []):
        widened = 0.0 if pocket["hole"] is None else hole_area(part["holes"][pocket["hole"]])
        volume -= (area(pocket["ring"]) - widened) * (pocket["to"] - pocket["from"])
    return volume


def explore(shape, kind):
    explorer = TopExp_Explorer(shape, kind)
    while explorer.More():
        yield explorer.Current()
        explorer.Next()


def name(label):
    attribute = TDataStd_Name()
    found = label.FindAttribute(TDataStd_Name.GetID_s(), attribute)
    return attribute.Get().ToExtString() if found else None


def main(folder, chamfer=False):
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
            plate = next((f for f in record.get("fixtures", []) if f["name"] == gear), None)
            shape = XCAFDoc_ShapeTool.GetShape_s(referred)
            if plate is None:
                faults.append(f"a part is named {gear!r}")
            elif not BRepCheck_Analyzer(shape).IsValid() or len(list(explore(shape, TopAbs_SOLID))) != 1:
                faults.append(f"{gear}: not one valid solid")
            # Round parts are drawn as polygons and written as circles: 5e-3 of a small one.
            elif not abs(volume(shape) / plate_volume(plate) - 1) < 1e-2:
                faults.append(f"{gear}: volume {volume(shape):.1f} instead of {plate_volume(plate):.1f}")
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
        bore = hole_area(data["bore"]) if data["bore"] else 0.0
        fittings = data.get("fittings") or {}
        holes = sum(hole_area(opening["ring"]) for opening in fittings.get("openings", []))
        wanted = (area(data["outline"]) - bore - holes) * record["thickness"]
        hub = fittings.get("hub")
        if hub:
            wanted += (math.pi * hub["radius"] ** 2 - bore) * hub["height"]
        marks = fittings.get("marks", [])
        for mark in marks:
            outer, *inner = mark["face"]
            wanted += (area(outer) - sum(map(area, inner))) * mark["height"]
        off = volume(shape) / wanted - 1
        if not abs(off) < VOLUME:
            faults.append(f"{gear}: volume off by {off:.1e}")
        lettered = sum(len(ring) for mark in marks for ring in mark["face"])
        faces = (len(list(explore(shape, TopAbs_FACE))) - lettered) / data["teeth"]
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
        raised = max([mark["height"] for mark in marks] + [0.0])
        top = record["thickness"] + max(hub["height"] if hub else 0.0, raised)
        extent = [*outline.min(0), 0.0, *outline.max(0), top]
        if np.abs(np.subtract([f() for p in (low, high) for f in (p.X, p.Y, p.Z)], extent)).max() > 0.02:
            faults.append(f"{gear}: extent differs")
        if chamfer and not bevelled(shape, record["thickness"]):
            faults.append(f"{gear}: its upper edges take no bevel of {CHAMFER} mm")
        said.append(f"{gear} {faces:.1f} faces a tooth, volume {off:+.1e}")
    if parts.Length() != 2 + len(record.get("fixtures", [])):
        faults.append(f"{parts.Length()} parts")
    # Letters are as large as they are.
    lettered = any((record[g].get("fittings") or {}).get("marks") for g in ("driver", "follower"))
    size = 0 if lettered or record.get("fixtures") else path.stat().st_size
    teeth = record["driver"]["teeth"] + record["follower"]["teeth"]
    if size > BYTES_PER_TOOTH * teeth:
        faults.append(f"{size} bytes")
    print(f"{folder.name}: read in {seconds:.2f} s, {path.stat().st_size / 1e6:.2f} MB; " + "; ".join(said))
    for fault in faults:
        print(f"  FAULT {fault}")
    return 1 if faults else 0


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit("usage: step_check.py [--chamfer] FOLDER...")
    folders = [word for word in sys.argv[1:] if word != "--chamfer"]
    sys.exit(max(main(folder, "--chamfer" in sys.argv) for folder in folders))
