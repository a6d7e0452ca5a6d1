#!/usr/bin/env python3
"""Judge a pair of gears by their outlines alone, independently of the program that made them.

Reads design.json, puts both outlines on their axes through one whole cycle of the stored motion,
and measures with shapely, at poses that lie on no grid of teeth:

  overlap   area and depth of the two outlines' intersection at the designed angles
  play      how far the follower can turn from its designed angle, behind and ahead, until the
            outlines overlap (bisection on the overlap area)
  jammed    poses at which both flanks overlap: no turn within half a pitch frees the follower;
            the depth limit alone judges them (gears without backlash touch on both sides)
  lost      poses at which the follower meets nothing behind within half a pitch

Exit 0 when the pair passes the limits below, 1 when it fails, 2 when the file cannot be used.
"""

import argparse
import json
import math
import sys

import numpy as np
import shapely
from scipy.interpolate import CubicSpline
from shapely import affinity

GOLDEN = (math.sqrt(5) - 1) / 2
# An intersection smaller than this (module^2) is a touch: a flank 1 module long, 1e-5 deep.
TOUCH_AREA = 1e-5
# Bisection ends at this turn of the follower, as arc in modules.
TURN_TOLERANCE = 2e-5
# Coarse steps of the search for contact, as a share of a pitch: no tooth is that thin.
COARSE_STEP = 1 / 40
# Limits of a pass. Depth in modules; strays of the transmission error in pitches.
MAX_DEPTH = 2e-3
MAX_STRAY_P99 = 0.03
# Clearance c on both gears lets the follower lag by 2c / (pi m cos(w)) pitches where the flank's normal
# leans by w against the motion. The least lag has w near the pressure angle; up to this w it may stray.
STEEPEST = math.radians(75)
MAX_BACKLASH = 0.45


class BadDesign(Exception):
    """The file is not a design that can be judged."""


def load(path):
    try:
        with open(path, encoding="utf-8") as file:
            design = json.load(file)
        gears = []
        for name in ("driver", "follower"):
            points = np.asarray(design[name]["outline"], dtype=float)
            if points.ndim != 2 or points.shape[1] != 2 or len(points) < 3:
                raise BadDesign(f"{name}.outline is not a list of points")
            polygon = shapely.Polygon(points)
            if not polygon.is_valid:
                raise BadDesign(f"{name}.outline: {shapely.is_valid_reason(polygon)}")
            if not polygon.exterior.is_ccw:
                raise BadDesign(f"{name}.outline runs clockwise")
            gears.append(polygon)
        driver_angle = np.asarray(design["motion"]["driver_angle"], dtype=float)
        follower_angle = np.asarray(design["motion"]["follower_angle"], dtype=float)
        return (design, gears, driver_angle, follower_angle,
                float(design["center_distance"]), float(design["module"]))
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise BadDesign(f"{type(error).__name__}: {error}") from error


def periodic_motion(driver_angle, follower_angle):
    """psi and psi' as a cubic spline whose deviation from the mean motion is periodic."""
    if len(driver_angle) != len(follower_angle) or len(driver_angle) < 8:
        raise BadDesign("motion: two lists of the same length, 8 or more, are needed")
    if np.any(np.diff(driver_angle) <= 0) or np.any(np.diff(follower_angle) <= 0):
        raise BadDesign("motion does not increase")
    start, cycle = driver_angle[0], driver_angle[-1] - driver_angle[0]
    mean = (follower_angle[-1] - follower_angle[0]) / cycle
    rest = follower_angle - mean * (driver_angle - start)
    rest[-1] = rest[0]
    spline = CubicSpline(driver_angle, rest, bc_type="periodic")

    def psi(phi):
        return float(spline(phi)) + mean * (phi - start)

    def psi_slope(phi):
        return float(spline(phi, 1)) + mean

    return psi, psi_slope, start, cycle


class Pair:
    """Two outlines on their axes."""

    def __init__(self, driver, follower, distance, module):
        self.driver, self.follower = driver, follower
        self.distance, self.module = distance, module
        self.reach = max(math.hypot(*p) for p in follower.exterior.coords)
        self.driver_reach = max(math.hypot(*p) for p in driver.exterior.coords)

    def place_driver(self, phi):
        """The driver at phi, cut to what the follower can touch."""
        turned = affinity.rotate(self.driver, phi, origin=(0, 0), use_radians=True)
        reach = self.reach + 0.1 * self.module
        window = shapely.box(self.distance - reach, -reach, self.distance + reach, reach)
        cut = turned.intersection(window)
        shapely.prepare(cut)
        return cut

    def place_follower(self, angle, limit):
        """The follower at an angle, cut to what may touch the driver within a turn of limit."""
        turned = affinity.rotate(self.follower, -angle, origin=(0, 0), use_radians=True)
        right = self.driver_reach - self.distance + 2 * limit * self.reach + 0.1 * self.module
        window = shapely.box(-self.reach - 1, -self.reach - 1, right, self.reach + 1)
        return affinity.translate(turned.intersection(window), self.distance, 0)

    def overlap(self, driver, follower):
        """Area (mm^2) and depth (mm) of the intersection."""
        common = driver.intersection(follower)
        area = common.area
        if area <= TOUCH_AREA * self.module**2:
            return area, 0.0
        return area, max(piece_depth(p, driver, follower) for p in pieces(common))

    def touches(self, driver, near, turn):
        follower = affinity.rotate(near, -turn, origin=(self.distance, 0), use_radians=True)
        if not driver.intersects(follower):
            return False
        return driver.intersection(follower).area > TOUCH_AREA * self.module**2

    def plays(self, driver, near, limit, step, tolerance):
        """Turns behind and ahead until contact; None without contact, NaN when jammed.

        Overlapping at the designed angle, the follower is first freed to the nearer side: that
        side's play is what it needed, taken negative, and the other is the room found beyond.
        """
        if not self.touches(driver, near, 0.0):
            return [self.play(driver, near, sense, limit, step, tolerance) for sense in (-1, 1)]
        ways = [(self.freeing_turn(driver, near, sense, limit, tolerance), sense)
                for sense in (-1, 1)]
        ways = sorted(way for way in ways if way[0] is not None)
        if not ways:
            return [math.nan, math.nan]
        turn, sense = ways[0]
        freed = affinity.rotate(near, -sense * (turn + tolerance), origin=(self.distance, 0),
                                use_radians=True)
        room = self.play(driver, freed, sense, limit, step, tolerance)
        room = None if room is None else room + turn
        return [-turn, room] if sense > 0 else [room, -turn]

    def freeing_turn(self, driver, near, sense, limit, tolerance):
        low, high = 0.0, tolerance
        while self.touches(driver, near, sense * high):
            # Small steps: the room between two flanks may be narrow.
            low, high = high, high + max(tolerance, 0.2 * high)
            if high > limit:
                return None
        while high - low > tolerance:
            middle = 0.5 * (low + high)
            if self.touches(driver, near, sense * middle):
                low = middle
            else:
                high = middle
        return high

    def play(self, driver, near, sense, limit, step, tolerance):
        """Turn in one sense from a free angle until contact, or None."""
        low = 0.0
        while True:
            high = min(low + step, limit)
            if self.touches(driver, near, sense * high):
                break
            if high >= limit:
                return None
            low = high
        while high - low > tolerance:
            middle = 0.5 * (low + high)
            if self.touches(driver, near, sense * middle):
                high = middle
            else:
                low = middle
        return 0.5 * (low + high)


def pieces(geometry):
    parts = getattr(geometry, "geoms", [geometry])
    return [p for p in parts if p.geom_type == "Polygon" and p.area > 0]


def piece_depth(piece, driver, follower):
    """How deep points of one outline lie inside the other, over one piece of the intersection."""
    corners = shapely.points(np.asarray(piece.exterior.coords))
    # Cut edges are out of the other outline's reach and do not count.
    inside_driver = shapely.distance(corners, driver.boundary)
    inside_follower = shapely.distance(corners, follower.boundary)
    return float(max(inside_driver.max(), inside_follower.max()))


def plain(value):
    """JSON has no NaN."""
    return None if value is None or math.isnan(value) else value


def percentile(values, share):
    return float(np.percentile(values, share)) if len(values) else None


def judge(path, poses):
    design, (driver, follower), driver_angle, follower_angle, distance, module = load(path)
    psi, psi_slope, start, cycle = periodic_motion(driver_angle, follower_angle)
    pair = Pair(driver, follower, distance, module)
    phases = np.sort(((np.arange(poses) + 0.5) * GOLDEN) % 1.0) * cycle + start
    rows, lost_at = [], []
    for phi in phases:
        radius = distance / (1 + psi_slope(phi))
        pitch = math.pi * module / radius
        tolerance = TURN_TOLERANCE * module / radius
        here = pair.place_driver(phi)
        there = pair.place_follower(psi(phi), 0.5 * pitch)
        area, depth = pair.overlap(here, there)
        behind, ahead = pair.plays(here, there, 0.5 * pitch, COARSE_STEP * pitch, tolerance)
        if behind is None:
            lost_at.append(math.degrees(phi))
        rows.append((phi, area, depth, behind, ahead, pitch))
    clearance = float(design.get("settings", {}).get("clearance", 0.0))
    stray = MAX_STRAY_P99 + 2 * clearance / (math.pi * module) * (1 / math.cos(STEEPEST) - 1)
    return summarise(path, rows, lost_at, module, poses, stray)


def summarise(path, rows, lost_at, module, poses, max_stray):
    jammed = sum(b is not None and math.isnan(b) for _, _, _, b, _, _ in rows)
    loaded = [(b, p) for _, _, _, b, _, p in rows if b is not None and not math.isnan(b)]
    error = np.array([-b / p for b, p in loaded])
    stray = np.abs(error - np.median(error)) if len(error) else np.array([])
    both = [(b + a, (b + a) / p) for _, _, _, b, a, p in rows
            if b is not None and a is not None and not math.isnan(a + b)]
    deepest = max(rows, key=lambda row: row[2])
    result = {
        "file": str(path),
        "poses": poses,
        "lost_poses": len(lost_at),
        "lost_driver_degrees": [round(a, 3) for a in lost_at],
        "jammed_poses": jammed,
        "max_overlap_mm2": max(row[1] for row in rows),
        "max_depth_mm": deepest[2],
        "max_depth_module": deepest[2] / module,
        "max_depth_at_degrees": math.degrees(deepest[0]),
        "overlapping_poses": sum(row[2] > 0 for row in rows),
        "backlash_degrees": [math.degrees(f(b for b, _ in both)) for f in (min, max)] if both
        else None,
        "error_pitch": {
            "median": float(np.median(error)) if len(error) else None,
            "median_deviation": percentile(stray, 50),
            "p99_deviation": percentile(stray, 99),
            "peak_to_peak": float(np.ptp(error)) if len(error) else None,
        },
    }
    failures = []
    if lost_at:
        failures.append(f"contact lost at {len(lost_at)} of {poses} poses")
    if result["max_depth_module"] > MAX_DEPTH:
        failures.append(f"overlap {result['max_depth_module']:.4f} module deep")
    if len(stray) and result["error_pitch"]["p99_deviation"] > max_stray:
        failures.append(f"transmission error p99 {result['error_pitch']['p99_deviation']:.3f} pitch")
    if both and max(p for _, p in both) > MAX_BACKLASH:
        failures.append("backlash near half a pitch")
    result["failures"] = failures
    result["pass"] = not failures
    result["per_pose"] = [
        {"driver_angle": phi, "area": area, "depth": depth, "behind": plain(behind), "ahead": plain(ahead)}
        for phi, area, depth, behind, ahead, _ in rows
    ]
    return result


def main():
    parser = argparse.ArgumentParser(description="Free play, overlap and lost contact of a pair.")
    parser.add_argument("design", help="design.json, or the folder that holds it")
    parser.add_argument("--poses", type=int, default=256)
    parser.add_argument("--json", action="store_true", help="print everything, pose by pose")
    options = parser.parse_args()
    path = options.design if options.design.endswith(".json") else options.design + "/design.json"
    try:
        result = judge(path, max(options.poses, 1))
    except BadDesign as problem:
        print(f"{path}: {problem}", file=sys.stderr)
        return 2
    if options.json:
        print(json.dumps(result))
    else:
        e = result["error_pitch"]
        pct = lambda v: "-" if v is None else f"{100 * v:.3f}%"
        print(f"lost {result['lost_poses']} jam {result['jammed_poses']} of {result['poses']}"
              f"  depth {result['max_depth_module']:.5f} m"
              f"  TE median {pct(e['median'])} dev {pct(e['median_deviation'])}"
              f" p99 {pct(e['p99_deviation'])} p-p {pct(e['peak_to_peak'])} of a pitch"
              f"  backlash deg {[round(b, 4) for b in result['backlash_degrees'] or []]}")
        for failure in result["failures"]:
            print(f"FAIL {failure}")
    return 0 if result["pass"] else 1


if __name__ == "__main__":
    sys.exit(main())
