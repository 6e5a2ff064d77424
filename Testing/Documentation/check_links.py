#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Checks the links of all pages: files, pictures, and headings within pages. Files of the project
that pages and headers name, such as Documentation/Planning.md, must be there too."""
import argparse
import pathlib
import re
import sys

LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
HEADING = re.compile(r"^#+\s+(.*?)\s*$", re.MULTILINE)
FENCED = re.compile(r"^\s*```.*?^\s*```\s*$", re.MULTILINE | re.DOTALL)
FOLDERS = "Applications|CMake|Documentation|Examples|Filters|Module|ParaViewPlugin|Python|" \
          "Rendering|Testing|Utilities"
NAMED = re.compile(rf"(?<![\w/.-])(?:{FOLDERS})/[\w./-]*\w")
SKIPPED = {"build", "install", ".git", "paper"}


def find(source, *patterns):
    """Files of the project, without those of builds."""
    for pattern in patterns:
        for path in sorted(source.rglob(pattern)):
            if not SKIPPED & set(path.relative_to(source).parts):
                yield path


def make_anchor(heading):
    """The anchor of a heading in Markdown viewers."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").lower()
    return re.sub(r"[^\w\- ]", "", text).replace(" ", "-")


def read_anchors(page):
    """All anchors of a page: the second of a name ends with -1, and so on."""
    counts, anchors = {}, set()
    for heading in HEADING.findall(FENCED.sub("", page.read_text(encoding="utf-8"))):
        anchor = make_anchor(heading)
        count = counts.get(anchor, 0)
        counts[anchor] = count + 1
        anchors.add(f"{anchor}-{count}" if count else anchor)
    return anchors


def check_page(page):
    """The errors in the links of a page."""
    for target in LINK.findall(FENCED.sub("", page.read_text(encoding="utf-8"))):
        if re.match(r"[a-z]+:", target):
            if not re.match(r"(https://[\w.-]+\.[a-z]+(/|$)|mailto:)", target):
                yield f"{target} is no address"
            continue
        name, _, anchor = target.partition("#")
        path = (page.parent / name).resolve() if name else page
        if not path.exists():
            yield f"there is no {target}"
        elif anchor and (path.suffix != ".md" or anchor not in read_anchors(path)):
            yield f"there is no heading {target}"


def check_names(source, path):
    """The missing files among those that a text names. Extensions may be left out."""
    for name in NAMED.findall(LINK.sub("", path.read_text(encoding="utf-8"))):
        folder = source / pathlib.PurePosixPath(name).parent
        if not (source / name).exists() and not list(folder.glob(f"{pathlib.Path(name).name}*")):
            yield f"there is no {name}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("source", type=pathlib.Path, help="the project's folder")
    source = parser.parse_args().source.resolve()
    pages = list(find(source, "*.md"))
    faults = [(page, fault) for page in pages for fault in check_page(page)]
    for path in [*pages, *find(source, "vtkCSLF*.h")]:
        faults += [(path, fault) for fault in check_names(source, path)]
    for path, fault in faults:
        print(f"{path.relative_to(source)}: {fault}")
    print(f"{len(pages)} pages, {len(faults)} faults")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
