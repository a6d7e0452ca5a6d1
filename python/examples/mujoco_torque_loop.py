"""A torque loop drives a pair in MuJoCo: the policy sees both angles and asks for a torque on the driver.

The gears turn each other by their teeth alone; nothing else couples them. Prints how far the follower strays from psi.

Run: python examples/mujoco_torque_loop.py    (needs: pip install mujoco)
"""

from __future__ import annotations

import tempfile
from pathlib import Path

import mujoco
import numpy as np

import centrode

TARGET = np.pi  # follower angle to reach, radians clockwise


def policy(error: float, speed: float) -> float:
    """A proportional-derivative torque on the driver, N m."""
    return float(np.clip(0.8 * error - 0.15 * speed, -0.5, 0.5))


def main(seconds: float = 2.0) -> float:
    pair = centrode.motion(preset="ellipse:0.3", teeth=24)
    with tempfile.TemporaryDirectory() as folder:
        pair.export(folder, formats=["mjcf"])
        model = mujoco.MjModel.from_xml_path(str(Path(folder) / "scene.xml"))
    data = mujoco.MjData(model)
    hinges = [j for j in range(model.njnt) if model.jnt_type[j] == mujoco.mjtJoint.mjJNT_HINGE]
    driver, follower = (model.jnt_qposadr[j] for j in hinges[:2])
    wheel = model.jnt_dofadr[hinges[0]]
    start = data.qpos[[driver, follower]].copy()
    while data.time < seconds:
        turned = -(data.qpos[follower] - start[1])
        data.qfrc_applied[wheel] = policy(TARGET - turned, data.qvel[wheel])
        mujoco.mj_step(model, data)
    phi = data.qpos[driver] - start[0]
    psi = np.interp(phi % (2 * np.pi), pair.motion.driver_angle, pair.motion.follower_angle)
    turned = -(data.qpos[follower] - start[1])
    strays = float(np.degrees(abs(turned - psi)))
    print(f"driver turned {np.degrees(phi):.2f} degrees, follower {np.degrees(turned):.2f}, {strays:.3f} off psi")
    return strays


if __name__ == "__main__":
    main()
