"""Commands that run as a process of their own: they make many files, and end at once when they are interrupted."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Sequence

from .errors import InputError, NotSound


def carried_out(words: Sequence[str]) -> str:
    """What a command prints. Raises ``InputError`` for its exit code 2 and ``NotSound`` for 1."""
    process = subprocess.Popen(
        [sys.executable, "-m", "centrode", *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    try:
        out, err = process.communicate()
    except BaseException:
        process.kill()
        process.wait()
        raise
    if process.returncode == 0:
        return out
    lines = [line.removeprefix("error: ") for line in err.splitlines() if line.startswith("error: ")]
    message = " ".join(lines) or err.strip() or f"the command ended with exit code {process.returncode}"
    if process.returncode == 1:
        raise NotSound(message)
    raise InputError(message)
