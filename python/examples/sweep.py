"""Teeth and ratio of one pair of shapes, swept: a table of likeness, greatest psi' and verdict.

Run: python examples/sweep.py [DRIVER FOLLOWER]
"""

from __future__ import annotations

import sys

import centrode


def main(driver: str = "egg", follower: str = "pear") -> None:
    print(f"{'ratio':>6} {'teeth':>6} {'likeness':>17} {'greatest psi_':>14}  verdict")
    for ratio in (1, 2):
        for teeth in (24, 36, 48):
            try:
                pair = centrode.design(driver, follower, ratio=ratio, teeth=teeth, no_simulate=True)
            except centrode.NotSound as refused:
                print(f"{ratio:>6} {teeth:>6} {'-':>17} {'-':>14}  {refused.diagnostics[0].code}")
                continue
            likeness = f"{pair.driver.likeness:.3f} and {pair.follower.likeness:.3f}"
            greatest = pair.motion.transmission.max()
            print(f"{ratio:>6} {teeth:>6} {likeness:>17} {greatest:>14.3f}  {pair.verdict}")


if __name__ == "__main__":
    main(*sys.argv[1:3])
