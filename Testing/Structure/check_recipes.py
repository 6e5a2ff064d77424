#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that what the "Adding ..." sections of CONTRIBUTING.md name exists: files and folders, and
names in the source code.

usage: check_recipes.py SOURCE_FOLDER
"""
import pathlib
import re
import sys

# What the examples of the recipes would add.
EXAMPLES = re.compile(r"Sheen|Sharp|SetLookupTo|[Ss]lope|Fog")
FILE = re.compile(r"[\w/.-]+\.(h|cxx|glsl|xml|xml\.in|cmake|in|json|py|md|txt)")
SOURCES = (".h", ".cxx", ".glsl", ".py", ".cmake", ".xml", ".in", ".json")


def read_recipes(source):
    """The text of the sections, with the heading of each."""
    text = (source / "CONTRIBUTING.md").read_text(encoding="utf-8")
    sections = re.split(r"^## ", text, flags=re.MULTILINE)
    return [section for section in sections if section.startswith("Adding ")]


def list_files(source):
    """The source files, without those in build folders."""
    folders = ("Module", "Filters", "Rendering", "Applications", "ParaViewPlugin", "Python",
        "Testing", "Utilities", "Documentation", "CMake")
    files = [path for folder in folders for path in (source / folder).rglob("*") if path.is_file()]
    return files + [path for path in source.iterdir() if path.is_file()]


def is_there(name, paths):
    """Whether a path ends with this name of a file or a folder."""
    return any(("/" + path).endswith("/" + name) or f"/{name}/" in "/" + path for path in paths)


def find_faults(source):
    files = list_files(source)
    paths = [str(path.relative_to(source)) for path in files]
    words = set()
    for path in files:
        if path.suffix in SOURCES:
            words.update(re.findall(r"\w+", path.read_text(encoding="utf-8", errors="replace")))
    for section in read_recipes(source):
        heading = section.splitlines()[0]
        for name in re.findall(r"`([^`\n]+)`", section):
            if EXAMPLES.search(name):
                continue
            if FILE.fullmatch(name) or "/" in name:
                if not is_there(name.rstrip("/"), paths):
                    yield f"{heading}: there is no {name}"
            else:
                missing = [word for word in re.findall(r"[A-Za-z_]\w{3,}", name)
                    if word not in words]
                if missing:
                    yield f"{heading}: {missing[0]} is nowhere in the source code"


def main():
    faults = list(find_faults(pathlib.Path(sys.argv[1]).resolve()))
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
