"""The examples do what they say."""

from __future__ import annotations

import importlib.util
import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).parents[1] / "examples"


def run(name: str, *words: str, cwd: Path | None = None) -> str:
    line = [sys.executable, str(EXAMPLES / name), *words]
    made = subprocess.run(line, capture_output=True, text=True, cwd=cwd)
    assert made.returncode == 0, made.stdout + made.stderr
    return made.stdout


def test_sweep() -> None:
    assert run("sweep.py", "ellipse", "ellipse").count("meshes") >= 4


def test_mujoco_torque_loop() -> None:
    pytest.importorskip("mujoco")
    words = run("mujoco_torque_loop.py").split()
    assert float(words[words.index("off") - 1]) < 2.0


def test_pairs_of_a_project() -> None:
    made = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", str(EXAMPLES / "test_gears_mesh.py")], capture_output=True, text=True
    )
    assert made.returncode == 0 and "2 passed" in made.stdout, made.stdout


def test_enclosure(tmp_path: Path) -> None:
    pytest.importorskip("build123d")
    assert "mm3" in run("build123d_enclosure.py", cwd=tmp_path)
    assert (tmp_path / "enclosure.step").stat().st_size > 1000


def test_notebook() -> None:
    nbformat = pytest.importorskip("nbformat")
    nbclient = pytest.importorskip("nbclient")
    pytest.importorskip("ipykernel")
    notebook = nbformat.read(EXAMPLES / "kinematics.ipynb", as_version=4)
    nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3").execute()


def test_blender(tmp_path: Path) -> None:
    if importlib.util.find_spec("bpy") is None:
        pytest.skip("bpy is not installed")
    import centrode

    pair = centrode.motion(preset="ellipse:0.3", teeth=24, no_simulate=True)
    (tmp_path / "pair.glb").write_bytes(pair.to_bytes("glb"))
    run("blender_train.py", "--", str(tmp_path / "pair.glb"), str(tmp_path / "out.png"))
    assert (tmp_path / "out.png").stat().st_size > 1000
