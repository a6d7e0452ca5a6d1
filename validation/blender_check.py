#!/usr/bin/env python3
"""Open a GLB in Blender without a window, judge its animation, render one frame (pip install bpy).

usage: blender_check.py pair.glb picture.png
Every gear is a named object in metres whose rotation is animated, and comes back to its first pose at the end.
"""

import math
import sys

import bpy
from mathutils import Vector


def main(path, picture):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=path)
    scene = bpy.context.scene
    gears = [o for o in bpy.data.objects if o.type == "MESH"]
    turning = [o for o in bpy.data.objects if o.animation_data and o.animation_data.action]
    faults = []
    if len(gears) < 2 or len(turning) < 2:
        faults.append(f"{len(gears)} meshes, {len(turning)} of them animated")
    ranges = [o.animation_data.action.frame_range for o in turning]
    begin, last = (round(min(r[0] for r in ranges)), round(max(r[1] for r in ranges))) if ranges else (0, 1)
    poses = {}
    for frame in (begin, last // 3, last):
        scene.frame_set(frame)
        poses[frame] = [o.matrix_world.to_quaternion() for o in turning]
    first, middle, end = poses.values()
    for o, a, b, c in zip(turning, first, middle, end):
        if a.rotation_difference(b).angle < math.radians(5):
            faults.append(f"{o.name} does not turn")
        if a.rotation_difference(c).angle > math.radians(1.0):
            faults.append(f"{o.name} ends {math.degrees(a.rotation_difference(c).angle):.1f} degrees from its start")
    corners = [o.matrix_world @ Vector(c) for o in gears for c in o.bound_box]
    low = Vector([min(c[i] for c in corners) for i in range(3)])
    high = Vector([max(c[i] for c in corners) for i in range(3)])
    size, center = (high - low).length, (high + low) / 2
    if not 0.01 < size < 2:
        faults.append(f"the scene is {size} m large: not metres")
    scene.frame_set(last // 3)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location = center + Vector((0.3, -0.85, 1.25)) * size
    camera.rotation_euler = (center - camera.location).to_track_quat("-Z", "Y").to_euler()
    camera.data.clip_start = size / 100
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.data.energy = 3
    sun.rotation_euler = (0.6, 0.3, 0)
    for thing in (camera, sun):
        scene.collection.objects.link(thing)
    scene.camera = camera
    world = bpy.data.worlds.new("world")
    world.color = (0.9, 0.9, 0.9)
    scene.world = world
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 16
    scene.render.resolution_x, scene.render.resolution_y = 960, 540
    scene.render.filepath = picture
    bpy.ops.render.render(write_still=True)
    names = ", ".join(o.name for o in turning)
    print(f"Blender: {names} turn over {last} frames" + (" FAILS" if faults else ""))
    for fault in faults:
        print(f"  FAULT {fault}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:3]))
