#!/usr/bin/env python3
"""Turn a train in MuJoCo (scene.xml) and compare every gear with what Centrode said of it.

  with its law    motion.csv: each gear stands behind its composed transmission function by no more than its accumulated
                  play (train.json), and ahead of it by no more than rounding and knocks;
  with rapier     simulation.csv, Centrode's own run: the same error of every gear at the same driver angle.

Friction is left out, as in that run, and the gears start where its record starts. Without simulation.csv they start where
they were designed to stand, and what they do until every mesh has closed does not count. Exit 0 when all holds, 1 when not, 2 when the folder cannot be used.
usage: mujoco_train.py FOLDER [--cycles 1]
"""

import argparse
import csv
import json
import math
import pathlib
import sys

import mujoco
import numpy as np
from scipy.interpolate import CubicSpline

# Degrees: a gear's error against rapier's, root mean square and greatest over all gears.
MAX_RMS, MAX_WORST = 0.05, 0.5
# Degrees beyond its play that a gear may stand for a moment.
BEYOND = 0.1
# Teeth that pass before anything counts, and more for each mesh, as in Centrode's run.
LEAD_IN = 1.0


def table(path):
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    return rows[0], np.array(rows[1:], dtype=float)


def main(folder, cycles):
    try:
        record = json.loads((folder / "train.json").read_text())
        names, motion = table(folder / "motion.csv")
        model = mujoco.MjModel.from_xml_path(str(folder / "scene.xml"))
    except (OSError, ValueError) as error:
        print(f"{folder}: {error}; give a folder that `centrode train` wrote")
        return 2
    model.geom_condim[:] = 1
    phi, angles = motion[:, 0], motion[:, 1:]
    cycle = phi[-1]
    senses = np.sign(angles[-1])
    # Laws repeat after a cycle, less their mean.
    mean = angles[-1] / cycle
    waves = angles - phi[:, None] * mean
    waves[-1] = waves[0]
    wave = CubicSpline(phi, waves, bc_type="periodic")

    def law(at):
        return at * mean + wave(np.mod(at, cycle))

    def number(name):
        # Names begin with those of the gears and a slash.
        names = [model.numeric(i).name.rsplit("/", 1)[-1] for i in range(model.nnumeric)]
        return model.numeric_data[model.numeric_adr[names.index(name)]]

    speed = number("rpm") * 2 * math.pi / 60
    tooth = 2 * math.pi / number("teeth")
    run = None
    if (folder / "simulation.csv").exists():
        _, run = table(folder / "simulation.csv")
    lead = LEAD_IN + 0.25 * len(record["meshes"])
    start = -lead * tooth if run is None else run[0, 0]
    data = mujoco.MjData(model)
    play = np.array([gear["accumulated_play"] for gear in record["gears"]])
    slope = (law(start + 1e-4) - law(start - 1e-4)) / 2e-4
    # The errors of the run's first pose are where its meshes are closed by the loads.
    data.qpos[:] = law(start) + (0 if run is None else senses * run[0, 3:])
    data.qpos[0] = start
    data.qvel[:] = slope * speed
    count = int((cycles * cycle - start) / speed / model.opt.timestep)
    poses = np.empty((count, len(play)))
    for i in range(count):
        mujoco.mj_step(model, data)
        poses[i] = data.qpos
        if not np.isfinite(data.qpos).all():
            print(f"{folder.name}: diverged at {math.degrees(poses[i - 1, 0]):.1f} degrees")
            return 1
    poses = poses[poses[:, 0] > 0]
    wanted = poses[:, :1] * mean + wave(np.mod(poses[:, 0], cycle))
    errors = np.degrees(senses * (poses - wanted))
    faults = []
    ahead, behind = errors.max(0), -errors.min(0)
    for gear, a, b, p in zip(record["gears"], ahead, behind, np.degrees(play)):
        if b > p + BEYOND or a > p + BEYOND:
            faults.append(f"{gear['name']} is {a:.2f} ahead, {b:.2f} degrees behind; its play is {p:.2f}")
    compared = ""
    if run is not None:
        reach = poses[:, 0] < run[-1, 0]
        other = np.column_stack([np.interp(poses[reach, 0], run[:, 0], run[:, 3 + i]) for i in range(len(play))])
        off = errors[reach] - np.degrees(other)
        rms, worst = float(np.sqrt((off**2).mean())), float(np.abs(off).max())
        compared = f", rapier {rms:.4f}/{worst:.4f} degrees (RMS/worst)"
        if rms > MAX_RMS or worst > MAX_WORST:
            faults.append(f"{rms:.4f} degrees RMS, {worst:.4f} at worst from rapier")
    print(f"{folder.name}: {len(play)} gears, last one {behind[-1]:.2f} degrees behind at most{compared}")
    for fault in faults:
        print(f"  FAULT {fault}")
    return 1 if faults else 0


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--cycles", type=float, default=1.0)
    options = parser.parse_args()
    sys.exit(main(options.folder, options.cycles))
