"""Progress: a callback, or a bar where tqdm is installed."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Union

#: A function that is called with the stage's name and the share of it that is done (0 to 1), or ``True`` for a bar.
Progress = Union[Callable[[str, float], object], bool, None]

STAGES = ("wanted", "sized", "toothed", "analysed", "proven", "outfitted")


@contextmanager
def listener(progress: Progress) -> Iterator[Callable[[str, float], object] | None]:
    """The function that the core calls."""
    if progress is None or progress is False:
        yield None
        return
    if callable(progress):
        yield progress
        return
    try:
        from tqdm.auto import tqdm
    except ImportError:
        yield None
        return
    with tqdm(total=100, unit="%", leave=False) as bar:

        def show(stage: str, done: float) -> None:
            bar.set_description(stage)
            bar.n = round(100 * (STAGES.index(stage) + done) / len(STAGES))
            bar.refresh()

        yield show
