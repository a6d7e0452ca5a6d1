"""Designs: arrays, files, errors, interrupts, and the same results as the command line."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import centrode

QUICK = {"no_simulate": True, "search": "coarse", "teeth": 24}


@pytest.fixture(scope="module")
def pair() -> centrode.Design:
    return centrode.motion("1 + 0.3*cos(2*phi)", teeth=24, no_simulate=True)


def test_arrays_tell_one_pair(pair: centrode.Design) -> None:
    assert pair.verdict and (pair.driver.teeth, pair.follower.teeth) == (24, 24)
    motion = pair.motion
    assert motion.driver_angle[0] == 0.0 and np.isclose(motion.driver_angle[-1], 2 * np.pi)
    assert motion.transmission is not None
    assert np.allclose(motion.transmission, 1 + 0.3 * np.cos(2 * motion.driver_angle), atol=0.01)
    turned = np.gradient(motion.follower_angle, motion.driver_angle)
    assert np.allclose(turned[5:-5], motion.transmission[5:-5], atol=1e-3)
    for gear in (pair.driver, pair.follower):
        assert gear.outline.dtype == np.float64 and gear.outline.shape[1] == 2
        x, y = gear.outline.T
        assert np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) > 0, "counter-clockwise"
        assert gear.exact_outline.shape == (len(gear.edges), 2)
        assert set(gear.edges) == {"flank", "tip", "root"}
        assert gear.bore is not None


def test_the_pitch_curves_roll(pair: centrode.Design) -> None:
    lengths = [
        np.linalg.norm(np.diff(g.pitch_curve, axis=0, append=g.pitch_curve[:1]), axis=1).sum()
        for g in (pair.driver, pair.follower)
    ]
    assert np.isclose(*lengths, rtol=1e-4)
    assert np.isclose(lengths[0], np.pi * 24 * pair.module, rtol=1e-3)


def test_gears_in_mesh_touch_and_do_not_overlap(pair: centrode.Design) -> None:
    shapely = pytest.importorskip("shapely")
    for angle in (0.0, 0.7, 2.1, 7.0):
        driver, follower = (shapely.Polygon(points) for points in pair.posed(angle))
        assert driver.intersection(follower).area < 1e-3 * pair.module**2
        assert driver.distance(follower) < pair.module


def test_shapes_of_every_kind_make_the_same_pair(tmp_path: Path) -> None:
    shapely = pytest.importorskip("shapely")
    angle = np.linspace(0, 2 * np.pi, 200, endpoint=False)
    points = np.column_stack([30 * np.cos(angle), 20 * np.sin(angle)])
    np.savetxt(tmp_path / "shape.csv", points, delimiter=",", fmt="%.17g")
    given = [points, points.tolist(), shapely.Polygon(points), tmp_path / "shape.csv"]
    outlines = [centrode.mate(shape, teeth=20, no_simulate=True).driver.outline for shape in given]
    assert all(np.array_equal(outline, outlines[0]) for outline in outlines)


def test_what_is_refused_names_the_argument() -> None:
    for call, option in [
        (lambda: centrode.design("heart", "dove", tooth=3), "tooth"),
        (lambda: centrode.design("heart", "dove", teeth="many"), "teeth"),
        (lambda: centrode.design("heart", np.zeros((3, 3))), "follower"),
        (lambda: centrode.design("heart", np.full((9, 2), np.nan)), "follower"),
        (lambda: centrode.design("heart", "dove", no_simulate=3), "no_simulate"),
        (lambda: centrode.motion("1 +* phi"), "law"),
        (lambda: centrode.design("heart", "dove", alternatives=3), "alternatives"),
    ]:
        with pytest.raises(centrode.InputError) as refused:
            call()
        assert refused.value.option == option, refused.value
    with pytest.raises(centrode.InputError, match="no_such"):
        centrode.design("heart", "no_such.svg")
    with pytest.raises(ValueError):
        centrode.Design.load("/nowhere")


def test_files_are_those_of_the_command_line(pair: centrode.Design, tmp_path: Path) -> None:
    line = [sys.executable, "-m", "centrode", "motion", "1 + 0.3*cos(2*phi)", "--teeth=24", "--no-simulate"]
    subprocess.run([*line, "-o", str(tmp_path / "line")], check=True, stdout=subprocess.DEVNULL)
    pair.export(tmp_path / "python")
    names = sorted(path.name for path in (tmp_path / "line").iterdir())
    assert names == sorted(path.name for path in (tmp_path / "python").iterdir())
    for name in names:
        assert (tmp_path / "line" / name).read_bytes() == (tmp_path / "python" / name).read_bytes(), name


def test_a_pair_is_saved_and_read(pair: centrode.Design, tmp_path: Path) -> None:
    again = centrode.Design.load(pair.save(tmp_path))
    assert np.array_equal(again.driver.outline, pair.driver.outline)
    assert again.diagnostics == pair.diagnostics
    assert again.to_bytes("step") == pair.to_bytes("step")
    with pytest.raises(centrode.InputError):
        _ = again.driver.edges
    with pytest.raises(centrode.InputError):
        pair.to_bytes("stl")
    assert again._repr_html_() and "<iframe" in pair._repr_html_()


def test_a_simulation_has_arrays(pair: centrode.Design) -> None:
    made = pair.simulate(load=200.0, friction=0.1, cycles=1)
    assert made.verdict and {run.drive for run in made.runs} == {"constant speed", "motor"}
    run = made.runs[0]
    assert run.driver_angle.shape == run.driver_torque.shape == run.contacts.shape
    with pytest.raises(centrode.InputError):
        pair.simulate(load=-1)


def test_progress_is_heard_and_may_stop_the_work() -> None:
    heard: list[tuple[str, float]] = []
    centrode.design("heart", "dove", progress=lambda stage, done: heard.append((stage, done)), **QUICK)
    assert heard and all(0 <= done <= 1 for _, done in heard)

    def stop(stage: str, done: float) -> None:
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        centrode.design("heart", "dove", progress=stop)


@pytest.mark.skipif(os.name == "nt", reason="signals of POSIX")
def test_an_interrupt_stops_a_design() -> None:
    at = []

    def interrupt() -> None:
        at.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(0.5, interrupt)
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        centrode.design("heart", "dove", effort=5, teeth=60)
    print(f"stopped {1e3 * (time.monotonic() - at[0]):.0f} ms after the interrupt")


def test_two_threads_design_at_once_and_alike(pair: centrode.Design) -> None:
    made: list[centrode.Design] = []
    work = [
        threading.Thread(
            target=lambda: made.append(centrode.motion("1 + 0.3*cos(2*phi)", teeth=24, no_simulate=True, threads=1))
        )
        for _ in range(2)
    ]
    for thread in work:
        thread.start()
    for thread in work:
        thread.join()
    assert len(made) == 2 and all(np.array_equal(m.driver.outline, pair.driver.outline) for m in made)


def test_a_pair_becomes_what_others_take(pair: centrode.Design) -> None:
    trimesh = pytest.importorskip("trimesh")
    scene = pair.to_trimesh()
    assert isinstance(scene, trimesh.Scene) and len(scene.geometry) >= 2
    driver, follower = pair.to_shapely()
    assert driver.is_valid and follower.is_valid and len(driver.interiors) == 1
    assert pair.to_mjcf().lstrip().startswith("<")
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    assert pair.plot(driver_angle=0.3).get_aspect() in ("equal", 1.0)


def test_a_train_is_written(pair: centrode.Design, tmp_path: Path) -> None:
    train = centrode.train(pair, tmp_path / "train", repeat=2, no_simulate=True, export="json", force=True)
    assert len(train.record["gears"]) == 4 and (train.folder / "train.json").is_file()
    with pytest.raises(centrode.InputError):
        centrode.train(tmp_path / "nothing", tmp_path / "out")


def test_defaults_are_those_of_the_command_line() -> None:
    defaults = centrode.defaults()
    assert defaults["ratio"] == "1" and defaults["teeth"] is None and defaults["strict"] == "False"
    assert "heart" in centrode.shapes() and "step" in centrode.formats()
    json.dumps(defaults)
