"""A box around a pair of gears in build123d: both gears from STEP, walls 2 mm thick with 1 mm of room.

Run: python examples/build123d_enclosure.py    (needs: pip install build123d)
"""

from __future__ import annotations

import tempfile
from pathlib import Path

from build123d import Box, Pos, export_step, import_step

import centrode

ROOM, WALL = 1.0, 2.0


def main() -> None:
    pair = centrode.motion(preset="ellipse:0.3", teeth=24, no_simulate=True)
    with tempfile.TemporaryDirectory() as folder:
        step = Path(folder) / "pair.step"
        step.write_bytes(pair.to_bytes("step"))
        gears = import_step(step)
    # The gears turn: the box takes the circles that their tips sweep.
    reach = [max((x * x + y * y) ** 0.5 for x, y in g.outline) for g in (pair.driver, pair.follower)]
    bounds = gears.bounding_box()
    width = reach[0] + pair.center_distance + reach[1] + 2 * ROOM
    depth = 2 * max(reach) + 2 * ROOM
    height = bounds.size.Z + 2 * ROOM
    middle = Pos((pair.center_distance + reach[1] - reach[0]) / 2, 0, (bounds.min.Z + bounds.max.Z) / 2)
    box = middle * (Box(width + 2 * WALL, depth + 2 * WALL, height + 2 * WALL) - Box(width, depth, height))
    export_step(box, "enclosure.step")
    print(f"enclosure.step: {width + 2 * WALL:.1f} x {depth + 2 * WALL:.1f} x {height + 2 * WALL:.1f} mm, {box.volume:.0f} mm3")


if __name__ == "__main__":
    main()
