#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that the table of Documentation/WindowAndBake.md is the list of vtkCSLFSceneImporter.

  check_limits.py PAGE            tells the first line that differs
  check_limits.py PAGE --write    puts the list into the page
"""
import argparse
import itertools
import pathlib
import sys

from cslf import vtkCSLFSceneImporter as Importer

BEGIN = "<!-- table of limits: Testing/Documentation/check_limits.py --write -->"
END = "<!-- end of the table of limits -->"


def make_table():
    """The list as the lines of a Markdown table."""
    lines = ["| | window | baked | warning |", "|---|---|---|---|"]
    for i in range(Importer.GetNumberOfLimits()):
        warned = "yes" if Importer.GetLimitWarned(i) else "no"
        lines.append(f"| {Importer.GetLimitName(i)} | {Importer.GetLimitInWindow(i)} "
                     f"| {Importer.GetLimitInBake(i)} | {warned} |")
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("page", type=pathlib.Path)
    parser.add_argument("--write", action="store_true")
    arguments = parser.parse_args()
    lines = arguments.page.read_text(encoding="utf-8").splitlines()
    begin, end = lines.index(BEGIN) + 1, lines.index(END)
    table = make_table()
    if arguments.write:
        text = "\n".join(lines[:begin] + table + lines[end:]) + "\n"
        arguments.page.write_text(text, encoding="utf-8")
        return 0
    for written, expected in itertools.zip_longest(lines[begin:end], table):
        if written != expected:
            print(f"The page has\n  {written}\nbut the importer's list has\n  {expected}")
            print("Run Testing/Documentation/check_limits.py Documentation/WindowAndBake.md --write "
                  "with the built package in PYTHONPATH.")
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
