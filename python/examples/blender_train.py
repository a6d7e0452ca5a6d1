"""Renders a turning pair in Blender.

Run: blender --background --python examples/blender_train.py -- PAIR.glb out.png [frame]
"""

import sys

import bpy

GLB, IMAGE, *REST = sys.argv[sys.argv.index("--") + 1 :]
FRAME = int(REST[0]) if REST else 12

bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=GLB)
scene = bpy.context.scene
meshes = [o for o in scene.objects if o.type == "MESH"]
corners = [o.matrix_world @ v.co for o in meshes for v in o.data.vertices]
low = [min(c[i] for c in corners) for i in range(3)]
high = [max(c[i] for c in corners) for i in range(3)]
middle = [(a + b) / 2 for a, b in zip(low, high)]
size = max(b - a for a, b in zip(low, high))
bpy.ops.object.camera_add(location=(middle[0], middle[1] - 0.4 * size, middle[2] + 1.6 * size), rotation=(0.25, 0, 0))
scene.camera = bpy.context.object
bpy.ops.object.light_add(type="SUN", rotation=(0.5, 0.3, 0))
bpy.context.object.data.energy = 3
scene.render.engine = "CYCLES"
scene.cycles.samples = 16
scene.render.resolution_x, scene.render.resolution_y = 960, 540
scene.render.filepath = IMAGE
scene.frame_set(FRAME)
bpy.ops.render.render(write_still=True)
