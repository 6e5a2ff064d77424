#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that every public class is used by an example or by a code block of the documentation.
Abstract classes are superclasses of these, and need none."""
import argparse
import pathlib
import re
import sys

FENCED = re.compile(r"^\s*```\w+\s*$(.*?)^\s*```\s*$", re.MULTILINE | re.DOTALL)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("source", type=pathlib.Path, help="the project's folder")
    parser.add_argument("headers", nargs="+", type=pathlib.Path, help="of the public classes")
    options = parser.parse_args()
    texts = [path.read_text(encoding="utf-8") for pattern in ("*.cxx", "*.py")
             for path in (options.source / "Examples").rglob(pattern)]
    for page in [options.source / "README.md", *(options.source / "Documentation").glob("*.md")]:
        texts += FENCED.findall(page.read_text(encoding="utf-8"))
    missing = []
    for header in options.headers:
        name = header.stem
        instantiable = f"static {name}* New();" in header.read_text(encoding="utf-8")
        if instantiable and not any(re.search(rf"\b{name}\b", text) for text in texts):
            missing.append(name)
    for name in missing:
        print(f"{name} is in no example")
    print(f"{len(options.headers)} classes, {len(missing)} without an example")
    sys.exit(1 if missing else 0)


if __name__ == "__main__":
    main()
