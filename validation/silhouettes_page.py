"""The tables and the sheet of examples that validation/random_silhouettes writes into the docs."""

import collections
import json
import re
import statistics

import numpy as np
import shapely

import silhouettes

FINE = 0.1  # mm, what a picture of 80 mm may leave out
TILE, COLUMNS, ROWS, LABEL = (176, 132), 6, 4, 9  # pixels; tiles; pixels
REFUSED_SHOWN = 4
INK, LEFT, RIGHT, GREY = (30, 30, 30), (150, 190, 225), (240, 190, 130), (185, 185, 185)

# What a refusal means, by words in it.
MEANINGS = [
    (r"loses? .*fewer teeth|contact is lost.*fewer teeth", "The teeth asked for are so small that the default clearance of 0.1 mm "
     "leaves too little of them."),
    (r"contact is lost", "The pitch curves bend or lean so fast that, with as many teeth as were asked for, a flank ends "
     "before the next one takes hold. Up to four gentler settings were tried before."),
    (r"too thin to hold together", "A neck of the gear is so thin that it is nothing to the kernel that makes the solid."),
    (r"play reaches", "Clearance, lean and small teeth together leave so much play that the teeth take hold at their tips only. "
     "Pairs with less lean were tried before."),
    (r"driven backwards", "As above, in one sense of rotation only."),
    (r"transmission error reaches", "Contact is kept, but the follower swings by more than a quarter of a pitch."),
    (r"gears overlap", "The finished outlines overlap by more than 1e-4 module."),
    (r"crosses itself", "A line that crosses itself, so that no single part has nearly all of the area."),
    (r"give a multiple of", "The generator asks now and then for teeth that cannot be shared out among the equal parts of a gear."),
    (r"number of follower teeth", "At ratios below 1 the follower has fewer teeth than the driver; under six there is no gear."),
    (r"more than \S+; thin", "More points than are read."),
    (r"too intricate", "More crossings or detail than is resolved in reasonable time."),
    (r"rotation centres", "No point inside one of the shapes sees enough of it to be an axis."),
    (r"run into one another", "Teeth of neighbouring parts of a pitch curve overlap."),
    (r"leaves nothing of a gear", "Somewhere the gear is thinner than the clearance on both its sides."),
]


def picture(path):
    """The outlines and drawings of a design, coarse enough to keep: driver, follower."""
    with open(path, encoding="utf-8") as file:
        design = json.load(file)
    thin = lambda points: np.round(np.asarray(shapely.Polygon(points).simplify(FINE).exterior.coords)[:-1], 2).tolist()
    gears = [{"outline": thin(design[name]["outline"]), "input": thin(design[name]["input"])}
             for name in ("driver", "follower")]
    return {"distance": design["center_distance"], "gears": gears}


class Tile:
    """A small picture on white."""

    def __init__(self):
        self.pixels = np.full((TILE[1], TILE[0], 3), 255.0)

    def fill(self, rings, colour):
        cover = silhouettes.coverage(rings, *TILE)[:, :, None]
        self.pixels = self.pixels * (1 - cover) + cover * np.array(colour, dtype=float)

    def stroke(self, ring, width, colour):
        band = shapely.LinearRing(ring).buffer(width / 2)
        self.fill(silhouettes.rings_of(band), colour)

    def label(self, font, text, row):
        rings = silhouettes.rings_of(font.line(text))
        if rings:
            self.fill([np.column_stack([4 + LABEL * r[:, 0], row - LABEL * r[:, 1]]) for r in rings], INK)


def fitted(groups, room):
    """A map of the points of all groups into a rectangle of pixels (left, top, right, bottom), y downwards."""
    points = np.vstack([ring for rings in groups for ring in rings])
    low, high = points.min(axis=0), points.max(axis=0)
    left, top, right, bottom = room
    unit = min((right - left) / (high[0] - low[0]), (bottom - top) / (high[1] - low[1]))
    middle = (low + high) / 2
    return lambda ring: np.column_stack([(left + right) / 2 + unit * (ring[:, 0] - middle[0]),
                                         (top + bottom) / 2 - unit * (ring[:, 1] - middle[1])])


def tile(row, shapes, font):
    made = Tile()
    made.label(font, f"{row['kinds'][0]} + {row['kinds'][1]}", 11)
    if "picture" in row:
        shown, move = row["picture"], [0.0, row["picture"]["distance"]]
        place = lambda i, key: np.array(shown["gears"][i][key]) + [move[i], 0.0]
        drawn = [[place(i, "input"), place(i, "outline")] for i in (0, 1)]
        to_pixels = fitted(drawn, (4, 16, TILE[0] - 4, TILE[1] - 4))
        for (drawing, _), colour in zip(drawn, (LEFT, RIGHT)):
            made.fill([to_pixels(drawing)], colour)
        for _, outline in drawn:
            made.stroke(to_pixels(outline), 1.0, INK)
        made.label(font, f"K {row['ratio']}  {row['teeth']} teeth", TILE[1] - 4)
    else:
        half = TILE[0] / 2
        for i, shape in enumerate(shapes):
            to_pixels = fitted([shape.rings], (4 + i * half, 16, half - 4 + i * half, TILE[1] - 16))
            made.fill([to_pixels(ring) for ring in shape.rings], GREY)
        made.label(font, row["outcome"], TILE[1] - 4)
    return made.pixels


def examples(rows, reason):
    """Pairs in which each kind is seen, and some that were refused."""
    shown, seen = [], set()
    delivered = [row for row in rows if "picture" in row]
    room = COLUMNS * ROWS - REFUSED_SHOWN
    for fresh in (2, 1, 0):
        for row in delivered:
            if len(shown) < room and row not in shown and len(set(row["kinds"]) - seen) >= fresh:
                shown.append(row)
                seen |= set(row["kinds"])
    reasons = set()
    for row in rows:
        if row["outcome"] == "refused" and reason(row) not in reasons and len(shown) < COLUMNS * ROWS:
            reasons.add(reason(row))
            shown.append(row)
    return shown


def sheet(path, rows, reason, seed, count, font):
    shown = examples(rows, reason)
    wanted = {row["number"] for row in shown if "picture" not in row}
    shapes = {number: pair for number, pair, _, _ in silhouettes.pairs(seed, count, font, wanted)}
    tiles = [tile(row, shapes.get(row["number"]), font) for row in shown]
    tiles += [np.full((TILE[1], TILE[0], 3), 255.0)] * (-len(tiles) % COLUMNS)
    lines = [np.hstack(tiles[i:i + COLUMNS]) for i in range(0, len(tiles), COLUMNS)]
    # Few levels pack well.
    levels = np.clip(np.round(np.vstack(lines) / 15) * 15, 0, 255).astype(np.uint8)
    path.write_bytes(silhouettes.png(levels))


def table(heads, rows):
    return ["| " + " | ".join(heads) + " |", "|" + " --- |" * len(heads),
            *("| " + " | ".join(str(c).replace("|", "\\|") for c in row) + " |" for row in rows), ""]


def kinds(rows):
    made = []
    for kind in sorted({k for row in rows for k in row["kinds"]}):
        of = [(row, i) for row in rows for i in (0, 1) if row["kinds"][i] == kind]
        count = collections.Counter(row["outcome"] for row, _ in of)
        alike = [row["likeness"][i] for row, i in of if row.get("likeness")]
        words = getattr(silhouettes, kind).__doc__.rstrip(".")
        made.append([kind, words[0].lower() + words[1:], len(of), *(count[k] for k in ("sound", "warnings", "refused", "failed")),
                     f"{statistics.median(alike):.2f}" if alike else "-"])
    return table(["kind", "what it is", "drawn", "sound", "with warnings", "refused", "failed", "likeness"], made)


def meaning(text):
    return next((words for pattern, words in MEANINGS if re.search(pattern, text)), "")


def told(row):
    return f"{row['names'][0]}.{row['formats'][0]} and {row['names'][1]}.{row['formats'][1]}, K {row['ratio']}, {row['teeth']} teeth"


def write(folder, rows, reason, font, options):
    """Writes random_silhouettes.md and pictures/random_silhouettes.png."""
    (folder / "pictures").mkdir(parents=True, exist_ok=True)
    sheet(folder / "pictures/random_silhouettes.png", rows, reason, options.seed, options.pairs, font)
    count = collections.Counter(row["outcome"] for row in rows)
    delivered = count["sound"] + count["warnings"]
    text = [
        "# Silhouettes drawn at random", "",
        f"Written by `validation/random_silhouettes --seed {options.seed} --pairs {options.pairs} --docs docs`; do not edit. "
        f"{2 * len(rows)} silhouettes of twenty kinds are",
        "drawn at random, turned, stretched, scaled and saved as SVG, PNG, CSV or JSON, and made into gears two by two, at a ratio",
        "of 1/3 to 4 and with 8 to 160 teeth on the driver, whether that suits the shapes or not; everything else is left at its",
        "default" + (", with the run as rigid bodies." if options.simulate else ", without the run as rigid bodies.")
        + " A delivered pair must mesh by `validation/play.py`, which shares no code with Centrode",
        f"({options.poses} poses: no overlap, contact kept, swing and play within limits; where the program warned of the swing, its own limit of a quarter pitch), and its files must hold finite numbers only; "
        "a refusal",
        "must write nothing and be one sentence that ends in a remedy. Anything else is a failure, as are a panic, 120 s of work or",
        "500 MB.", "",
        f"{len(rows)} pairs: {delivered} delivered and found to mesh ({count['sound']} without a warning), {count['refused']} refused, "
        f"{count['failed']} failed.", "",
        "![Examples](pictures/random_silhouettes.png)", "",
        "*Filled: the drawings as fitted. Lines: the gears. Grey: pairs that were refused.*", "",
        "## By kind", "", "Each pair counts for both of its kinds. Likeness: median intersection over union of pitch curve and drawing.", "",
        *kinds(rows),
    ]
    classes = collections.defaultdict(list)
    for row in rows:
        if row["outcome"] == "refused":
            classes[meaning(row["said"]) or reason(row)].append(row)
    text += ["## Refused", ""]
    for words, of in sorted(classes.items(), key=lambda item: -len(item[1])):
        text += [f"{len(of)} pair{'s' * (len(of) > 1)}. {words}", ""]
        text += [f"- {told(row)}: {row['said'].removeprefix('error: ')}" for row in of] + [""]
    text += ["## Failed", ""] + [f"- {told(row)}: {'; '.join(row['failures'])}" for row in rows if row["failures"]]
    text += ([] if count["failed"] else ["None."]) + [""]
    warnings = collections.Counter()
    for row in rows:
        warnings.update({generic(words, row["names"]) for words in row["warnings"]})
    text += ["## Warnings", "", "N stands for numbers.", "", *table(["pairs", "warning"], [[n, w] for w, n in warnings.most_common()])]
    text += ["## Time and memory", "",
             "Processor time of all threads: median {:.1f} s, most {:.1f} s. Memory: median {:.0f} MB, most {:.0f} MB. The slowest and the "
             "largest:".format(statistics.median(r["processor"] for r in rows), max(r["processor"] for r in rows),
                               statistics.median(r["memory"] for r in rows), max(r["memory"] for r in rows)), ""]
    worst = sorted(rows, key=lambda r: -r["processor"])[:10]
    worst += [r for r in sorted(rows, key=lambda r: -r["memory"])[:10] if r not in worst]
    worst.sort(key=lambda r: -r["processor"])
    text += table(["pair", "s", "MB", "outcome"],
                  [[told(r), f"{r['processor']:.1f}", f"{r['memory']:.0f}", r["outcome"]] for r in worst])
    (folder / "random_silhouettes.md").write_text("\n".join(text), encoding="utf-8")


def generic(words, names):
    for name in names:
        words = words.replace(name, "SHAPE")
    words = re.sub(r"-?\d+(\.\d+)?", "N", words)
    return re.sub(r"\b(driver|follower)\b", "GEAR", words)
