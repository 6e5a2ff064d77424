#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Checks which folders include which, in one direction only, and which libraries they use.

usage: check_layers.py SOURCE_FOLDER
"""
import pathlib
import re
import sys

ROOTS = ("Module", "Filters", "Rendering", "Applications")

# Each layer, with the layers whose headers it may include. A layer is a folder with its subfolders.
# The classes of Filters itself, such as vtkCSLFEncoder, combine these layers and are not checked.
LAYERS = {
    "Module": [],
    "Filters/SIMD": [],
    "Filters/Options": [],
    "Filters/Images": ["Module"],
    "Filters/Files": ["Module", "Filters/Images"],
    "Filters/RandomNumbers": ["Module", "Filters/SIMD"],
    "Filters/Parallel": ["Module"],
    "Filters/Pipeline": ["Module"],
    "Filters/Resampling": ["Module"],
    "Filters/Lookup": ["Module"],
    "Filters/Quality": ["Module", "Filters/RandomNumbers"],
    "Filters/Geometry": ["Module", "Filters/SIMD", "Filters/Pipeline"],
    "Filters/Coding": ["Module", "Filters/SIMD", "Filters/Files", "Filters/Parallel",
        "Filters/Pipeline", "Filters/Resampling", "Filters/Lookup", "Filters/Quality",
        "Filters/Geometry"],
    "Filters/Certificate": ["Module", "Filters/RandomNumbers", "Filters/Pipeline", "Filters/Lookup",
        "Filters/Coding"],
    "Filters/PathTracing/Materials": ["Module", "Filters/SIMD", "Filters/RandomNumbers",
        "Filters/Files"],
    "Filters/SceneData": ["Module", "Filters/Options", "Filters/Pipeline",
        "Filters/PathTracing/Materials"],
    "Filters/PathTracing": ["Module", "Filters/SIMD", "Filters/Options", "Filters/RandomNumbers",
        "Filters/Images", "Filters/Files", "Filters/Parallel", "Filters/Pipeline",
        "Filters/Quality", "Filters/Geometry", "Filters/SceneData", "Filters/PathTracing/Materials"],
    "Filters/CubeMaps": ["Module", "Filters/Images", "Filters/Files", "Filters/Pipeline"],
    "Filters/SceneImport": ["Module", "Filters/Pipeline", "Filters/SceneData"],
    "Filters/GLTF": ["Module", "Filters/Files", "Filters/SceneData", "Filters/SceneImport"],
    "Filters/SceneLook": ["Module"],
    "Filters/Scenes": [],
    "Filters/Planning": ["Module", "Filters/Options", "Filters/Files", "Filters/Pipeline",
        "Filters/Coding", "Filters/CubeMaps"],
    "Rendering": ["Module", "Filters/Options", "Filters/Pipeline", "Filters/Lookup"],
    "Rendering/Export": ["Module", "Filters/Options", "Filters/Files", "Filters/Pipeline",
        "Filters/Coding", "Filters/SceneLook", "Rendering"],
}

# Classes of Filters itself that single layers may use.
CLASSES = {
    "Filters/Planning": {"vtkCSLFEncoder.h", "vtkCSLFRadianceCacheOptions.h",
        "vtkCSLFRateControl.h", "vtkCSLFSampler.h"},
}

# Folders whose headers are included by their names alone, because they hold public classes.
PUBLIC = (*ROOTS, "Filters/Planning", "Filters/SceneData", "Rendering/Export")

# Libraries, and the layers that may include their headers. VTK's data arrays are used everywhere.
LIBRARIES = {
    r"embree": ["Filters/PathTracing"],
    r"(GL|OpenGL)/glu": ["Filters/Pipeline"],
    r"meshoptimizer": ["Filters/Geometry", "Filters/Coding", "Rendering", "Rendering/Export"],
    r"OpenImageIO": ["Filters/Images"],
    r"libav|libsw": ["Filters/Coding"],
    r"vtkOpenGL(?!Sphere|Stick)|vtk_gl|glad": ["Rendering"],
    r"vtk(?!AbstractArray|DataArray|FieldData|ImageData|New|PointData|SmartPointer|StringArray|Type)":
        [layer for layer in LAYERS if layer != "Module"],
}


def layer_of(folder):
    """The layer that contains a folder, or None for the classes of Filters."""
    while folder != ".":
        if folder in LAYERS:
            return folder
        folder = str(pathlib.PurePath(folder).parent)
    return None


def find_header(source, file, name):
    """The path of an included header of ours below the source folder, or None."""
    for folder in [file.parent, *(source / public for public in PUBLIC)]:
        if (folder / name).is_file():
            return (folder / name).resolve().relative_to(source)
    return None


def check_own(source, file, layer, name):
    """What is wrong with the include of a header of ours, or None."""
    header = find_header(source, file, name)
    if header is None or header.name in CLASSES.get(layer, ()):
        return None
    other = layer_of(str(header.parent))
    if other is None:
        return f"includes {header}, which is above it"
    if other != layer and other not in LAYERS[layer]:
        return f"includes {header}, but {layer} does not build on {other}"
    return None


def check_library(layer, name):
    """What is wrong with the include of a header of a library, or None."""
    for pattern, layers in LIBRARIES.items():
        if re.match(pattern, name) and layer not in layers:
            return f"includes {name}, but {layer} does not use that library"
    return None


def read_includes(source):
    """The files, with each of their includes: the name, and whether it is in quotation marks."""
    for root in ROOTS:
        for file in sorted((source / root).rglob("*")):
            if file.suffix in (".h", ".cxx"):
                for line in file.read_text(encoding="utf-8").splitlines():
                    include = re.match(r'#\s*include\s*(["<])([^">]+)', line)
                    if include:
                        yield file, include[2], include[1] == '"'


def find_faults(source):
    for file, name, is_own in read_includes(source):
        layer = layer_of(str(file.parent.relative_to(source)))
        if layer is not None:
            fault = (check_own(source, file, layer, name) if is_own
                else check_library(layer, name))
            if fault:
                yield f"{file.relative_to(source)} {fault}"


def find_mutual(source):
    """The folders that include each other."""
    pairs = {}
    for file, name, is_own in read_includes(source):
        header = find_header(source, file, name) if is_own else None
        if header is not None:
            pair = str(file.parent.relative_to(source)), str(header.parent)
            pairs.setdefault(pair, f"{file.name} includes {header.name}")
    for (one, other), example in pairs.items():
        if one < other and (other, one) in pairs:
            yield f"{one} and {other} include each other: {example}, {pairs[other, one]}"


def find_cycle():
    """A layer that builds on itself, or None."""
    def reach(layer, seen):
        for other in LAYERS[layer]:
            if other not in seen:
                seen.add(other)
                reach(other, seen)
        return seen
    return next((layer for layer in LAYERS if layer in reach(layer, set())), None)


def main():
    source = pathlib.Path(sys.argv[1]).resolve()
    faults = [*find_faults(source), *find_mutual(source)]
    cycle = find_cycle()
    if cycle:
        faults.append(f"{cycle} builds on itself")
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
