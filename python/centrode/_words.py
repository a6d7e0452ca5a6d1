"""Keyword arguments as the words of the command line, so that both have the same options, units and defaults."""

from __future__ import annotations

import difflib
import json
import os
from collections.abc import Mapping
from functools import cache
from typing import Any

from . import _core
from .errors import InputError, told

#: Options that belong to the command line alone.
APART = frozenset({"output", "json", "quiet", "threads", "save-scene", "help", "version", "junit", "batch"})


@cache
def facts(command: str) -> dict[str, dict[str, Any]]:
    """The options of a command by name: whether each takes a value, its default, its choices, and its help."""
    with told():
        listed: list[dict[str, Any]] = json.loads(_core.options(command))
    return {fact["name"]: fact for fact in listed if fact["name"] not in APART}


def words(command: str, options: Mapping[str, Any]) -> list[str]:
    """The options of a command as its words. ``None`` leaves an option at its default."""
    known = facts(command)
    made = []
    for key, value in options.items():
        name = key.replace("_", "-")
        if name not in known:
            near = difflib.get_close_matches(name, known, 1)
            hint = f"did you mean {near[0].replace('-', '_')}?" if near else f"centrode.defaults({command!r}) lists them"
            raise InputError(f"{command} has no option {key}; {hint}", key)
        if not known[name]["takes_value"]:
            if value not in (True, False, None):
                raise InputError(f"{key} is a switch; give True or False", key)
            if value:
                made.append(f"--{name}")
        elif value is not None:
            made.append(f"--{name}={_text(key, value)}")
    return made


def _text(key: str, value: Any) -> str:
    if isinstance(value, bool):
        raise InputError(f"{key} takes a value, not {value}", key)
    if isinstance(value, (str, os.PathLike)):
        return os.fspath(value)
    if isinstance(value, complex):
        return f"{value.real!r},{value.imag!r}"
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, (list, tuple, set, frozenset)):
        return ",".join(_text(key, item) for item in value)
    return str(value)
