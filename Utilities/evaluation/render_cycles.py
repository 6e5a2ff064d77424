# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Renders pictures by Blender's Cycles, as an unbiased path tracer of diffuse surfaces:

blender --background --factory-startup --python-exit-code 1 --python render_cycles.py -- JOB FOUND

JOB is a JSON file of the scene, the camera and the pictures, written by one_view.py. The pictures
are written as linear OpenEXR, and the seconds that Blender took for each as JSON to FOUND.
"""
import json
import math
import os
import sys
import time
from pathlib import Path

import bmesh
import bpy
from mathutils import Matrix, Vector


def cut(mesh):
    """Cuts each quadrilateral into 4 x 4. Close to the plane of a large emitting triangle, Cycles
    3.4 is too dark."""
    whole = bmesh.new()
    whole.from_mesh(mesh)
    bmesh.ops.subdivide_edges(whole, edges=whole.edges[:], cuts=3, use_grid_fill=True)
    whole.to_mesh(mesh)
    whole.free()


def add_block(block):
    """A mesh with flat, two-sided, diffuse faces, which may emit light."""
    mesh = bpy.data.meshes.new(block["name"])
    mesh.from_pydata(block["points"], [], block["polygons"])
    if mesh.validate():
        raise ValueError(f"Blender rejects parts of {block['name']}")
    strength = max(block["emission"])
    if strength > 0.0:
        cut(mesh)
    material = bpy.data.materials.new(block["name"])
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    diffuse = nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = (*block["reflectance"], 1.0)
    diffuse.inputs["Roughness"].default_value = 0.0  # Lambert
    surface = diffuse.outputs[0]
    link = material.node_tree.links.new
    if strength > 0.0:
        emission = nodes.new("ShaderNodeEmission")
        emission.inputs["Color"].default_value = (
            *(value / strength for value in block["emission"]), 1.0)
        emission.inputs["Strength"].default_value = strength
        add = nodes.new("ShaderNodeAddShader")
        link(surface, add.inputs[0])
        link(emission.outputs[0], add.inputs[1])
        surface = add.outputs[0]
    link(surface, nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    mesh.materials.append(material)
    bpy.context.scene.collection.objects.link(bpy.data.objects.new(block["name"], mesh))


def add_camera(camera):
    """A pinhole camera with a vertical angle in degrees."""
    position = Vector(camera["position"])
    back = (position - Vector(camera["focal_point"])).normalized()
    right = Vector(camera["view_up"]).cross(back).normalized()
    axes = Matrix((right, back.cross(right), back)).transposed().to_4x4()
    data = bpy.data.cameras.new("Camera")
    data.sensor_fit = "VERTICAL"
    data.angle_y = math.radians(camera["view_angle"])
    view = bpy.data.objects.new("Camera", data)
    view.matrix_world = Matrix.Translation(position) @ axes
    bpy.context.scene.collection.objects.link(view)
    bpy.context.scene.camera = view


def set_up(job):
    """Uses only the processor, and nothing that reduces noise at the cost of a bias."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y = job["size"]
    scene.render.resolution_percentage = 100
    scene.render.threads_mode = "FIXED"
    scene.render.threads = len(os.sched_getaffinity(0))
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.image_settings.color_mode = "RGB"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.use_denoising = False
    cycles.use_adaptive_sampling = False
    cycles.sample_clamp_direct = 0.0
    cycles.sample_clamp_indirect = 0.0
    cycles.pixel_filter_type = "BOX"  # a pixel wide
    # Cycles does not count the first reflection, of direct light, as a bounce.
    cycles.max_bounces = job["reflections"] - 1
    cycles.diffuse_bounces = job["reflections"] - 1


def render(samples, seed):
    """Renders a picture and returns the seconds this took."""
    cycles = bpy.context.scene.cycles
    cycles.samples = samples
    cycles.seed = seed
    begin = time.monotonic()
    bpy.ops.render.render()
    return time.monotonic() - begin


def main():
    job, found = map(Path, sys.argv[sys.argv.index("--") + 1:])
    job = json.loads(job.read_text())
    bpy.ops.wm.read_factory_settings(use_empty=True)
    for block in job["blocks"]:
        add_block(block)
    add_camera(job["camera"])
    set_up(job)
    render(1, 0)  # lets Blender do what it does only once
    seconds = []
    for picture in job["pictures"]:
        seconds.append(render(picture["samples"], picture["seed"]))
        bpy.data.images["Render Result"].save_render(picture["file"])
    found.write_text(json.dumps({"version": bpy.app.version_string, "seconds": seconds}))


if __name__ == "__main__":
    main()
