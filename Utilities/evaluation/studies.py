# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The measurements. Each study returns the data for its part of the page."""
import dataclasses
import shutil

from PIL import Image
import vtkmodules.vtkFiltersCore as filters
import vtkmodules.vtkFiltersModeling as modeling
import vtkmodules.vtkIOPLY as ply
import vtkmodules.vtkIOXML as xml
import vtkmodules.vtkCommonCore as core
import vtkmodules.vtkFiltersSources as sources

LOOKUPS = ("nearest", "linear", "bilinear", "focal", "depth")
LONGEST_SIDE = 1800     # of the sheet of novel views, in pixels
QUALITY = ("--spp", 16, "--noise", 0.004)


@dataclasses.dataclass
class Setting:
    """The sizes of fields and pictures, and the samples of the references. The paper's resolutions
    are divided by `divisor`."""
    divisor: int
    size: int           # of novel views, in pixels
    views: int
    spp: int            # samples per pixel of the reference
    frames: int         # along a path
    key_viewpoints: int
    crfs: str
    depth_crfs: str
    preset: str
    reference_spp: int
    scaling: tuple      # viewpoints, resolutions and steps of key views
    one_view: dict      # arguments of OneView, except for the scene
    scenes: tuple       # viewpoints, texels to measure and samples of their reference

    def resolution(self, of_paper):
        return of_paper // self.divisor

    def fine_resolution(self):
        """For studies that depend on the scene's details: 64 in small settings."""
        return 128 if self.divisor == 1 else 64


FULL = Setting(divisor=1, size=512, views=6, spp=1024, frames=72, key_viewpoints=17,
               crfs="16,22,28,34,40", depth_crfs="8,12", preset="fast", reference_spp=4096,
               scaling=((16, 128, 1), (32, 128, 1), (32, 256, 1), (64, 512, 4)),
               one_view={"size": (448, 336), "counts": (1, 4, 16, 64), "reference": 1024},
               scenes=(9, 20000, 1024))
QUICK = Setting(divisor=4, size=256, views=2, spp=128, frames=12, key_viewpoints=9,
                crfs="16,28,40", depth_crfs="8", preset="veryfast", reference_spp=256,
                scaling=((8, 32, 1), (16, 64, 1), (32, 128, 4)),
                one_view={"size": (128, 96), "counts": (1, 4, 16), "reference": 512},
                scenes=(3, 1000, 64))


class Studies:
    def __init__(self, tool, setting, data, names=()):
        self.tool = tool
        self.setting = setting
        self.truth = ("--truth", tool.work / "truth")
        self.scenes = {
            "cornell-box": ("cornell-box",),
            "dragon": (data / "dragon.ply", "--roughness", 0.3, "--environment", "white")}
        self.names = names
        self.compared = {name: self.get_inputs(name) for name in names or self.scenes}
        self.mirror = (data / "dragon.ply", "--roughness", 0.05, "--environment", "white")

    def get_inputs(self, scene):
        return self.scenes.get(scene, (scene,))

    def sample(self, scene, viewpoints, resolution, inputs=None, integrator="cache"):
        """Returns the field's file and the measurements of its sampling."""
        name = f"{scene}-{viewpoints}x{resolution}" + ("" if integrator == "cache" else "-path")
        file = self.tool.work / f"{name}.vti"
        return file, self.tool.measure(
            f"sample-{name}", "sample", *(inputs or self.get_inputs(scene)), "-M", viewpoints, "-N",
            resolution, *QUALITY, "--integrator", integrator, "-o", file, output=file)

    def evaluate(self, name, field, scene, *options, output, inputs=None, views=None):
        setting = self.setting
        return self.tool.measure(
            f"evaluate-{name}", "evaluate", field, *(inputs or self.get_inputs(scene)), "--views",
            views or setting.views, "--size", setting.size, "--spp", setting.spp, *self.truth,
            *options, output=output)

    # Every scene of the tool and the dragon: both qualities, and the better one coded and drawn.
    def corpus(self):
        known = {scene["name"]: scene for scene in self.tool.ask("scenes")["scenes"]}
        rows = []
        for scene in self.names or (*known, "dragon"):
            fields = {quality: self.measure_quality(scene, quality)
                      for quality in ("preview", "good")}
            field = self.get_corpus_field(scene, "good")
            coded = {kind: self.measure_coded(scene, field, kind, *options)
                     for kind, options in (("coded", ()),
                                           ("with-depth", ("--no-depth-from-geometry",)))}
            drawn = self.tool.measure_in_lab(
                f"corpus-{scene}-drawn", "render", field, "--scene",
                *self.get_inputs(scene), "-o", self.tool.work / f"corpus-{scene}", "--frames",
                self.setting.frames // 3, "--size", self.setting.size, "--views", 3, "--spp", 128,
                "--lookups", "depth,geometry", *self.truth)
            rows.append({"scene": scene, "shapes": known.get(scene), "fields": fields,
                         "coded": coded, "drawn": drawn})
        return rows

    def measure_coded(self, scene, field, kind, *options):
        file = field.with_name(f"{field.stem}-{kind}.mp4")
        coded = self.tool.measure(f"corpus-{scene}-{kind}", "encode", field, "-o", file,
                                  "--preset", self.setting.preset, *options, output=file)
        views = self.tool.measure(f"corpus-{scene}-{kind}-views", "evaluate", file,
                                  *self.get_inputs(scene), "--size", self.setting.size, "--views",
                                  3, "--spp", 128, "--lookups", "geometry", *self.truth)
        return {**coded, "geometry": views["lookups"]["geometry"]}

    def get_corpus_field(self, scene, quality):
        return self.tool.work / f"corpus-{scene}-{quality}.vti"

    def measure_quality(self, scene, quality):
        viewpoints, texels, samples = self.setting.scenes
        file = self.get_corpus_field(scene, quality)
        inputs = self.get_inputs(scene)
        field = self.tool.measure(
            f"corpus-{scene}-{quality}", "sample", *inputs, "-M", viewpoints, "-N",
            self.setting.resolution(128), "--quality", quality, "-o", file, output=file)
        measured = self.tool.measure_in_lab(
            f"corpus-{scene}-{quality}-texels", "evaluate-texels", file, *inputs, "--texels",
            texels, "--reference-spp", samples)
        return {"sampled": field, "measured": measured}

    # The paper's table 1.
    def sampling(self):
        n = self.setting.resolution(128)
        return {scene: [self.sample(scene, m, n)[1] for m in (16, 32, 40)]
                for scene in self.compared}

    # Time and memory of fields that become larger than memory, with one sample per texel.
    def scaling(self):
        rows = []
        for m, n, step in self.setting.scaling:
            file = self.tool.work / f"scaling-{m}x{n}.mp4"
            row = self.tool.measure(
                f"scaling-{m}x{n}", "sample", *self.scenes["cornell-box"], "-M", m, "-N", n,
                "--spp", 1, "--key-views", step, "--preset", "ultrafast", "--no-restart",
                "-o", file)
            rows.append({**row, "viewpoints": m})
            file.unlink(missing_ok=True)
        return rows

    # The paper's figure 3.
    def sizes(self):
        found = {scene: [] for scene in self.compared}
        for scene in self.compared:
            for m in (16, 32, 40):
                field = self.sample(scene, m, self.setting.resolution(128))[0]
                for divisor in (1, 2):
                    n = self.setting.resolution(128) // divisor
                    small = field
                    if divisor > 1:
                        small = self.tool.work / f"{scene}-{m}x{n}-of-{n * divisor}.vti"
                        if not small.exists():
                            self.tool.run("resample", field, "-o", small,
                                          "--resolution-divisor", divisor)
                    file = self.tool.work / f"{scene}-{m}x{n}.mp4"
                    coded = self.tool.measure(f"encode-{scene}-{m}x{n}", "encode", small, "-o",
                                              file, "--preset", self.setting.preset, output=file)
                    found[scene].append({"viewpoints": m, "resolution": n, "coded": coded,
                                         "raw_bytes": 6 * m * m * 5 * n * n * 3})
        return found

    # The paper's figure 4, with two more lookups.
    def novel_views(self):
        rows = []
        pictures = []
        labels = []
        for m, n in ((40, 128), (40, 64), (32, 256), (32, 128), (32, 64), (16, 256), (16, 128)):
            n = self.setting.resolution(n)
            folder = self.tool.work / f"novel-{m}x{n}"
            field = self.sample("cornell-box", m, n)[0]
            found = self.evaluate(f"novel-{m}x{n}", field, "cornell-box", "-o", folder,
                                  output=folder / "view-0-truth.png", views=1)
            rows.append({"viewpoints": m, "resolution": n, "lookups": found["lookups"],
                         "noise_floor": found["noise_floor"]})
            pictures.append(folder / "view-0-truth.png")
            labels += ["--label", "reference"]
            for lookup in LOOKUPS:
                pictures.append(folder / f"view-0-{lookup}.png")
                labels += ["--label",
                           f"{m} x {n} {lookup} {found['lookups'][lookup]['psnr']:.1f} dB"]
        sheet = self.tool.work / "novel-views.png"
        self.tool.run("sheet", *pictures, "-o", sheet, "--columns", 1 + len(LOOKUPS), *labels)
        shrink(sheet, self.tool.folder / "novel-views.png")
        return rows

    # Novel views against size: the paper's way and ours.
    def key_views(self):
        found = {}
        setting = self.setting
        for scene, inputs in self.compared.items():
            field = self.sample(scene, setting.key_viewpoints, setting.fine_resolution())[0]
            folder = self.tool.work / f"key-views-{scene}"
            shutil.rmtree(folder, ignore_errors=True)  # may be left by an interrupted run
            found[scene] = self.tool.measure_in_lab(
                f"key-views-{scene}", "key-views", field, *inputs, "-o", folder,
                "--preset", setting.preset, "--crfs", setting.crfs, "--depth-crfs",
                setting.depth_crfs, "--steps", "2,4", "--divisors", "1,2", "--views", setting.views,
                "--size", setting.size, "--spp", setting.spp, *self.truth)
        return found

    # Frames per second against M, N and the number of triangles.
    def frame_rates(self):
        rows = []
        n = self.setting.resolution(128)
        for m, n in ((9, n), (17, n), (40, n), (9, 2 * n), (9, n // 2)):
            field = self.sample("cornell-box", m, n)[0]
            folder = self.tool.work / f"render-{m}x{n}"
            found = self.tool.measure_in_lab(
                f"render-cornell-box-{m}x{n}", "render", field, "-o", folder,
                "--scene", "cornell-box", "--frames", self.setting.frames, "--size", 512,
                "--views", 1, "--spp", 2, "--lookups", "bilinear,focal,depth")
            rows.append({"viewpoints": m, "resolution": n, "found": found})
        meshes = []
        field = self.sample("dragon", 9, self.setting.resolution(128))[0]
        for mesh, triangles in self.make_meshes():
            found = self.tool.measure_in_lab(
                f"render-dragon-{triangles}", "render", field, "-o",
                self.tool.work / f"render-dragon-{triangles}", "--frames", self.setting.frames,
                "--size", 512, "--mesh", mesh, "--lookups", "bilinear,depth")
            meshes.append({"triangles": triangles, "found": found})
        return {"fields": rows, "meshes": meshes}

    def make_meshes(self):
        """The dragon's mesh as it is, and with its triangles divided twice and three times."""
        reader = ply.vtkPLYReader()
        reader.SetFileName(str(self.scenes["dragon"][0]))
        for passes in (0, 2, 3):
            cut = modeling.vtkAdaptiveSubdivisionFilter()
            cut.SetInputConnection(reader.GetOutputPort())
            cut.SetMaximumNumberOfPasses(passes)
            cut.SetMaximumEdgeLength(1e-9)
            cut.SetMaximumTriangleArea(1e-18)
            last = cut if passes else reader
            last.Update()
            file = self.tool.work / f"dragon-{passes}.ply"
            writer = ply.vtkPLYWriter()
            writer.SetFileName(str(file))
            writer.SetInputConnection(last.GetOutputPort())
            writer.Write()
            yield file, last.GetOutput().GetNumberOfPolys()

    # Quality against time of path tracing and cached radiance.
    def integrators(self):
        setting = self.setting
        return {scene: self.tool.measure_in_lab(
            f"integrators-{scene}", "sampler", *inputs, "-M", 17, "-N", 128,
            "--reference-spp", setting.reference_spp, "--path-spp", "4,16,64", "--views", 12,
            "--texels", 100000 // setting.divisor ** 2, *QUALITY)
            for scene, inputs in self.compared.items()}

    # The same compared with an independent renderer.
    def cycles(self):
        from one_view import OneView  # only this study needs the Python package and Blender
        return {scene: OneView(self.tool, scene, **self.setting.one_view).measure()
                for scene in ("cornell-box", "isosurfaces", "assembly")}

    # Known weaknesses.
    def limits(self):
        n = self.setting.fine_resolution()
        wires = self.tool.work / "wires.vtp"
        make_wires(wires)
        wires = (wires, "--environment", "white")
        # Caching radiance on wires takes longer than path tracing.
        cases = (("mirror", "a dragon of roughness 0.05", 9, self.mirror, "cache"),
                 ("wires", "tubes thinner than a texel in front of a wall, path-traced", 9, wires,
                  "path"),
                 ("few", "the Cornell box from 3 x 3 viewpoints", 3, None, "cache"))
        rows = []
        for name, title, m, inputs, integrator in cases:
            scene = "cornell-box" if inputs is None else name
            field = self.sample(scene, m, n, inputs, integrator)[0]
            sheet = self.tool.folder / f"limits-{name}.png"
            found = self.evaluate(f"limits-{name}", field, scene, "--contact-sheet", sheet,
                                  "--lookups", "bilinear,focal,depth", output=sheet, inputs=inputs,
                                  views=2)
            rows.append({"name": name, "title": title, "viewpoints": m, "resolution": n,
                         "found": found})
        return rows


def shrink(sheet, file):
    """Makes a sheet small enough for the page, with labels that can still be read."""
    with Image.open(sheet) as picture:
        small = picture.convert("RGB")
    small.thumbnail((LONGEST_SIDE, LONGEST_SIDE), Image.LANCZOS)
    small.save(file, optimize=True)


def make_wires(file):
    """28 coloured tubes at random places in front of a wall."""
    random = core.vtkMinimalStandardRandomSequence()
    random.SetSeed(3)

    def draw(low, high):
        random.Next()
        return random.GetRangeValue(low, high)

    append = filters.vtkAppendPolyData()
    wall = sources.vtkPlaneSource()
    wall.SetOrigin(-1, -1, -1)
    wall.SetPoint1(1, -1, -1)
    wall.SetPoint2(-1, 1, -1)
    append.AddInputData(colour(wall, (90, 140, 220)))
    colours = ((230, 60, 40), (240, 220, 60), (40, 200, 80), (250, 250, 250))
    for k in range(28):
        line = sources.vtkLineSource()
        line.SetPoint1(*(draw(-0.95, 0.95) for _ in range(3)))
        line.SetPoint2(*(draw(-0.95, 0.95) for _ in range(3)))
        tube = filters.vtkTubeFilter()
        tube.SetInputConnection(line.GetOutputPort())
        tube.SetRadius((0.004, 0.008, 0.015)[k % 3])
        tube.SetNumberOfSides(10)
        append.AddInputData(colour(tube, colours[k % 4]))
    writer = xml.vtkXMLPolyDataWriter()
    writer.SetFileName(str(file))
    writer.SetDataModeToBinary()
    writer.SetInputConnection(append.GetOutputPort())
    writer.Write()


def colour(source, rgb):
    source.Update()
    mesh = source.GetOutput()
    mesh.GetPointData().Initialize()
    colours = core.vtkUnsignedCharArray()
    colours.SetName("Colors")
    colours.SetNumberOfComponents(3)
    for _ in range(mesh.GetNumberOfPoints()):
        colours.InsertNextTuple3(*rgb)
    mesh.GetPointData().SetScalars(colours)
    return mesh
