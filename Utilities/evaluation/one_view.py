# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""One view of a scene by our integrators and by Blender's Cycles: how much noise remains after how
many seconds, and whether both converge to the same picture.

All use a scene of vtkCSLFSceneSource and the cameras defined here. Pictures are linear.
"""
import json
import math
import statistics
import time
from pathlib import Path

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkRenderingCore import vtkCamera

import cslf
from pictures import make_linear, psnr, read, show, write
from tool import run_program

# The box fills the picture. Angles are vertical, in degrees.
BOX_CAMERA = {"position": (0.35, 0.2, 3.1), "focal_point": (0.0, 0.0, 0.0),
              "view_up": (0.0, 1.0, 0.0), "view_angle": 40.0}
DIRECTION = (0.5, 0.45, 0.74)  # of the camera of other scenes, from their centre
REFLECTIONS = 8         # of the longest path
NOISY_SEED = 0
HALF_SEEDS = (1, 2)     # of the halves of a converged picture
REPEATS = 3             # of noisy pictures: seconds are medians
SQUARE = 16             # pixels along each side of the squares whose means are compared
SCRIPT = Path(__file__).with_name("render_cycles.py")


class OneView:
    """`scene` is a name that vtkCSLFSceneSource knows, `size` is (width, height). Noisy pictures
    have `counts` samples per pixel. The converged ones of path tracing and Cycles have
    `reference`."""

    def __init__(self, tool, scene, size, counts, reference):
        self.tool = tool
        self.scene = scene
        self.size = size
        self.counts = counts
        self.reference = reference
        self.source = cslf.vtkCSLFSceneSource()
        self.source.SetSceneName(scene)
        self.source.Update()
        self.camera = BOX_CAMERA if scene == "cornell-box" else self.make_camera()

    def measure(self):
        def keep(name, measure, output=None):
            return self.tool.keep(f"cycles-{self.scene}-{name}", measure, output)
        return {"size": self.size, "reference": self.reference, "reflections": REFLECTIONS,
                "path": keep("path", self.measure_path, self.converged("path")),
                "cycles": keep("blender", self.measure_cycles, self.converged("cycles")),
                "cache": keep("cache", self.measure_cache),
                "agreement": keep("agreement", self.compare,
                                  self.tool.folder / f"cycles-{self.scene}-pictures.png")}

    def make_camera(self):
        """From where the scene's sphere fits into the picture."""
        bounds = [0.0] * 6
        self.source.GetOutput().GetBounds(bounds)
        low, high = numpy.array(bounds[::2]), numpy.array(bounds[1::2])
        center = (low + high) / 2
        distance = numpy.linalg.norm(high - low) / 2 / math.sin(math.radians(20))
        direction = numpy.array(DIRECTION) / numpy.linalg.norm(DIRECTION)
        return {"position": (center + distance * direction).tolist(),
                "focal_point": center.tolist(), "view_up": (0.0, 1.0, 0.0), "view_angle": 40.0}

    def converged(self, renderer):
        """The file of a converged picture."""
        return self.tool.work / f"one-view-{self.scene}-{renderer}.exr"

    def measure_path(self):
        tracer = self.make_tracer()
        self.trace(tracer, 1, NOISY_SEED)  # builds the scene
        return self.judge("path", [(*self.trace(tracer, samples, seed), samples)
                                   for samples, seed in self.list_pictures()])

    def measure_cycles(self):
        pictures = [{"samples": samples, "seed": seed,
                     "file": str(self.tool.work / f"one-view-{self.scene}-cycles-{k}.exr")}
                    for k, (samples, seed) in enumerate(self.list_pictures())]
        job = self.tool.work / "one-view-job.json"
        job.write_text(json.dumps({
            "size": self.size, "camera": self.camera, "reflections": REFLECTIONS,
            "environment": self.describe_environment(), "blocks": self.describe_blocks(), "pictures": pictures}))
        found = self.tool.work / "one-view-found.json"
        found.unlink(missing_ok=True)
        run_program("blender", "--background", "--factory-startup", "--python-exit-code", 1,
                    "--python", SCRIPT, "--", job, found)
        found = json.loads(found.read_text())
        return {"version": found["version"],
                **self.judge("cycles", [(read(picture["file"]), seconds, picture["samples"])
                                        for picture, seconds in zip(pictures, found["seconds"])])}

    def measure_cache(self):
        """Compares with the converged picture of path tracing, because the cache has a bias."""
        tracer = self.make_tracer()
        tracer.SetIntegratorToRadianceCaching()
        self.trace(tracer, 1, NOISY_SEED)
        cache_seconds = tracer.GetCacheSeconds()
        noisy = [(*self.trace(tracer, samples, NOISY_SEED), samples)
                 for samples in self.counts for _ in range(REPEATS)]
        return {"cache_seconds": cache_seconds,
                "pictures": self.judge_noisy(noisy, show(read(self.converged("path"))))}

    def list_pictures(self):
        """Samples and seeds: the converged picture's halves first."""
        return ([(self.reference // 2, seed) for seed in HALF_SEEDS] +
                [(count, NOISY_SEED) for count in self.counts for _ in range(REPEATS)])

    def judge(self, renderer, pictures):
        """`pictures` are (picture, seconds, samples), in the order of list_pictures."""
        first, second = (picture for picture, _, _ in pictures[:2])
        truth = (first + second) / 2
        write(self.converged(renderer), truth)
        return {"reference_seconds": pictures[0][1] + pictures[1][1],
                # The squared error of the mean is a quarter of the halves' squared difference.
                "reference_psnr": psnr(show(first), show(second)) + 10 * math.log10(4),
                "pictures": self.judge_noisy(pictures[2:], show(truth))}

    def judge_noisy(self, pictures, truth):
        found = []
        for k in range(0, len(pictures), REPEATS):
            picture, _, samples = pictures[k]
            seconds = statistics.median(each[1] for each in pictures[k:k + REPEATS])
            found.append({"samples": samples, "seconds": seconds,
                          "psnr": psnr(show(picture), truth)})
        return found

    def compare(self):
        """Measures how much the converged pictures differ, and draws this for the page."""
        path, cycles = (read(self.converged(renderer)) for renderer in ("path", "cycles"))
        difference = show(cycles) - show(path)
        gap = numpy.ones((len(path), 4, 3))
        write(self.tool.folder / f"cycles-{self.scene}-pictures.png", numpy.concatenate(
            [show(path), gap, show(cycles), gap, numpy.clip(0.5 + 16 * difference, 0, 1)], axis=1))
        radiance, other = (numpy.clip(picture, 0, 1).mean(axis=(0, 1))
                           for picture in (path, cycles))
        return {"psnr": psnr(show(cycles), show(path)),
                "radiance_path": radiance.tolist(), "radiance_cycles": other.tolist(),
                "largest_difference_of_squares": float(numpy.abs(average(difference)).max())}

    def make_tracer(self):
        camera = vtkCamera()
        camera.SetPosition(self.camera["position"])
        camera.SetFocalPoint(self.camera["focal_point"])
        camera.SetViewUp(self.camera["view_up"])
        camera.SetViewAngle(self.camera["view_angle"])
        tracer = cslf.vtkCSLFViewTracer()
        tracer.SetInputConnection(self.source.GetOutputPort())
        self.source.SetUpEnvironment(tracer.GetEnvironment())
        tracer.SetMaximumDepth(REFLECTIONS)
        tracer.SetColorTypeToFloat()
        tracer.SetCamera(camera)
        tracer.SetSize(*self.size)
        return tracer

    def trace(self, tracer, samples, seed):
        """Returns the picture and the seconds it took."""
        tracer.SetSamples(samples)
        tracer.SetSeed(seed)
        tracer.Modified()
        begin = time.monotonic()
        tracer.Update()
        seconds = time.monotonic() - begin
        colors = vtk_to_numpy(tracer.GetOutput().GetPointData().GetArray("Color"))
        width, height = self.size
        return colors.reshape(height, width, 4)[::-1, :, :3].astype(float), seconds

    def describe_environment(self):
        """The linear radiance from below and from above."""
        environment = cslf.vtkCSLFEnvironment()
        self.source.SetUpEnvironment(environment)
        kinds = cslf.vtkCSLFEnvironment
        top, bottom = (environment.GetIntensity() * make_linear(numpy.array(color))
                       for color in (environment.GetColor(), environment.GetBottomColor()))
        mode = environment.GetMode()
        return {"top": (0 * top if mode == kinds.NoEnvironment else top).tolist(),
                "bottom": (0 * top if mode == kinds.NoEnvironment
                           else top if mode == kinds.ConstantEnvironment
                           else bottom).tolist()}

    def describe_blocks(self):
        """The scene in the form that render_cycles.py reads."""
        material = cslf.vtkCSLFMaterial
        data = self.source.GetOutput()
        blocks = []
        for k in range(data.GetNumberOfBlocks()):
            block = data.GetBlock(k)
            corners = vtk_to_numpy(block.GetPolys().GetConnectivityArray())
            ends = vtk_to_numpy(block.GetPolys().GetOffsetsArray())[1:-1]
            color = [0.0, 0.0, 0.0]
            emission = [0.0, 0.0, 0.0]
            material.GetBaseColor(block, color)
            material.GetEmission(block, emission)
            reflectance = make_linear(numpy.array(color))
            points = block.GetPointData()
            described = {"name": f"block {k}",
                         "points": vtk_to_numpy(block.GetPoints().GetData()).tolist(),
                         "polygons": [each.tolist() for each in numpy.split(corners, ends)],
                         "reflectance": reflectance.tolist(), "emission": emission,
                         "metallic": material.GetMetallic(block),
                         "roughness": material.GetRoughness(block),
                         "index_of_refraction": material.GetIndexOfRefraction(block)}
            if points.GetNormals():
                described["normals"] = vtk_to_numpy(points.GetNormals()).tolist()
            if points.GetTCoords():
                described["table"] = self.write_table(block, k)
                described["coordinates"] = vtk_to_numpy(points.GetTCoords()).tolist()
            blocks.append(described)
        return blocks

    def write_table(self, block, number):
        """Writes a block's texture of base colours to a PNG file."""
        fields = block.GetFieldData()
        name = cslf.vtkCSLFMaterial.BaseColorName() + "Texture"
        width, height = (int(fields.GetArray(name + "Layout").GetComponent(0, k)) for k in (0, 1))
        pixels = vtk_to_numpy(fields.GetArray(name))[:, :3].reshape(height, width, 3) / 255
        file = self.tool.work / f"one-view-{self.scene}-table-{number}.png"
        write(file, pixels[::-1])
        return str(file)


def average(picture):
    """The means of squares of pixels, without incomplete squares."""
    rows, columns = (length // SQUARE for length in picture.shape[:2])
    whole = picture[:rows * SQUARE, :columns * SQUARE]
    return whole.reshape(rows, SQUARE, columns, SQUARE, 3).mean(axis=(1, 3))
