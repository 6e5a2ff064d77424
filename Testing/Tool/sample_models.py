#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Samples every model below some folders, and prints the result of each run.

A run passes if the tool writes a field, or if it ends with exit code 1, one line on standard error
and no file; a model with "_sound_" in its name must give a field. A run fails if the tool crashes,
takes too long, prints anything else, or leaves a file behind. A table in Markdown goes to standard
output. The exit code is 0 if all runs pass.

Without an argument after --, the tool samples as with -M 3 -N 16:

    sample_models.py build/release/bin/cslf /usr/share/assimp/models -- -M 3 -N 16
"""
import argparse
import concurrent.futures
import os
import pathlib
import re
import resource
import signal
import subprocess
import sys
import tempfile
import time

EXTENSIONS = {".ply", ".stl", ".obj", ".vtp", ".vtm", ".vtu", ".vti", ".vtr", ".vts", ".vtk", ".pvtp",
              ".pvtu", ".pvd", ".gltf", ".glb"}
ERROR = re.compile(r"cslf: error: [^\n]+\n")
WARNINGS = re.compile(r"(cslf: warning: [^\n]+\n)*")
SKIPPED = 125


def parse_arguments():
    """The command line. Arguments after -- go to the tool."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("tool", help="the cslf tool")
    parser.add_argument("folder", nargs="+", type=pathlib.Path, help="folders with models, or models")
    parser.add_argument("--limit", type=float, default=20.0,
                        help="seconds of processor time that a run may take (default: 20)")
    parser.add_argument("--exclude", action="append", default=[],
                        help="leave out models with this in their path")
    parser.add_argument("--every", type=int, default=1, metavar="N",
                        help="sample only every N-th model (default: 1)")
    parser.add_argument("--jobs", type=int, default=1, help="runs at a time (default: 1)")
    arguments = sys.argv[1:]
    split = arguments.index("--") if "--" in arguments else len(arguments)
    options = parser.parse_args(arguments[:split])
    options.sampling = arguments[split + 1:] or ["-M", "3", "-N", "16"]
    return options


def find_models(folders):
    """All files of a known type, in a fixed order."""
    models = []
    for folder in folders:
        files = sorted(folder.rglob("*")) if folder.is_dir() else [folder]
        models += [(folder, path) for path in files
                   if path.is_file() and path.suffix.lower() in EXTENSIONS]
    return models


def run(command, limit):
    """Runs a command. Returns its exit code, standard error, and processor seconds."""
    def set_limit():
        seconds = int(limit) + 1
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    with tempfile.TemporaryFile() as error:
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=error,
                              preexec_fn=set_limit) as process:
            end = time.monotonic() + 50 * limit  # for those that hang
            status = None
            while status is None:
                pid, code, usage = os.wait4(process.pid, os.WNOHANG)
                if pid:
                    status = os.waitstatus_to_exitcode(code)
                    process.returncode = status
                elif time.monotonic() > end:
                    process.kill()
                    end += 3600
                else:
                    time.sleep(0.01)
        error.seek(0)
        text = error.read().decode("utf-8", "replace")
    return status, text, usage.ru_utime + usage.ru_stime


def judge(status, text, written, leftovers):
    """Whether a run passes, and a text for the report."""
    lines = text.strip().splitlines()
    if status in (-signal.SIGXCPU, -signal.SIGKILL):
        return False, "TOO SLOW"
    if status < 0:
        return False, f"CRASH by {signal.Signals(-status).name}"
    if status == 0:
        if not written:
            return False, "NO FIELD"
        if not WARNINGS.fullmatch(text):
            return False, "UNCLEAR: " + " / ".join(lines)
        words = [line.split(": ", 1)[1] for line in lines]
        return True, "field" + "".join("; " + word for word in words)
    if status != 1 or not ERROR.fullmatch(text):
        return False, f"UNCLEAR, exit code {status}: " + " / ".join(lines)
    if leftovers:
        return False, "LEFT " + ", ".join(leftovers)
    return True, lines[0].split(": ", 1)[1]


def sample(options, folder, path):
    """Samples a model. Returns whether it passes, and a row of the table."""
    with tempfile.TemporaryDirectory() as directory:
        field = pathlib.Path(directory, "field.vti")
        command = [options.tool, "sample", str(path), "-o", str(field), *options.sampling]
        status, text, seconds = run(command, options.limit)
        leftovers = sorted(os.listdir(directory))
        passed, result = judge(status, text, field.exists(), leftovers)
    if passed and status != 0 and "_sound_" in path.name:
        passed, result = False, "REFUSED: " + result
    if seconds > options.limit and passed:
        passed, result = False, "TOO SLOW, " + result
    name = path.relative_to(folder) if path != folder else path.name
    result = result.replace(f"{path.parent}{os.sep}", "").replace("|", "\\|")
    return passed, f"| {name} | {seconds:.1f} | {'' if passed else '**FAILED** '}{result} |"


def main():
    """Prints the table."""
    options = parse_arguments()
    models = [(folder, path) for folder, path in find_models(options.folder)
              if not any(word in str(path) for word in options.exclude)][::options.every]
    if not models:
        print("There are no models: they are not installed.")
        return SKIPPED
    failures = 0
    print("| model | CPU s | result |\n|---|---|---|")
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as executor:
        for passed, row in executor.map(lambda model: sample(options, *model), models):
            failures += not passed
            print(row, flush=True)
    print(f"\n{len(models)} models, {failures} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
