"""Types: the stubs say what the core has, and mypy agrees with the package."""

from __future__ import annotations

import ast
import subprocess
import sys
from pathlib import Path

import pytest

import centrode
from centrode import _core

PACKAGE = Path(centrode.__file__).parent


def test_the_stubs_name_what_the_core_has() -> None:
    tree = ast.parse((PACKAGE / "_core.pyi").read_text(encoding="utf-8"))
    stubs = {node.name for node in tree.body if isinstance(node, (ast.FunctionDef, ast.ClassDef))}
    assert stubs == {name for name in dir(_core) if not name.startswith("__")}
    (design,) = (node for node in tree.body if isinstance(node, ast.ClassDef) and node.name == "Design")
    methods = {node.name for node in design.body if isinstance(node, ast.FunctionDef)}
    assert methods == {name for name in dir(_core.Design) if not name.startswith("__")}


def test_arguments_of_the_stubs_are_those_of_the_core() -> None:
    import inspect

    tree = ast.parse((PACKAGE / "_core.pyi").read_text(encoding="utf-8"))
    for node in tree.body:
        if isinstance(node, ast.FunctionDef):
            real = list(inspect.signature(getattr(_core, node.name)).parameters)
            assert [arg.arg for arg in node.args.args] == real, node.name


def test_everything_public_is_documented() -> None:
    for name in centrode.__all__:
        if name != "__version__":
            assert getattr(centrode, name).__doc__, name
    assert (PACKAGE / "py.typed").is_file()


def test_mypy_agrees(tmp_path: Path) -> None:
    pytest.importorskip("mypy")
    config = Path(__file__).parents[1] / "pyproject.toml"
    made = subprocess.run(
        [sys.executable, "-m", "mypy", "--config-file", str(config), "-p", "centrode"],
        capture_output=True, text=True, cwd=tmp_path,
    )
    assert made.returncode == 0, made.stdout + made.stderr
