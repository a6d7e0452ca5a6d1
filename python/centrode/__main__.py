"""The command line, ``python -m centrode`` or ``centrode``."""

from __future__ import annotations

import signal
import sys

from . import _core


def main() -> None:
    """Carries out the command line of this process and ends it with the command's exit code."""
    # Work stops at once on Ctrl-C, as that of any command.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    sys.exit(_core.main(["centrode", *sys.argv[1:]]))


if __name__ == "__main__":
    main()
