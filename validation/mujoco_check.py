#!/usr/bin/env python3
"""Turn a pair in MuJoCo and compare it with the motion it was designed for, and with simulation.csv.

Runs scene.xml of a design folder for two cycles. The follower's angle is compared

  with psi      the motion in design.json, repeated for ever;
  with contact  psi less the free play behind, found from the outlines with shapely (play.py);
  with rapier   simulation.csv, the simulation of Centrode itself, where the folder has one: angle
                and driver torque averaged over a quarter tooth. Its load must be the scene's,
                its friction the one given here.

Friction is left out unless --friction says otherwise: the programs' models of it differ.

The contact of the outlines is where they meet at rest. Where it jumps (a tooth lets go before the
next one holds, or the tip of the next one strikes first) no follower with mass can jump along, so what happens
from there until it has settled is told but not judged: "jumps" is that share of the cycle.

Passes when the run neither diverges nor loses contact, the follower stays near the contact where that
runs on, and, with simulation.csv, near it and its torque up to the first loss of contact. Exit 0 when it passes, 1 when it fails, 2 when the
folder cannot be used.
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

import play

# Follower angle against another simulation, degrees: root mean square and greatest.
MAX_RMS, MAX_WORST = 0.02, 0.1
# Against the contact of the outlines, degrees: the same, for either is as far from the truth.
MAX_TRACKING_RMS, MAX_TRACKING_WORST = 0.02, 0.1
# Torque of the driver, averaged, in loads: root mean square.
MAX_TORQUE_RMS = 0.05
# Share of a tooth over which torque is averaged.
WINDOW = 0.25
# Teeth that pass before anything counts.
LEAD_IN = 1.0
# Places a tooth at which the contact is worked out.
CONTACTS_PER_TOOTH = 8
# The contact jumps where it moves by more than this against psi between two places, radians (0.05 degrees).
JUMP = math.radians(0.05)
# Teeth after a jump until the follower has settled.
SETTLED = 0.35
# A gear that turns at more than this many times the speed of the driver was flung away.
FLUNG = 50.0
# Share of a tooth without contact that is a loss of it; facets and knocks leave a few steps between them.
LOST = 0.1


class Scene:
    """scene.xml, ready to run."""

    def __init__(self, path, friction):
        self.model = mujoco.MjModel.from_xml_path(str(path))
        self.data = mujoco.MjData(self.model)
        self.load = self.numeric("load")[0]
        self.teeth = int(self.numeric("teeth")[0])
        self.kappa = self.numeric("kappa")[0]
        self.speed = self.numeric("rpm")[0] * 2 * math.pi / 60
        self.friction = self.numeric("friction")[0] if friction is None else friction
        self.model.geom_friction[:, 0] = self.friction
        self.model.geom_condim[:] = 3 if self.friction > 0 else 1
        if self.model.njnt != 2:
            raise play.BadDesign(f"scene.xml has {self.model.njnt} gears, not a pair")

    def numeric(self, name):
        # Names begin with those of the gears and a slash.
        names = [self.model.numeric(i).name for i in range(self.model.nnumeric)]
        found = next((i for i, n in enumerate(names) if n.rsplit("/", 1)[-1] == name), -1)
        if found < 0:
            raise play.BadDesign(f"scene.xml has no numeric {name}")
        start = self.model.numeric_adr[found]
        return self.model.numeric_data[start:start + self.model.numeric_size[found]]

    def run(self, start, follower, slope, cycles_angle):
        """From driver angle `start` on: driver and follower angle (the sense of psi), torque, loaded."""
        model, data = self.model, self.data
        mujoco.mj_resetData(model, data)
        data.qpos[:] = start, -follower
        data.qvel[:] = self.speed, -slope * self.speed
        count = int(cycles_angle / self.speed / model.opt.timestep)
        made = np.empty((count, 4))
        for i in range(count):
            mujoco.mj_step(model, data)
            # Forces belong to the state before the step; one step of the driver is a 256th of a tooth.
            made[i] = data.qpos[0], -data.qpos[1], -data.qfrc_constraint[0], data.nefc > 0
            if not np.isfinite(data.qpos).all() or abs(data.qvel[1]) > FLUNG * self.speed:
                return made[:i + 1], f"diverged at {math.degrees(data.qpos[0]):.1f} degrees"
        bad = [str(mujoco.mjtWarning(k)) for k in range(len(data.warning)) if data.warning[k].number]
        return made, f"MuJoCo warned: {', '.join(bad)}" if bad else None


def averaged(values, half):
    """Mean over `half` neighbours on each side, fewer at the ends."""
    sums = np.concatenate([[0.0], np.cumsum(values)])
    at = np.arange(len(values))
    low, high = np.maximum(at - half, 0), np.minimum(at + half + 1, len(values))
    return (sums[high] - sums[low]) / (high - low)


def contact_lag(pair, psi, slope, start, cycle, count, distance, module):
    """Free play behind the designed angle at `count` places of a cycle, radians; NaN without contact."""
    lags = []
    for k in range(count):
        phi = start + cycle * k / count
        pitch = math.pi * module * (1 + slope(phi)) / distance
        tolerance = 0.1 * play.TURN_TOLERANCE * module * (1 + slope(phi)) / distance
        there = pair.place_follower(psi(phi), 0.5 * pitch)
        behind, _ = pair.plays(pair.place_driver(phi), there, 0.5 * pitch, play.COARSE_STEP * pitch,
                               tolerance)
        lags.append(math.nan if behind is None else behind)
    return np.array(lags)


def off(values):
    """Root mean square and greatest, degrees."""
    values = np.degrees(values[np.isfinite(values)])
    if not len(values):
        return math.nan, math.nan
    return float(np.sqrt(np.mean(values**2))), float(np.abs(values).max())


def jumping(lags, at):
    """Whether each pose (in places of the cycle) lies in a jump of the contact or soon after it."""
    count = len(lags)
    jump = ~(np.abs(np.roll(lags, -1) - lags) < JUMP)
    # A place before, for the jump may begin there; the settled part after.
    spread = jump | np.roll(jump, -1)
    for k in range(1, math.ceil(SETTLED * CONTACTS_PER_TOOTH) + 1):
        spread |= np.roll(jump, k)
    return spread[np.minimum(at.astype(int), count - 1)]


def longest_loss(loaded, step, tooth):
    """Longest run of the driver without contact in teeth, and the row where it begins."""
    longest, at, begun = 0, None, None
    for i, touching in enumerate(loaded):
        if touching:
            begun = None
            continue
        begun = i if begun is None else begun
        if i - begun + 1 > longest:
            longest, at = i - begun + 1, begun
    return longest * step / tooth, at


def longest_run_begins(loaded, longest):
    """The row at which more than `longest` rows without contact first begin, or the end."""
    run = 0
    for i, touching in enumerate(loaded):
        run = 0 if touching else run + 1
        if run > longest:
            return max(i + 1 - run, 2)
    return len(loaded)


def judge(folder, cycles, friction):
    design, outlines, driver_angle, follower_angle, distance, module = play.load(
        str(folder / "design.json"))
    psi, slope, start, cycle = play.periodic_motion(driver_angle, follower_angle)
    path = folder / "scene.xml"
    try:
        scene = Scene(path, friction)
    except ValueError as error:
        raise play.BadDesign(f"scene.xml: {error}") from error
    tooth = 2 * math.pi / scene.teeth
    pair = play.Pair(*outlines, distance, module)
    count = round(cycle / tooth * CONTACTS_PER_TOOTH)
    lags = contact_lag(pair, psi, slope, start, cycle, count, distance, module)
    begin = start - LEAD_IN * tooth
    first = lags[-CONTACTS_PER_TOOTH]
    first = 0.0 if math.isnan(first) else first
    made, fault = scene.run(begin, psi(begin) - first, slope(begin), cycles * cycle + LEAD_IN * tooth)
    made = made[made[:, 0] >= start]
    if len(made) < 2:
        return {"folder": str(folder), "pass": False, "failures": [fault or "it did not turn"]}
    phi, follower, torque, loaded = made.T
    step = float(np.mean(np.diff(phi)))
    # psi is asked once for each place of a fine grid: it is smooth, and steps are many.
    grid = np.linspace(phi[0], phi[-1], max(len(phi) // 8, 2))
    wanted = CubicSpline(grid, [psi(a) for a in grid])(phi)
    ideal_slope = CubicSpline(grid, [slope(a) for a in grid])(phi)
    # Straight between places, and none where either side has none.
    at = ((phi - start) % cycle) / cycle * count
    low = np.minimum(at.astype(int), count - 1)
    contact = wanted - lags[low] - (lags[(low + 1) % count] - lags[low]) * (at - low)
    half = round(0.5 * WINDOW * tooth / step)
    window = averaged(torque, half) / scene.load
    ideal = averaged(ideal_slope, half)
    tracking = follower - contact
    unsteady = jumping(lags, at)
    steady = np.where(unsteady, np.nan, tracking)
    lost_teeth, lost_at = longest_loss((loaded > 0) | unsteady, step, tooth)
    worst = int(np.nanargmax(np.abs(steady))) if np.isfinite(steady).any() else 0
    result = {
        "folder": str(folder),
        "mujoco": mujoco.__version__,
        "friction": scene.friction,
        "kappa": scene.kappa,
        "steps": len(made),
        "psi_degrees": off(follower - wanted),
        "swing_degrees": float(np.degrees(np.ptp(follower - wanted))),
        "contact_degrees": off(steady),
        "contact_with_jumps_degrees": off(tracking),
        "jumps": float(unsteady.mean()),
        "contact_worst_at": float(np.degrees(phi[worst])),
        "torque_rms": float(np.sqrt(np.mean((window - ideal)[~unsteady] ** 2))),
        "torque_worst": float(np.abs(window - ideal).max()),
        "lost_teeth": lost_teeth,
        "lost_at": None if lost_at is None else float(np.degrees(phi[lost_at])),
        "rapier": None,
    }
    failures = [fault] if fault else []
    rms, most = result["contact_degrees"]
    if not (rms <= MAX_TRACKING_RMS and most <= MAX_TRACKING_WORST):
        failures.append(f"off the contact by {rms:.4f} degrees RMS, {most:.4f} at most, "
                        f"at {result['contact_worst_at']:.1f}")
    if lost_teeth > LOST:
        failures.append(f"contact lost over {lost_teeth:.3f} teeth at {result['lost_at']:.1f} degrees")
    table = folder / "simulation.csv"
    if table.exists():
        free = longest_run_begins(loaded > 0, round(LOST * tooth / step))
        result["rapier"] = against(table, phi[:free], follower[:free], window[:free] * scene.load,
                                   scene.load)
        rms, most = result["rapier"]["degrees"]
        if not (rms <= MAX_RMS and most <= MAX_WORST):
            failures.append(f"off simulation.csv by {rms:.4f} degrees RMS, {most:.4f} at most")
        if not result["rapier"]["torque_rms"] <= MAX_TORQUE_RMS:
            failures.append(f"torque off simulation.csv by {result['rapier']['torque_rms']:.3f} loads RMS")
    result["failures"] = failures
    result["pass"] = not failures
    result["trace"] = {"driver_angle": phi, "error": follower - wanted, "tracking": tracking,
                       "torque": window, "ideal": ideal}
    return result


def against(table, phi, follower, torque, load):
    """Distances from the other simulation at its own driver angles, up to its first loss of contact."""
    with open(table, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    columns = {name: np.array([float(row[name]) for row in rows])
               for name in ("driver_angle", "follower_angle", "driver_torque_windowed")}
    at = columns["driver_angle"]
    use = (at >= phi[0]) & (at <= phi[-1])
    if not use.any():
        raise play.BadDesign("simulation.csv and the scene share no driver angle")
    differ = np.interp(at[use], phi, follower) - columns["follower_angle"][use]
    pull = (np.interp(at[use], phi, torque) - columns["driver_torque_windowed"][use]) / load
    return {"steps": int(use.sum()), "degrees": off(differ),
            "torque_rms": float(np.sqrt(np.mean(pull**2)))}


def line(result):
    if "psi_degrees" not in result:
        return "no run"
    text = (f"psi {result['psi_degrees'][0]:.4f}/{result['psi_degrees'][1]:.4f}"
            f"  contact {result['contact_degrees'][0]:.4f}/{result['contact_degrees'][1]:.4f} deg"
            f" (jumps {100 * result['jumps']:.1f} %: {result['contact_with_jumps_degrees'][1]:.3f})"
            f"  torque {result['torque_rms']:.3f} (at most {result['torque_worst']:.2f})  lost {result['lost_teeth']:.3f}")
    if result["rapier"]:
        r = result["rapier"]
        text += f"  rapier {r['degrees'][0]:.4f}/{r['degrees'][1]:.4f} deg torque {r['torque_rms']:.3f}"
    return text


def main():
    parser = argparse.ArgumentParser(description="A pair turned in MuJoCo.")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--cycles", type=float, default=2.0)
    parser.add_argument("--friction", type=float, default=0.0, help="of the flanks; -1: the scene's own")
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--trace", help="write every step to this CSV file")
    options = parser.parse_args()
    try:
        friction = None if options.friction < 0 else options.friction
        result = judge(options.folder, options.cycles, friction)
    except (play.BadDesign, OSError, KeyError, ValueError) as problem:
        print(f"{options.folder}: {problem}", file=sys.stderr)
        return 2
    trace = result.pop("trace", None)
    if options.trace and trace:
        np.savetxt(options.trace, np.column_stack(list(trace.values())), delimiter=",",
                   header=",".join(trace), comments="")
    if options.json:
        print(json.dumps(result))
    else:
        print(line(result))
        for failure in result["failures"]:
            print(f"FAIL {failure}")
    return 0 if result["pass"] else 1


if __name__ == "__main__":
    sys.exit(main())
