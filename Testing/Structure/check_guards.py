#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that no exception leaves VTK's methods: those that do work of ours use cslfGuard.h.

A class that defines RequestInformation, RequestUpdateExtent or RequestData has a ProcessRequest with
a guard, or a base class of ours has one: VTK calls the former through the latter. Other methods with
a guard are listed here.

usage: check_guards.py SOURCE_FOLDER
"""
import pathlib
import re
import sys

FOLDERS = ("Filters", "Rendering", "ParaViewPlugin/Module")

# Methods of ours, or overridden ones, that VTK or users call and that may need much memory.
GUARDED = {"ProcessRequest", "ProcessViewRequest", "Write", "Render", "GetBounds", "Measure", "Estimate",
    "ChooseSamples", "RecallSamples", "AddPart", "AddToRenderer"}


def find_bodies(text, name):
    """The names and bodies of a class's methods. A body ends at the first brace in column 0."""
    pattern = rf"^[\w:<>*& ]*\b{name}::(\w+)\([^;{{]*?\)(?: const)?\n\{{\n(.*?)^\}}"
    return re.findall(pattern, text, re.MULTILINE | re.DOTALL)


def has_guard(body):
    return re.search(r"\b(?:cslf::|this->)?Guard(?:Method|Request)?\(", body) is not None


def read_classes(source):
    """The text of each class's source file, and the base class of each class."""
    texts = {}
    bases = {}
    for folder in FOLDERS:
        for header in sorted((source / folder).glob("vtk*.h")):
            match = re.search(r"^class (?:VTK\w+_EXPORT )?(\w+) : public (\w+)",
                header.read_text(encoding="utf-8"), re.MULTILINE)
            file = header.with_suffix(".cxx")
            if match and file.is_file():
                bases[match[1]] = match[2]
                # Parts of a class may be in other files: vtkCSLFPathTracerCache.cxx.
                texts[match[1]] = file.read_text(encoding="utf-8")
    return texts, bases


def is_guarded(name, texts, bases):
    """Whether requests to a class of ours pass a guard."""
    while name in texts:
        bodies = dict(find_bodies(texts[name], name))
        if f"cslfGuardedRequestMacro({name})" in texts[name] or has_guard(
                bodies.get("ProcessRequest", "")):
            return True
        name = bases[name]
    return False


def find_faults(source):
    texts, bases = read_classes(source)
    for name, text in texts.items():
        bodies = find_bodies(text, name)
        requests = [method for method, _ in bodies
            if method in ("RequestInformation", "RequestUpdateExtent", "RequestData")]
        if requests and not is_guarded(name, texts, bases):
            yield f"{name}::{requests[0]} is without a guard: use cslfGuardedRequestMacro"
        for method, body in bodies:
            calls_base = f"this->Superclass::{method}(" in body and is_guarded(
                bases[name], texts, bases)
            if method in GUARDED and not has_guard(body) and not calls_base:
                yield f"{name}::{method} is without a guard: use cslf::GuardMethod"


def main():
    faults = list(find_faults(pathlib.Path(sys.argv[1]).resolve()))
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
