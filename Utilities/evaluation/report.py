# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the page: tables, plots and pictures of the results of the studies."""
import math
import textwrap

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from studies import LOOKUPS


def get_title(scene):
    return "Cornell box" if scene == "cornell-box" else scene


def describe_shapes(shapes):
    """What a scene of `cslf scenes` contains."""
    names = [name for name in ("triangles", "spheres", "tubes", "instances")
             if shapes and shapes[name]]
    return ", ".join(f"{count(shapes[name])} {name}" for name in names) or "triangles of a file"


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def paragraph(text):
    """Wrapped to the width of the pages."""
    return textwrap.fill(text, 120, break_long_words=False, break_on_hyphens=False) + "\n"


def count(number):
    return f"{round(number):,}".replace(",", " ")


def megabytes(number):
    return f"{number / 1e6:.2f}"


def compare_seconds(slow, fast):
    """How many times as long one renderer takes for the PSNR of the other's best picture, by the
    line through its two best ones: PSNR over the logarithm of time."""
    near, far = ((math.log(each["seconds"]), each["psnr"]) for each in slow["pictures"][-2:])
    best = fast["pictures"][-1]
    slope = (far[0] - near[0]) / (far[1] - near[1])
    return math.exp(far[0] + slope * (best["psnr"] - far[1])) / best["seconds"]


class Report:
    def __init__(self, tool, setting):
        self.tool = tool
        self.setting = setting

    def plot(self, name, curves, x, y, log=(False, False)):
        """Curves are (label, xs, ys)."""
        beside = len(curves) > 4  # puts the legend there, where it hides no curves
        figure, axes = plt.subplots(figsize=(8.5 if beside else 6, 4), dpi=100)
        for label, xs, ys in curves:
            axes.plot(xs, ys, "o-", markersize=4, label=label)
        axes.set_xlabel(x)
        axes.set_ylabel(y)
        axes.set_xscale("log" if log[0] else "linear")
        axes.set_yscale("log" if log[1] else "linear")
        axes.grid(alpha=0.3)
        if beside:
            axes.legend(fontsize="x-small", loc="upper left", bbox_to_anchor=(1.01, 1))
        else:
            axes.legend(fontsize="x-small")
        figure.tight_layout()
        figure.savefig(self.tool.folder / f"{name}.png")
        plt.close(figure)
        return f"![{y} against {x}]({name}.png)\n"

    def corpus(self, found):
        sampled = []
        drawn = []
        coded = []
        for row in found:
            cells = []
            for field in row["fields"].values():
                cost = field["sampled"]["cost"]
                cells += [f"{field['sampled']['seconds']:.1f} ({cost['cache_seconds']:.1f})",
                          f"{field['measured']['psnr']:.1f}"]
            peak = row["fields"]["good"]["sampled"]["peak_bytes"] / 2**20
            sampled.append([get_title(row["scene"]), describe_shapes(row["shapes"]), *cells,
                            f"{peak:.0f}"])
            lookups = row["drawn"]["lookups"]
            geometry = lookups["geometry"]
            drawn.append([get_title(row["scene"]),
                          *(f"{lookups[name]['psnr']:.1f} ({lookups[name]['lowest_psnr']:.1f})"
                            for name in ("depth", "geometry")),
                          f"{row['drawn']['views']['noise_floor']:.1f}",
                          f"{geometry['frames_per_second']:.1f}",
                          f"{geometry['moving_frames_per_second']:.1f}",
                          f"{geometry['still_frames_per_second']:.1f}"])
            coded.append([get_title(row["scene"]),
                          *(text for kind in row["coded"].values()
                            for text in (megabytes(kind["bytes"]),
                                         f"{kind['geometry']['psnr']:.1f}")),
                          f"{100 * row['coded']['coded'].get('geometry_loss', 0):.1f}"])
        viewpoints, texels, samples = self.setting.scenes
        n = self.setting.resolution(128)
        size = self.setting.size
        return ("## Scenes\n\n" +
                paragraph(f"All scenes that `cslf scenes` lists and the dragon, from {viewpoints} x "
                          f"{viewpoints} viewpoints per face with {n} x {n} texels, as image data. "
                          "Seconds of sampling, with those of the radiance cache in parentheses; "
                          f"PSNR (dB) of {count(texels)} texels against {samples} samples; peak "
                          "memory in good quality.") + "\n" +
                table(["scene", "contains", "preview (s)", "dB", "good (s)", "dB",
                       "memory (MiB)"], sampled) + "\n" +
                paragraph("The same fields in good quality, drawn by "
                          f"{found[0]['drawn']['device']}: mean and lowest PSNR of "
                          f"{found[0]['drawn']['views']['count']} novel views of {size} x {size} "
                          "pixels with the depth lookup and the geometry lookup, the noise floor of "
                          "their reference, and frames per second of the geometry lookup with one "
                          "ray per pixel, while the view moves (30 are asked for, with fewer rays "
                          "if need be), and in still views with four rays per pixel.") + "\n" +
                table(["scene", "depth (dB)", "geometry (dB)", "noise floor (dB)", "one ray",
                       "moving", "still"], drawn) + "\n" +
                paragraph("Coded with rate factor 22 and the preset "
                          f"`{self.setting.preset}`: size and the same novel views with the geometry "
                          "lookup, if the file takes depth from the geometry where it can, and if it "
                          "contains depth; and the share of the texels that the geometry does not "
                          "tell.") + "\n" +
                table(["scene", "MB", "dB", "with depth (MB)", "dB", "lost (%)"], coded))

    def sampling(self, found):
        rows = []
        for scene, fields in found.items():
            for field in fields:
                texels = field["slices"] * 5 * field["resolution"] ** 2
                rows.append([get_title(scene), field["views"], field["resolution"],
                             count(6 * field["views"] ** 2), f"{field['seconds']:.1f}",
                             f"{texels / field['seconds'] / 1e6:.2f}",
                             f"{field['peak_bytes'] / 2**20:.0f}"])
        curves = [(get_title(scene), [field["views"] for field in fields],
                   [field["seconds"] for field in fields]) for scene, fields in found.items()]
        return ("## Sampling\n\n" +
                paragraph("Table 1 of the paper, with 1 536 to 9 600 viewpoints. Each texel gets "
                          "at most 16 samples, and fewer if their standard error falls to 0.004 of "
                          "white.") + "\n" +
                table(["scene", "M", "N", "viewpoints", "seconds", "million texels/s",
                       "peak memory (MiB)"], rows) + "\n" +
                self.plot("sampling", curves, "M", "seconds"))

    def scaling(self, found):
        rows = []
        for field in found:
            strip = 5 * field["resolution"] ** 2
            viewpoints = 6 * field["viewpoints"] ** 2
            texels = field["slices"] * strip
            rows.append([field["viewpoints"], field["resolution"], count(viewpoints),
                         count(field["slices"]), megabytes(6 * viewpoints * strip),
                         f"{field['seconds_of_run']:.0f}",
                         f"{field['processor_seconds']:.0f}",
                         f"{texels / field['processor_seconds'] / 1e6:.2f}",
                         f"{field['peak_bytes'] / 2**20:.0f}", megabytes(field["bytes"])])
        return ("## Scaling\n\n" +
                paragraph("The Cornell box, sampled directly into a coded file, with one sample "
                          "per texel and the preset `ultrafast`. The whole field is never in "
                          "memory. If not all viewpoints are kept, those kept are key views. Raw: "
                          "colour, coverage and depth of all viewpoints. Processor seconds are "
                          "summed over all cores.") + "\n" +
                table(["M", "N", "viewpoints", "kept", "raw (MB)", "seconds", "processor seconds",
                       "million texels per processor second", "peak memory (MiB)", "file (MB)"],
                      rows))

    def sizes(self, found):
        rows = []
        curves = []
        for scene, fields in found.items():
            for field in fields:
                coded = field["coded"]["bytes"]
                rows.append([get_title(scene), field["viewpoints"], field["resolution"],
                             megabytes(field["raw_bytes"]), megabytes(coded),
                             f"{field['raw_bytes'] / coded:.0f}"])
            for n in sorted({field["resolution"] for field in fields}):
                chosen = [field for field in fields if field["resolution"] == n]
                curves.append((f"{get_title(scene)}, N = {n}",
                               [field["viewpoints"] for field in chosen],
                               [field["coded"]["bytes"] / 1e6 for field in chosen]))
        return ("## Size\n\n" +
                paragraph("Figure 3 of the paper. Raw: only colours, with 24 bits each. Coded: "
                          "colour, coverage and depth, with rate factor 22 and the preset "
                          f"`{self.setting.preset}`.") + "\n" +
                table(["scene", "M", "N", "raw (MB)", "coded (MB)", "ratio"], rows) + "\n" +
                self.plot("sizes", curves, "M", "coded (MB)", log=(False, True)))

    def novel_views(self, found):
        rows = [[row["viewpoints"], row["resolution"]] +
                [f"{row['lookups'][lookup]['psnr']:.2f}, {row['lookups'][lookup]['ssim']:.3f}"
                 for lookup in LOOKUPS] for row in found]
        floor = min(row["noise_floor"] for row in found)
        return ("## Novel views\n\n" +
                paragraph("Figure 4 of the paper, which gives no numbers, with two more lookups: "
                          "PSNR (dB) and SSIM of one view of the Cornell box, from uncoded fields. "
                          "The reference is path-traced; its noise floor is "
                          f"{floor:.1f} dB.") + "\n" +
                table(["M", "N", *LOOKUPS], rows) +
                "\n![A row for each field: the reference and the lookups](novel-views.png)\n")

    def key_views(self, found):
        parts = ["## Novel views against size\n\n" +
                 paragraph("The paper's way codes the colour of all viewpoints and looks it up "
                           "bilinearly. Our way codes every second or fourth viewpoint with "
                           "coverage and depth and uses the depth lookup. Both use the same "
                           f"encoder, preset (`{self.setting.preset}`) and rate factors of "
                           "colour.")]
        for scene, result in found.items():
            rows = []
            for each in result["comparisons"]:
                ratio = f"{each['ratio']:.1f}" if each["ratio"] else "not reached"
                rows.append([count(each["bytes"]), f"{each['psnr']:.2f}",
                             ("more than " if each["ratio_is_bound"] else "") + ratio,
                             "no file as small" if each["gain"] is None
                             else f"{each['gain']:.1f}"])
            curves = [(f"{series['name']}, depth's rate factor {rate:g}" if "key" in series["name"]
                       else series["name"],
                       [point["bytes"] for point in series["points"] if point["depth_crf"] == rate],
                       [point["psnr"] for point in series["points"] if point["depth_crf"] == rate])
                      for series in result["series"]
                      for rate in sorted({point["depth_crf"] for point in series["points"]})]
            field = result["series"][0]
            limits = "; ".join(f"{series['name'].replace('paper: ', '')}: "
                               f"{series['uncoded_psnr']:.2f}" for series in result["series"])
            parts.append(
                f"\n{get_title(scene).capitalize()}, M = {field['viewpoints']}, N = "
                f"{field['resolution']}:\n\n" +
                table(["the paper's way (bytes)", "PSNR (dB)", "times fewer bytes at this PSNR",
                       "dB gained at this size"], rows) +
                "\n" + paragraph(f"PSNR (dB) of the uncoded fields: {limits}.") + "\n" +
                self.plot(f"key-views-{scene}", curves, "bytes", "PSNR (dB)", log=(True, False)))
        return "".join(parts)

    def frame_rates(self, found):
        rows = []
        for row in found["fields"]:
            lookups = row["found"]["lookups"]
            rows.append([row["viewpoints"], row["resolution"]] +
                        [f"{lookups[lookup]['frames_per_second']:.1f}"
                         for lookup in ("bilinear", "focal", "depth")] +
                        [f"{lookups['depth']['moving_frames_per_second']:.1f}",
                         f"{lookups['depth']['still_frames_per_second']:.1f}",
                         f"{lookups['depth']['texture_bytes'] / 2**20:.0f}"])
        meshes = []
        for row in found["meshes"]:
            lookups = row["found"]["lookups"]
            meshes.append([count(row["triangles"]),
                           f"{lookups['depth']['mesh_frames_per_second']:.1f}",
                           f"{lookups['bilinear']['frames_per_second']:.1f}",
                           f"{lookups['depth']['frames_per_second']:.1f}"])
        device = found["fields"][0]["found"]["device"]
        curves = [(name, [row["triangles"] for row in found["meshes"]],
                   [pick(row["found"]["lookups"]) for row in found["meshes"]])
                  for name, pick in
                  (("the mesh, by VTK", lambda lookups: lookups["depth"]["mesh_frames_per_second"]),
                   ("bilinear", lambda lookups: lookups["bilinear"]["frames_per_second"]),
                   ("depth", lambda lookups: lookups["depth"]["frames_per_second"]))]
        return ("## Frame rates\n\n" +
                paragraph("Frames per second of 512 x 512 pixels, medians along a camera path, "
                          f"drawn by {device}. All columns use one ray per pixel, except two: "
                          "\"depth, moving\" uses as many rays as 30 frames per second allow, and "
                          "\"depth, still\" four per pixel. The Cornell box:") + "\n" +
                table(["M", "N", "bilinear", "focal", "depth", "depth, moving", "depth, still",
                       "textures, depth (MiB)"], rows) +
                "\n" +
                paragraph("The field of the dragon (M = 9) and its mesh with different numbers of "
                          "triangles, drawn alternately:") + "\n" +
                table(["triangles", "mesh", "bilinear", "depth"], meshes) + "\n" +
                self.plot("frame-rates", curves, "triangles of the mesh", "frames per second",
                          log=(True, False)))

    @staticmethod
    def tell_ratio(result):
        """How many times as long path tracing takes, and from which measurements this follows."""
        *paths, cached = (each["psnr"] for each in result["outcomes"])
        beyond = max(min(paths) - cached, cached - max(paths))
        how = f"extrapolated by {beyond:.1f} dB" if beyond > 0 else "interpolated"
        return f"{result['ratio']:.1f} ({how})"

    def integrators(self, found):
        rows = []
        curves = []
        for scene, result in found.items():
            outcomes = result["outcomes"]
            for each in outcomes:
                name = "cached radiance" if each["name"] == "as told" else each["name"]
                rows.append([get_title(scene), name, f"{each['psnr']:.2f}",
                             f"{each['field_seconds']:.0f}"])
            paths = [each for each in outcomes if each["name"] != "as told"]
            told = outcomes[-1]
            curves.append((f"{get_title(scene)}, path tracing", [e["field_seconds"] for e in paths],
                           [e["psnr"] for e in paths]))
            curves.append((f"{get_title(scene)}, cached radiance", [told["field_seconds"]],
                           [told["psnr"]]))
        ratios = ", ".join(f"{get_title(scene)} {self.tell_ratio(result)}"
                           for scene, result in found.items())
        setting = next(iter(found.values()))
        return ("## Noise against time\n\n" +
                paragraph(f"PSNR of {count(setting['texels'])} texels of a field (M = 17, N = 128) "
                          f"in {setting['views']} of its viewpoints, against a reference of "
                          f"{setting['reference_spp']} samples, and the seconds that sampling the "
                          "whole field takes, extrapolated from these viewpoints. Cached radiance "
                          "takes at most 16 samples, and fewer if their standard error falls to "
                          "0.004 of white. Each was measured once.") + "\n" +
                table(["scene", "integrator", "PSNR (dB)", "seconds"], rows) +
                "\n" +
                paragraph("To reach the PSNR of cached radiance, path tracing takes longer by "
                          f"these factors: {ratios}. "
                          "[Performance](../Performance.md#speed-at-equal-quality) compares other "
                          "viewpoints with more samples of path tracing.") + "\n" +
                self.plot("integrators", curves, "seconds", "PSNR (dB)", log=(True, False)))

    def cycles(self, found):
        first = next(iter(found.values()))
        width, height = first["size"]
        ratios = ", ".join(
            f"{get_title(scene)} {compare_seconds(result['cycles'], result['path']):.1f}"
            for scene, result in found.items())
        return ("## Noise against time, compared with Cycles\n\n" +
                paragraph(
                    f"One picture of three scenes, {width} x {height} pixels, by "
                    "`vtkCSLFViewTracer` and by Cycles of Blender "
                    f"{first['cycles']['version']}, both on the processor. Surfaces, materials, "
                    "light and camera are the same, with at most "
                    f"{first['reflections']} reflections and a box filter of one pixel. Cycles "
                    "uses neither denoising nor adaptive sampling nor clamping. The lamp of the "
                    "Cornell box is cut into 4 x 4 parts, because Cycles makes the light of large "
                    "triangles too dark close to their plane. Glossy materials of the assembly "
                    "are those of Blender's Principled BSDF, whose diffuse part differs from "
                    "ours.") + "\n" +
                paragraph(
                    "PSNR is that of displayed colours. The reference is the mean of two pictures "
                    f"with {first['reference'] // 2} samples by the same renderer. Radiance "
                    "caching has a bias, so its reference is that of path tracing. Seconds are "
                    "medians of three. Ours do not include building the scene; those of Cycles "
                    "are of Blender's render call. The cache serves all views.") + "\n" +
                paragraph("To reach the PSNR of path tracing with its most samples, Cycles takes "
                          f"longer by these factors: {ratios}.") + "\n" +
                "\n".join(self.tell_renderers(scene, result) for scene, result in found.items()))

    def tell_renderers(self, scene, found):
        """One scene of the comparison with Cycles."""
        rows = []
        curves = []
        for name, label in (("path", "path tracing"), ("cycles", "Cycles"),
                            ("cache", "cached radiance")):
            cache = found[name].get("cache_seconds", 0)
            pictures = found[name]["pictures"]
            for each in pictures:
                rows.append([label, each["samples"], f"{cache:.1f}" if cache else "",
                             f"{each['seconds']:.3f}", f"{each['psnr']:.2f}"])
            curves.append((label, [cache + each["seconds"] for each in pictures],
                           [each["psnr"] for each in pictures]))
        agreement = found["agreement"]
        noise = -10 * math.log10(sum(10 ** (-found[name]["reference_psnr"] / 10)
                                     for name in ("path", "cycles")))
        channels = ", ".join(f"{other / ours - 1:+.3%}" for ours, other in
                             zip(agreement["radiance_path"], agreement["radiance_cycles"]))
        title = get_title(scene)
        return (f"### {title[0].upper()}{title[1:]}\n\n" +
                table(["renderer", "samples", "cache (s)", "picture (s)", "PSNR (dB)"], rows) +
                "\n" + self.plot(f"cycles-{scene}", curves, "seconds, with the cache",
                                 "PSNR (dB)", log=(True, False)) +
                "\n" +
                paragraph(
                    "The two converged pictures and 16 times their difference (grey: no "
                    f"difference). Their PSNR is {agreement['psnr']:.2f} dB; noise alone would "
                    f"give {noise:.2f} dB. The mean radiance of Cycles, clamped at white, differs "
                    f"by {channels} (red, green, blue). The means of squares of 16 x 16 pixels "
                    "differ by at most "
                    f"{255 * agreement['largest_difference_of_squares']:.2f} of 255.") + "\n" +
                f"![Path tracing, Cycles and their difference](cycles-{scene}-pictures.png)\n")

    def limits(self, found):
        parts = ["## Known weaknesses\n"]
        for row in found:
            figures = ", ".join(f"{lookup} {values['psnr']:.2f} dB"
                                for lookup, values in row["found"]["lookups"].items())
            parts.append(
                "\n" +
                paragraph(f"{row['title'][0].upper()}{row['title'][1:]} (M = {row['viewpoints']}, "
                          f"N = {row['resolution']}): {figures}.") +
                f"\n![The reference and the lookups](limits-{row['name']}.png)\n")
        return "".join(parts)
