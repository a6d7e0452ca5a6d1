#!/usr/bin/env python3
"""Draw the parts of a 3MF file as they lie, lit from one side with shadows: docs/pictures/plate.png.

usage: plate_picture.py plate.3mf picture.png [width in pixels]
"""

import re
import sys
import zipfile

import numpy as np
from PIL import Image

SAMPLES = 3
ELEVATION, AZIMUTH = 0.85, -0.3
LIGHT = np.array([-0.5, -0.35, 1.0])
BED = np.array([236.0, 233.0, 226.0])


def read(path):
    """Triangles (n, 3, 3) and their colours (n, 3)."""
    text = zipfile.ZipFile(path).read("3D/3dmodel.model").decode()
    colors = [bytes.fromhex(c) for c in re.findall(r'displaycolor="#(......)"', text)]
    places = [np.array(t.split(), float).reshape(4, 3) for t in re.findall(r'transform="([^"]*)"', text)]
    triangles, shades = [], []
    for part, color, place in zip(text.split("<mesh>")[1:], colors, places):
        numbers = lambda tag, names: np.array(
            re.findall("<%s %s" % (tag, " ".join(f'{n}="([^"]*)"' for n in names)), part), float
        )
        points = numbers("vertex", "xyz") @ place[:3] + place[3]
        corners = numbers("triangle", ("v1", "v2", "v3")).astype(int)
        triangles.append(points[corners])
        shades.append(np.tile(np.frombuffer(color, np.uint8).astype(float), (len(corners), 1)))
    return np.concatenate(triangles), np.concatenate(shades)


def raster(triangles, shape, draw):
    """The nearest depth of every pixel, and the number of its triangle; x right, y down, z to the eye."""
    depth = np.full(shape, -np.inf)
    number = np.full(shape, -1)
    for i in draw:
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = triangles[i]
        double = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        if double == 0.0:
            continue
        x0, x1 = int(max(min(ax, bx, cx), 0)), int(min(max(ax, bx, cx) + 1, shape[1]))
        y0, y1 = int(max(min(ay, by, cy), 0)), int(min(max(ay, by, cy) + 1, shape[0]))
        if x0 >= x1 or y0 >= y1:
            continue
        x, y = np.arange(x0, x1) + 0.5, (np.arange(y0, y1) + 0.5)[:, None]
        a = ((bx - x) * (cy - y) - (by - y) * (cx - x)) / double
        b = ((cx - x) * (ay - y) - (cy - y) * (ax - x)) / double
        z = a * az + b * bz + (1.0 - a - b) * cz
        window = (slice(y0, y1), slice(x0, x1))
        nearer = (a >= 0) & (b >= 0) & (a + b <= 1) & (z > depth[window])
        depth[window][nearer] = z[nearer]
        number[window][nearer] = i
    return depth, number


def view(elevation, azimuth):
    s, c = np.sin(azimuth), np.cos(azimuth)
    turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    s, c = np.sin(elevation - np.pi / 2), np.cos(elevation - np.pi / 2)
    return np.array([[1, 0, 0], [0, c, -s], [0, s, c]]) @ turn


def main(source, target, width=900):
    triangles, colors = read(source)
    low, high = triangles.min((0, 1)), triangles.max((0, 1))
    margin = 12.0
    corners = np.array([[x, y, -0.01] for x in (low[0] - margin, high[0] + margin) for y in (low[1] - margin, high[1] + margin)])
    bed = corners[[[0, 2, 1], [2, 3, 1]]]
    triangles, colors = np.concatenate([triangles, bed]), np.concatenate([colors, [BED, BED]])
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-12)[:, None]
    light = LIGHT / np.linalg.norm(LIGHT)

    def seen(matrix, pixels):
        p = triangles @ matrix.T
        least, most = p.min((0, 1)), p.max((0, 1))
        scale = pixels / (most[0] - least[0])
        shape = (int((most[1] - least[1]) * scale) + 1, int(pixels))
        flat = np.stack([(p[..., 0] - least[0]) * scale, (most[1] - p[..., 1]) * scale, p[..., 2]], -1)
        facing = np.nonzero((normals @ matrix.T)[:, 2] > 0)[0]
        return flat, shape, facing, least, most, scale

    eye = view(ELEVATION, AZIMUTH)
    flat, shape, facing, least, most, scale = seen(eye, width * SAMPLES)
    depth, number = raster(flat, shape, facing)
    sun = np.linalg.qr(np.column_stack([light, [1, 0, 0], [0, 1, 0]]))[0].T
    sun = np.array([sun[1], np.cross(sun[0] * np.sign(sun[0] @ light), sun[1]), sun[0] * np.sign(sun[0] @ light)])
    cast, size, lit, sun_least, sun_most, sun_scale = seen(sun, 1800)
    nearest, _ = raster(cast, size, lit)
    y, x = np.nonzero(number >= 0)
    back = np.stack([least[0] + (x + 0.5) / scale, most[1] - (y + 0.5) / scale, depth[y, x]], -1) @ eye
    there = back @ sun.T
    column = np.clip((there[:, 0] - sun_least[0]) * sun_scale, 0, size[1] - 1).astype(int)
    row = np.clip((sun_most[1] - there[:, 1]) * sun_scale, 0, size[0] - 1).astype(int)
    shadow = nearest[row, column] > there[:, 2] + 0.4
    bright = np.clip(normals[number[y, x]] @ light, 0, 1) * np.where(shadow, 0.0, 1.0)
    picture = np.full((*shape, 3), 255.0)
    picture[y, x] = colors[number[y, x]] * (0.5 + 0.55 * bright)[:, None]
    image = Image.fromarray(np.clip(picture, 0, 255).astype(np.uint8))
    image.resize((shape[1] // SAMPLES, shape[0] // SAMPLES), Image.LANCZOS).convert("P", palette=Image.ADAPTIVE, colors=96).save(target, optimize=True)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2], *map(int, sys.argv[3:4]))
