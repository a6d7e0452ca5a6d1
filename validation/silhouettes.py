"""Silhouettes drawn at random, twenty kinds of them, and the files that a person might bring them in.

Each is a list of closed rings (arrays of points, y upwards), to be filled by the even-odd rule. A silhouette depends on its
seed and number only. Letters come from a font file through fontTools, which ezdxf brings along.
"""

import importlib.util
import json
import math
import pathlib
import random
import struct
import zlib

import numpy as np
import shapely
from fontTools.pens.basePen import BasePen
from fontTools.ttLib import TTFont
from shapely import affinity
from shapely.geometry import LineString, Point, Polygon, box

LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789&@%?!§$#+*=/{}[]~;"
CURVE_STEPS = 8  # chords for each curve of a glyph


def default_font():
    """A font in this environment (MuJoCo's studio has one), or one of the system's."""
    found = importlib.util.find_spec("mujoco")
    places = [pathlib.Path(found.origin).parent] if found and found.origin else []
    for place in [*places, pathlib.Path("/usr/share/fonts"), pathlib.Path("/Library/Fonts")]:
        fonts = sorted(place.rglob("*.ttf"))
        fonts = [f for f in fonts if "awesome" not in f.name.lower()]
        if fonts:
            return fonts[0]
    raise FileNotFoundError("no TrueType font found; give one with --font")


class Flattened(BasePen):
    """Contours of a glyph as polylines."""

    def __init__(self, glyphs):
        super().__init__(glyphs)
        self.rings = []

    def _moveTo(self, point):
        self.rings.append([point])

    def _lineTo(self, point):
        self.rings[-1].append(point)

    def _curveToOne(self, b, c, d):
        a = self._getCurrentPoint()
        for i in range(1, CURVE_STEPS + 1):
            t = i / CURVE_STEPS
            w = ((1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t**3)
            self.rings[-1].append(tuple(sum(k * p[n] for k, p in zip(w, (a, b, c, d))) for n in (0, 1)))

    def _closePath(self):
        pass

    _endPath = _closePath


class Font:
    """Glyphs of a TrueType font as shapes."""

    def __init__(self, path):
        self.font = TTFont(path)
        self.glyphs, self.names = self.font.getGlyphSet(), self.font.getBestCmap()

    def shape(self, letter):
        glyph = self.glyphs[self.names[ord(letter)]]
        pen = Flattened(self.glyphs)
        glyph.draw(pen)
        solid, holes = [], []
        for ring in pen.rings:
            if len(ring) < 3:
                continue
            polygon = Polygon(ring)
            # TrueType runs outer contours clockwise.
            (holes if polygon.exterior.is_ccw else solid).append(polygon.buffer(0))
        return shapely.union_all(solid).difference(shapely.union_all(holes))

    def line(self, text):
        """A line of text, one unit a letter's height."""
        shapes, x = [], 0.0
        for letter in text:
            name = self.names.get(ord(letter), ".notdef")
            if letter != " ":
                shapes.append(affinity.translate(self.shape(letter), x, 0.0))
            x += self.glyphs[name].width
        scale = 1.0 / self.font["head"].unitsPerEm
        return affinity.scale(shapely.union_all(shapes), scale, scale, origin=(0, 0))


def polar(radii):
    angles = np.arange(len(radii)) * (2 * math.pi / len(radii))
    return np.column_stack([radii * np.cos(angles), radii * np.sin(angles)])


def waves(rng, count, orders, falling=1.0):
    """A random periodic function, of order 1."""
    t = np.arange(count) * (2 * math.pi / count)
    total = np.zeros(count)
    for n in range(1, orders + 1):
        total += rng.gauss(0, 1) / n**falling * np.cos(n * t + rng.uniform(0, 2 * math.pi))
    return total


def blob(rng, _):
    """A star-shaped outline of a few waves."""
    return Polygon(polar(np.exp(rng.uniform(0.1, 0.5) * waves(rng, 400, rng.randint(2, 9)))))


def lump(rng, _):
    """Discs in a chain: not star-shaped."""
    x = y = 0.0
    discs, heading = [], rng.uniform(0, 7)
    for _ in range(rng.randint(3, 9)):
        radius = rng.uniform(0.4, 1.0)
        discs.append(Point(x, y).buffer(radius, 24))
        heading += rng.uniform(-1.6, 1.6)
        x, y = x + 1.2 * radius * math.cos(heading), y + 1.2 * radius * math.sin(heading)
    return shapely.union_all(discs)


def star(rng, _):
    """Five to many spikes, sharp or stubby, sometimes uneven."""
    spikes, depth, uneven = rng.randint(3, 24), rng.uniform(0.15, 0.9), rng.choice([0.0, 0.0, 0.3])
    radii = [(depth if i % 2 else 1.0) * (1 + uneven * rng.uniform(-1, 1)) for i in range(2 * spikes)]
    return Polygon(polar(np.array(radii)))


def letter(rng, font):
    """A letter, digit or sign of a font."""
    known = [c for c in LETTERS if ord(c) in font.names]
    return font.line(rng.choice(known))


def gear(rng, _):
    """A cogwheel with notches, trapezoid or square, perhaps some missing."""
    teeth, depth, lean = rng.randint(6, 60), rng.uniform(0.05, 0.35), rng.uniform(0.0, 0.2)
    points = []
    for i in range(teeth):
        high = 1.0 if rng.random() > 0.05 else 1.0 - depth
        for share, radius in ((lean, high), (0.5 - lean, high), (0.5, 1.0 - depth), (1.0, 1.0 - depth)):
            angle = 2 * math.pi * (i + share) / teeth
            points.append((radius * math.cos(angle), radius * math.sin(angle)))
    return Polygon(points).buffer(0)


def comb(rng, _):
    """A back with long teeth."""
    count, gap, length = rng.randint(4, 30), rng.uniform(0.2, 0.8), rng.uniform(0.5, 4.0)
    teeth = [box(i, 0, i + 1 - gap, length * rng.choice([1.0, 1.0, rng.uniform(0.3, 1)])) for i in range(count)]
    return shapely.union_all([box(0, -rng.uniform(0.3, 2), count - gap, 0.01), *teeth])


def spiral(rng, _):
    """A band wound up once to four times."""
    turns, steps = rng.uniform(1.0, 4.0), 400
    t = np.linspace(0, turns * 2 * math.pi, steps)
    radius = 0.3 + t / (2 * math.pi)
    line = LineString(np.column_stack([radius * np.cos(t), radius * np.sin(t)]))
    return line.buffer(rng.uniform(0.1, 0.45), cap_style=rng.choice(["round", "flat"]))


def hairs(rng, font):
    """A body with hairs, as thin as a thousandth of it."""
    body = blob(rng, font)
    width = 10 ** rng.uniform(-3, -1.3)
    strands = []
    for _ in range(rng.randint(1, 40)):
        angle, length = rng.uniform(0, 2 * math.pi), rng.uniform(0.8, 3.0)
        bend = angle + rng.uniform(-0.4, 0.4)
        middle = (0.6 * length * math.cos(angle), 0.6 * length * math.sin(angle))
        tip = (middle[0] + 0.4 * length * math.cos(bend), middle[1] + 0.4 * length * math.sin(bend))
        strands.append(LineString([(0, 0), middle, tip]).buffer(width, 2))
    return shapely.union_all([body, *strands])


def crescent(rng, _):
    """A disc less a disc."""
    shift, radius = rng.uniform(0.15, 1.0), rng.uniform(0.6, 1.1)
    return Point(0, 0).buffer(1, 64).difference(Point(shift, 0).buffer(radius, 64))


def bar(rng, _):
    """A rectangle, 3 to 200 times as long as wide, square or round at its ends."""
    length = 10 ** rng.uniform(0.5, 2.3)
    return LineString([(0, 0), (length, 0)]).buffer(0.5, cap_style=rng.choice(["flat", "round"]))


def slots(rng, _):
    """A rectangle with slots from its sides."""
    width, height = rng.uniform(1, 3), rng.uniform(1, 3)
    shape = box(0, 0, width, height)
    for _ in range(rng.randint(1, 10)):
        thin, deep = 10 ** rng.uniform(-2.5, -0.7), rng.uniform(0.2, 0.95)
        if rng.random() < 0.5:
            x = rng.uniform(0.05, width - thin - 0.05)
            shape = shape.difference(box(x, -1, x + thin, deep * height) if rng.random() < 0.5
                                     else box(x, height * (1 - deep), x + thin, height + 1))
        else:
            y = rng.uniform(0.05, height - thin - 0.05)
            shape = shape.difference(box(-1, y, deep * width, y + thin))
    return shape


def pieces(rng, font):
    """Several pieces of different size; the largest counts."""
    made, x = [], 0.0
    for _ in range(rng.randint(2, 7)):
        piece = rng.choice([blob, star, crescent, bar])(rng, font)
        extent = max(piece.bounds[2] - piece.bounds[0], piece.bounds[3] - piece.bounds[1])
        size = rng.uniform(0.3, 1.0) / extent
        made.append(affinity.translate(affinity.scale(piece, size, size, origin=(0, 0)), x, rng.uniform(-1, 1)))
        x += 1.3
    return shapely.union_all(made)


def dense(rng, _):
    """An outline of very many vertices, some more than are read."""
    count = int(10 ** rng.uniform(3.7, 5.4))
    return Polygon(polar(np.exp(0.35 * waves(rng, count, 40, 1.5))))


def jagged(rng, _):
    """An outline that trembles from vertex to vertex, as a bad trace does."""
    count = rng.randint(100, 3000)
    generator = np.random.default_rng(rng.getrandbits(32))
    noise = generator.normal(0, 10 ** rng.uniform(-3, -0.8), count)
    return Polygon(polar(np.exp(0.3 * waves(rng, count, 5) + noise)))


def ring(rng, _):
    """A ring, broken or whole, or a disc with holes."""
    shape = Point(0, 0).buffer(1, 64).difference(Point(rng.uniform(-0.1, 0.1), 0).buffer(rng.uniform(0.3, 0.85), 64))
    if rng.random() < 0.6:
        gap = rng.uniform(0.02, 1.2)
        shape = shape.difference(Polygon([(0, 0), (2, -gap), (2, gap)]))
    return shape


def scribble(rng, _):
    """A closed line that crosses itself."""
    return [np.array([(rng.uniform(-1, 1), rng.uniform(-1, 1)) for _ in range(rng.randint(4, 30))])]


def shard(rng, _):
    """Three to seven corners, at times very sharp."""
    points = shapely.MultiPoint([(rng.uniform(-1, 1), rng.uniform(-1, 1) * rng.choice([1, 0.2, 0.02]))
                                 for _ in range(rng.randint(3, 7))])
    hull = points.convex_hull
    return hull if hull.geom_type == "Polygon" else box(0, 0, 1, 1)


def branches(rng, _):
    """A tree of strokes."""
    strokes, ends = [], [(0.0, 0.0, 1.57, 1.0)]
    for _ in range(rng.randint(4, 25)):
        x, y, heading, length = rng.choice(ends)
        heading, length = heading + rng.uniform(-1.2, 1.2), length * rng.uniform(0.6, 1.0)
        tip = (x + length * math.cos(heading), y + length * math.sin(heading))
        strokes.append(LineString([(x, y), tip]).buffer(rng.uniform(0.05, 0.25)))
        ends.append((*tip, heading, length))
    return shapely.union_all(strokes)


def waist(rng, _):
    """Two bodies on a neck, down to a hundredth of them."""
    neck = 10 ** rng.uniform(-2, -0.5)
    left, right = Point(-1, 0).buffer(rng.uniform(0.4, 1), 32), Point(1.5, 0).buffer(rng.uniform(0.4, 1), 32)
    return shapely.union_all([left, right, box(-1, -neck, 1.5, neck)])


def wheel(rng, _):
    """Spokes and a rim, or spokes alone."""
    count, thin = rng.randint(2, 14), rng.uniform(0.02, 0.2)
    parts = [Point(0, 0).buffer(rng.uniform(0.1, 0.4))]
    for i in range(count):
        angle = 2 * math.pi * i / count
        parts.append(LineString([(0, 0), (math.cos(angle), math.sin(angle))]).buffer(thin, cap_style="flat"))
    if rng.random() < 0.4:
        parts.append(Point(0, 0).buffer(1.05, 64).difference(Point(0, 0).buffer(0.85, 64)))
    return shapely.union_all(parts)


KINDS = [blob, lump, star, letter, gear, comb, spiral, hairs, crescent, bar, slots, pieces, dense, jagged, ring, scribble,
         shard, branches, waist, wheel]


def rings_of(shape):
    """All rings of a shape, the outer ones first."""
    if isinstance(shape, list):
        return shape
    polygons = [p for p in getattr(shape, "geoms", [shape]) if p.geom_type == "Polygon"]
    polygons.sort(key=lambda p: -p.area)
    lines = [p.exterior for p in polygons] + [r for p in polygons for r in p.interiors]
    return [np.asarray(line.coords)[:-1] for line in lines]


class Silhouette:
    """One random shape: `kind`, its `rings`, and the `format` it is written in."""

    def __init__(self, seed, number, kind, font):
        rng = random.Random(f"{seed}-{number}")
        self.number, self.kind = number, kind.__name__
        rings = rings_of(kind(rng, font))
        turn, stretch = rng.uniform(0, 2 * math.pi), rng.choice([1.0, 1.0, rng.uniform(0.5, 2)])
        # From drawings in metres to drawings in thousandths of a millimetre.
        scale = 10 ** rng.choice([0, 1, 2, rng.uniform(-3, 5)])
        move = np.array([rng.uniform(-5, 5), rng.uniform(-5, 5)]) * scale
        c, s = math.cos(turn), math.sin(turn)
        matrix = scale * np.array([[c * stretch, -s], [s * stretch, c]])
        self.rings = [ring @ matrix.T + move for ring in rings]
        self.format = rng.choice(["svg", "svg", "csv", "json", "png"])
        self.pixels, self.inverted = rng.choice([100, 300, 300, 800, 2000]), rng.random() < 0.3

    def name(self):
        return f"{self.kind}-{self.number}"

    def write(self, folder):
        """The file a person would bring; holes and lesser pieces are in drawings and images only."""
        path = folder / f"{self.name()}.{self.format}"
        if self.format == "svg":
            path.write_text(self.svg(), encoding="utf-8")
        elif self.format == "png":
            path.write_bytes(png(self.image()))
        else:
            points = self.rings[0].tolist()
            text = json.dumps(points) if self.format == "json" else "".join(f"{x:.9g},{y:.9g}\n" for x, y in points)
            path.write_text(text, encoding="utf-8")
        return path

    def bounds(self):
        points = np.vstack(self.rings)
        return points.min(axis=0), points.max(axis=0)

    def svg(self):
        low, high = self.bounds()
        size = high - low
        path = "".join("M" + "L".join(f"{x - low[0]:.6g},{high[1] - y:.6g}" for x, y in ring) + "Z" for ring in self.rings)
        return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {size[0]:.6g} {size[1]:.6g}">'
                f'<path fill-rule="evenodd" d="{path}"/></svg>\n')

    def image(self):
        """Grey levels, dark on light or the other way round, with a margin."""
        low, high = self.bounds()
        unit = self.pixels / max(high - low)
        width, height = (np.ceil((high - low) * unit).astype(int) + 20)
        rings = [(ring - low) * unit + 10 for ring in self.rings]
        cover = coverage([np.column_stack([r[:, 0], height - r[:, 1]]) for r in rings], width, height, 2)
        return (255 * (cover if self.inverted else 1 - cover)).astype(np.uint8)


def coverage(rings, width, height, fine=3):
    """Share of each pixel that rings fill by the even-odd rule; pixels, y downwards."""
    edges = [np.column_stack([ring, np.roll(ring, -1, axis=0)]) for ring in rings]
    x0, y0, x1, y1 = np.vstack(edges).T * fine
    total = np.zeros((height * fine, width))
    columns = np.arange(width * fine) + 0.5
    for row in range(height * fine):
        y = row + 0.5
        meets = (y0 > y) != (y1 > y)
        if meets.any():
            t = (y - y0[meets]) / (y1[meets] - y0[meets])
            crossings = np.sort(x0[meets] + t * (x1[meets] - x0[meets]))
            inside = np.searchsorted(crossings, columns) % 2
            total[row] = inside.reshape(width, fine).mean(axis=1)
    return total.reshape(height, fine, width).mean(axis=1)


def png(pixels):
    """A PNG file: grey (height, width) or colour (height, width, 3) levels."""
    height, width = pixels.shape[:2]
    chunk = lambda name, data: struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    head = struct.pack(">IIBBBBB", width, height, 8, 2 if pixels.ndim == 3 else 0, 0, 0, 0)
    lines = b"".join(b"\0" + row.tobytes() for row in np.ascontiguousarray(pixels))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(lines, 9)) + chunk(b"IEND", b"")


RATIOS = ["1/3", "1/2", "1", "1", "2", "3", "4"]


def pairs(seed, count, font, wanted):
    """Of `count` pairs those with the numbers wanted: number, two silhouettes, ratio, teeth of the driver."""
    rng = random.Random(seed)
    kinds = [KINDS[i % len(KINDS)] for i in range(2 * count)]
    rng.shuffle(kinds)
    for number in range(count):
        ratio = rng.choice(RATIOS)
        teeth = round(8 * 20 ** rng.random())
        if "/" in ratio and rng.random() < 0.9:
            # The driver's teeth must divide by the folds; every tenth pair forgets it.
            folds = int(ratio[2:])
            teeth = -(-teeth // folds) * folds
        if number not in wanted:
            continue
        shapes = [Silhouette(seed, 2 * number + i, kinds[2 * number + i], font) for i in (0, 1)]
        yield number, shapes, ratio, teeth
