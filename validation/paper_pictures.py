"""Small SVG pictures of pairs, from their records; plain Python."""

import math

DRIVER, FOLLOWER, GHOST, ALARM = "#8fc3ea", "#1f4e8c", "#8a94a1", "#d0104c"


def thinned(ring, tolerance):
    """The ring without points nearer than `tolerance` to the line of those kept (Ramer, Douglas, Peucker)."""
    n = len(ring)
    far = max(range(n), key=lambda i: math.dist(ring[0], ring[i]))
    closed = ring + ring[:1]
    keep = {0, far}
    spans = [(0, far), (far, n)]
    while spans:
        first, last = spans.pop()
        (ax, ay), (bx, by) = closed[first], closed[last]
        length = math.hypot(bx - ax, by - ay)
        worst, at = 0.0, None
        for i in range(first + 1, last):
            px, py = closed[i]
            if length:
                t = max(0.0, min(1.0, ((px - ax) * (bx - ax) + (py - ay) * (by - ay)) / length ** 2))
                gap = math.hypot(px - ax - t * (bx - ax), py - ay - t * (by - ay))
            else:
                gap = math.hypot(px - ax, py - ay)
            if gap > worst:
                worst, at = gap, i
        if worst > tolerance:
            keep.add(at)
            spans += [(first, at), (at, last)]
    return [ring[i] for i in sorted(keep)]


def path(ring, tolerance=0.12):
    """An SVG path in mm with y downwards, one decimal, relative."""
    points = [(round(10 * x), round(-10 * y)) for x, y in thinned([tuple(p) for p in ring], tolerance)]
    words, last = [], (0, 0)
    for i, (x, y) in enumerate(points):
        words.append(("M" if i == 0 else "l" if i == 1 else "") + f"{x - last[0]} {y - last[1]}")
        last = (x, y)
    return " ".join(words) + "z"


def reach(ring):
    return max(math.hypot(x, y) for x, y in ring)


def at_angle(motion, angle):
    """Follower angle at a driver angle."""
    phi, psi = motion["driver_angle"], motion["follower_angle"]
    i = max(0, min(len(phi) - 2, next((k for k, p in enumerate(phi) if p > angle), len(phi)) - 1))
    return psi[i] + (angle - phi[i]) * (psi[i + 1] - psi[i]) / (phi[i + 1] - phi[i])


def three_poses(record, part="outline", poses=3, alarm=None):
    """The pair at even driver angles over one turn; the first with the drawings. `alarm`: (pose index, ring) drawn in red, in the
    world's frame."""
    L, motion = record["center_distance"], record["motion"]
    gears = [record["driver"], record["follower"]]
    # The drawings stick out where bays were filled or corners rounded.
    far = [max(reach(g[part]), reach(g["input"]) if part == "outline" and g["input"] else 0) for g in gears]
    height, left, right = 1.02 * max(far), 1.02 * far[0], L + 1.02 * far[1]
    width = left + right
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{-10 * left:.0f} {-10 * height:.0f} '
           f'{10 * poses * width:.0f} {20 * height:.0f}" width="{240 * poses}" height="{480 * height / width:.0f}"><defs>']
    for i, gear in enumerate(gears):
        out.append(f'<path id="g{i}" d="{path(gear[part])}" fill="{(DRIVER, FOLLOWER)[i]}"/>')
    out.append("</defs>")
    for k in range(poses):
        angle = 2 * math.pi * k / poses
        turns = [-math.degrees(angle), math.degrees(at_angle(motion, angle))]
        for i in range(2):
            at = 10 * (k * width + i * L)
            out.append(f'<g transform="translate({at:.1f} 0) rotate({turns[i]:.2f})"><use href="#g{i}"/>')
            if k == 0 and part == "outline":
                out.append(f'<path d="{path(gears[i]["input"], 0.3)}" fill="none" stroke="{GHOST}" stroke-width="6"/>')
            out.append('<circle r="12" fill="#fff"/></g>')
        if alarm and alarm[0] == k:
            out.append(f'<path transform="translate({10 * k * width:.1f} 0)" d="{path(alarm[1], 0.02)}" fill="{ALARM}"/>')
    return "".join(out) + "</svg>\n"


def chart(series, labels, size=(560, 240)):
    """Curves over one turn: `series` is a list of (name, xs, ys, colour)."""
    width, height = size
    left, low, top, right = 52, 34, 10, 150
    xs = [x for _, a, _, _ in series for x in a]
    ys = [y for _, _, b, _ in series for y in b]
    (x0, x1), (y0, y1) = (min(xs), max(xs)), (0.0, 1.05 * max(ys))
    px = lambda x: left + (width - left - right) * (x - x0) / (x1 - x0)
    py = lambda y: height - low - (height - low - top) * (y - y0) / (y1 - y0)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="11" fill="#333">'
           f'<rect width="{width}" height="{height}" fill="#fff"/>']
    for k in range(5):
        y = y1 * k / 4
        out.append(f'<path d="M{left} {py(y):.1f}H{width - right}" stroke="#ddd"/><text x="{left - 6}" y="{py(y) + 4:.1f}" text-anchor="end">{y:.3g}</text>')
    for k in range(5):
        x = x0 + (x1 - x0) * k / 4
        out.append(f'<text x="{px(x):.1f}" y="{height - low + 14}" text-anchor="middle">{x:.0f}</text>')
    out.append(f'<text x="{(left + width - right) / 2}" y="{height - 6}" text-anchor="middle">{labels[0]}</text>'
               f'<text x="12" y="{height / 2}" transform="rotate(-90 12 {height / 2})" text-anchor="middle">{labels[1]}</text>')
    for i, (name, a, b, colour) in enumerate(series):
        stride = max(1, len(a) // 400)
        points = " ".join(f"{px(x):.1f},{py(y):.1f}" for x, y in list(zip(a, b))[::stride])
        out.append(f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="1.5"/>'
                   f'<rect x="{width - right + 10}" y="{top + 18 * i}" width="12" height="4" fill="{colour}"/>'
                   f'<text x="{width - right + 26}" y="{top + 6 + 18 * i}">{name}</text>')
    return "".join(out) + "</svg>\n"
