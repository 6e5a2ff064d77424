#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the code blocks of the documentation's pages, in their order, in a folder of their own.

  sh      by bash, which stops at the first command that fails
  python  as a program, with at most 3 viewpoints along each side of a face
  json    must be valid

Commands are found in the folder `commands` first, where `cslf` and others replace large numbers by
small ones, so that pages can show realistic values and their blocks still run in a short time.

A comment in the line before a block tells how to treat it:

  <!-- test: in NAME -->      the block is a part of a program: it replaces @BLOCK_1@ in the folder
                              or file programs/NAME, a second one of that NAME @BLOCK_2@, and so on;
                              the program is then built and run
  <!-- test: file NAME -->    it is the contents of a file that commands of the page use
  <!-- test: long -->         it is run with --long only; otherwise only its syntax is checked
  <!-- test: never, WHY -->   only its syntax is checked
"""
import argparse
import collections
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parent.parent
FENCE = re.compile(r"^(\s*)```(\w*)\s*$")
MARK = re.compile(r"^\s*<!-- test: (in|file|long|never)[ ,]*(.*?)\s*-->\s*$")
VIEWPOINTS = re.compile(r"\bSetViewpoints\((\d+)\)")
Block = collections.namedtuple("Block", "place language text mark argument")


def read_blocks(page):
    """The code blocks of a page that have a language."""
    blocks = []
    before, fence, lines = "", None, []
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
        match = FENCE.match(line)
        if fence is None and match:
            fence, lines, start = match, [], number
            mark = MARK.match(before)
        elif fence is not None and match and not match.group(2):
            if fence.group(2):
                indent = len(fence.group(1))
                text = "\n".join(text[indent:] for text in lines) + "\n"
                blocks.append(Block(f"{page.name}:{start}", fence.group(2), text,
                                    mark.group(1) if mark else "", mark.group(2) if mark else ""))
            fence = None
        elif fence is not None:
            lines.append(line)
        before = line
    return blocks


def run(command, folder, environment):
    """Runs a command, and shows its output if it fails."""
    result = subprocess.run(command, cwd=folder, env=environment, text=True, errors="replace",
                            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT)
    if result.returncode or "ERROR:" in result.stdout:
        sys.stdout.write(result.stdout)
        raise RuntimeError(f"ended with {result.returncode}")


def check_syntax(block):
    """Whether a block that is not run could be."""
    if block.language == "sh":
        run(["bash", "-n", "-c", block.text], ".", os.environ)
        for script in re.findall(r"(?:^|\s)((?:Utilities|Examples)/\S+)", block.text):
            if not (SOURCE / script).exists():
                raise RuntimeError(f"there is no {script}")
    elif block.language == "python":
        compile(block.text, block.place, "exec")
    elif block.language not in ("json", "cpp"):  # C++ is compiled where its page is run
        raise RuntimeError(f"{block.language} cannot be checked")


def fill_in(blocks, name, folder):
    """A copy of a program with blocks in it."""
    target = folder / "programs" / name
    target.parent.mkdir(exist_ok=True)
    template = HERE / "programs" / name
    if template.is_dir():
        shutil.copytree(template, target)
    else:
        shutil.copy(template, target)
    files = [path for path in target.rglob("*") if path.is_file()] if target.is_dir() else [target]
    text = {path: path.read_text(encoding="utf-8") for path in files}
    for number, block in enumerate(blocks, 1):
        holders = [path for path in files if f"@BLOCK_{number}@" in text[path]]
        if len(holders) != 1:
            raise RuntimeError(f"{name} has not one place for block {number}")
        text[holders[0]] = text[holders[0]].replace(f"@BLOCK_{number}@", block.text)
    for path in files:
        path.write_text(text[path], encoding="utf-8")
    return target


def run_program(blocks, name, folder, environment, options):
    """Builds and runs a program that contains blocks."""
    target = fill_in(blocks, name, folder)
    if target.is_file():
        run([sys.executable, str(target)], folder, environment)
        return
    build = target / "build"
    run([options.cmake, "-S", str(target), "-B", str(build), "-DCMAKE_BUILD_TYPE=Release",
         *options.define], folder, os.environ)
    run([options.cmake, "--build", str(build)], folder, os.environ)
    run([str(build / "program")], folder, environment)


def run_block(block, folder, environment):
    """Runs an independent block."""
    if block.language == "sh":
        run(["bash", "-euo", "pipefail", "-c", block.text], folder, environment)
    elif block.language == "python":
        text = VIEWPOINTS.sub(lambda match: f"SetViewpoints({min(int(match[1]), 3)})", block.text)
        run([sys.executable, "-c", text], folder, environment)
    elif block.language == "json":
        json.loads(block.text)
    else:
        raise RuntimeError(f"{block.language} cannot be run by itself: name a program for it")


def prepare(options):
    """An empty folder with the files that the pages need, and the environment of commands."""
    folder = pathlib.Path(options.folder)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for name in ("Examples", "Testing", "Utilities", "CMakePresets.json"):
        (folder / name).symlink_to(SOURCE / name)
    (folder / "build").mkdir()
    (folder / "build" / "release").symlink_to(pathlib.Path(options.build).resolve())
    for path in pathlib.Path(options.files).iterdir() if options.files else ():
        shutil.copy(path, folder)
    packages = str(pathlib.Path(options.build).resolve() / "lib/python3/dist-packages")
    environment = dict(os.environ)
    environment["PATH"] = os.pathsep.join(
        [str(HERE / "commands"), str(pathlib.Path(sys.executable).parent), environment["PATH"]])
    environment["CSLF_TOOL"] = str(pathlib.Path(options.build).resolve() / "bin" / "cslf")
    environment["PYTHONPATH"] = os.pathsep.join(
        filter(None, [packages, environment.get("PYTHONPATH")]))
    return folder, environment


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pages", nargs="+", type=pathlib.Path)
    parser.add_argument("--build", required=True, help="CSLF's build folder")
    parser.add_argument("--folder", required=True, help="to work in; it is emptied first")
    parser.add_argument("--files", help="a folder of files that the pages take for granted")
    parser.add_argument("--cmake", default="cmake")
    parser.add_argument("--define", action="append", default=[], metavar="-DNAME=VALUE",
                        help="for programs; may be repeated")
    parser.add_argument("--long", action="store_true", help="also what takes long")
    parser.add_argument("--syntax", action="store_true", help="run nothing")
    options = parser.parse_args()
    folder, environment = prepare(options)

    failures = 0
    for page in options.pages:
        blocks = read_blocks(page)
        programs = collections.defaultdict(list)
        for block in blocks:
            if block.mark == "file":
                (folder / block.argument).write_text(block.text, encoding="utf-8")
            if block.mark == "in":
                programs[block.argument].append(block)
        for block in blocks:
            start = time.monotonic()
            what = "ran"
            try:
                if options.syntax or block.mark == "never" or (block.mark == "long" and
                                                               not options.long):
                    what = "not run"
                    check_syntax(block)
                elif block.mark == "in":
                    parts = programs[block.argument]
                    if block is parts[-1]:
                        run_program(parts, block.argument, folder, environment, options)
                else:
                    run_block(block, folder, environment)
            except (RuntimeError, ValueError, SyntaxError) as error:
                failures += 1
                what = f"FAILED: {error}"
            print(f"{block.place} {block.language}: {what}, {time.monotonic() - start:.1f} s",
                  flush=True)
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
