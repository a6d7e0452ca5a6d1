"""Verdicts on finished gears."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import centrode

DATA = Path(__file__).parents[2] / "tests" / "data"
DRIVER, FOLLOWER = DATA / "involute_24_driver.csv", DATA / "involute_48_follower.csv"


def test_a_sound_pair_is_found_sound_from_files_and_arrays() -> None:
    report = centrode.check(DRIVER, FOLLOWER, center_distance=72, no_simulate=True)
    assert report and report.verdict and report.teeth == (24, 48) and report.ratio == pytest.approx(2.0)
    gears = [np.loadtxt(path, delimiter=",", skiprows=3) for path in (DRIVER, FOLLOWER)]
    again = centrode.check(*gears, center_distance=72, no_simulate=True)
    assert again.verdict is report.verdict and again.teeth == report.teeth


def test_overlap_and_a_gap_are_verdicts() -> None:
    tight = centrode.check(DRIVER, FOLLOWER, center_distance=50, no_simulate=True)
    assert not tight and tight.diagnostics[0].code == "overlap" and tight.diagnostics[0].figures["depth"] > 1
    wide = centrode.check(DRIVER, FOLLOWER, center_distance=90, no_simulate=True)
    assert not wide and wide.diagnostics[0].code == "no-contact" and wide.diagnostics[0].figures["gap"] > 1


def test_limits_decide_and_are_checked(tmp_path: Path) -> None:
    sound = {"center_distance": 72, "ratio": 2, "no_simulate": True}
    strict = {"transmission_error": 0.0, "noted_transmission_error": 0.0}
    assert not centrode.check(DRIVER, FOLLOWER, limits=strict, **sound)
    file = tmp_path / "limits.toml"
    file.write_text("transmission-error = 0.0\nnoted-transmission-error = 0.0\n")
    assert not centrode.check(DRIVER, FOLLOWER, limits=file, **sound)
    with pytest.raises(centrode.InputError, match="overlp"):
        centrode.check(DRIVER, FOLLOWER, limits={"overlp": 1}, **sound)


def test_a_motion_is_taken_as_arrays() -> None:
    angle = np.linspace(0, 4 * np.pi, 721)
    report = centrode.check(DRIVER, FOLLOWER, center_distance=72, motion=(angle, angle / 2), no_simulate=True)
    assert report.ratio == pytest.approx(2.0) and report.follower_angle.size == report.driver_angle.size
    with pytest.raises(centrode.InputError):
        centrode.check(DRIVER, FOLLOWER, center_distance=72, motion=(angle, angle[:5]))
