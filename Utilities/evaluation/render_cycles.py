# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Renders pictures by Blender's Cycles, as an unbiased path tracer:

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
    """A mesh with two-sided faces, which may emit light. With normals they are smooth."""
    mesh = bpy.data.meshes.new(block["name"])
    mesh.from_pydata(block["points"], [], block["polygons"])
    if mesh.validate():
        raise ValueError(f"Blender rejects parts of {block['name']}")
    if "coordinates" in block:
        layer = mesh.uv_layers.new()
        for corner, point in enumerate(mesh.loops):
            layer.data[corner].uv = block["coordinates"][point.vertex_index]
    if "normals" in block:
        mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
        mesh.use_auto_smooth = True
        mesh.normals_split_custom_set_from_vertices(block["normals"])
    strength = max(block["emission"])
    if strength > 0.0:
        cut(mesh)
    material = bpy.data.materials.new(block["name"])
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    link = material.node_tree.links.new
    if block["metallic"] > 0.0:
        surface = nodes.new("ShaderNodeBsdfPrincipled")
        surface.inputs["Metallic"].default_value = block["metallic"]
        surface.inputs["Roughness"].default_value = block["roughness"]
        color = surface.inputs["Base Color"]
    else:
        surface = nodes.new("ShaderNodeBsdfDiffuse")
        surface.inputs["Roughness"].default_value = 0.0  # Lambert
        color = surface.inputs["Color"]
    color.default_value = (*block["reflectance"], 1.0)
    surface = surface.outputs[0]
    if block["metallic"] == 0.0 and block["index_of_refraction"] > 1.0:
        coat = nodes.new("ShaderNodeBsdfGlossy")
        coat.distribution = "GGX"
        coat.inputs["Roughness"].default_value = block["roughness"]
        fresnel = nodes.new("ShaderNodeFresnel")
        fresnel.inputs["IOR"].default_value = block["index_of_refraction"]
        mix = nodes.new("ShaderNodeMixShader")
        link(fresnel.outputs[0], mix.inputs["Fac"])
        link(surface, mix.inputs[1])
        link(coat.outputs[0], mix.inputs[2])
        surface = mix.outputs[0]
    if "table" in block:
        table = nodes.new("ShaderNodeTexImage")
        table.image = bpy.data.images.load(block["table"])
        table.extension = "EXTEND"
        table.interpolation = "Closest"
        link(table.outputs["Color"], color)
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


def add_environment(environment):
    """Light that varies linearly with the height of the direction, along the axis y."""
    world = bpy.data.worlds.new("World")
    world.use_nodes = True
    nodes = world.node_tree.nodes
    nodes.clear()
    link = world.node_tree.links.new
    direction = nodes.new("ShaderNodeTexCoord")
    axes = nodes.new("ShaderNodeSeparateXYZ")
    height = nodes.new("ShaderNodeMapRange")
    height.inputs["From Min"].default_value = -1.0
    mix = nodes.new("ShaderNodeMixRGB")
    mix.inputs["Color1"].default_value = (*environment["bottom"], 1.0)
    mix.inputs["Color2"].default_value = (*environment["top"], 1.0)
    background = nodes.new("ShaderNodeBackground")
    link(direction.outputs["Generated"], axes.inputs[0])
    link(axes.outputs["Y"], height.inputs["Value"])
    link(height.outputs[0], mix.inputs["Fac"])
    link(mix.outputs[0], background.inputs["Color"])
    link(background.outputs[0], nodes.new("ShaderNodeOutputWorld").inputs["Surface"])
    bpy.context.scene.world = world


def add_camera(camera):
    """A pinhole camera with a vertical angle in degrees."""
    position = Vector(camera["position"])
    back = (position - Vector(camera["focal_point"])).normalized()
    right = Vector(camera["view_up"]).cross(back).normalized()
    axes = Matrix((right, back.cross(right), back)).transposed().to_4x4()
    data = bpy.data.cameras.new("Camera")
    data.sensor_fit = "VERTICAL"
    data.angle_y = math.radians(camera["view_angle"])
    distance = (position - Vector(camera["focal_point"])).length
    data.clip_start, data.clip_end = 1e-3 * distance, 1e3 * distance
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
    scene.render.film_transparent = True  # black where there is nothing
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
    cycles.glossy_bounces = job["reflections"] - 1


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
    add_environment(job["environment"])
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
