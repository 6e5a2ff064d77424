#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Makes calls to the file system fail while the cslf tool writes, kills it, and lets it run again.

Whatever happens, there must be the old output or the whole new one, the next run must give the
bytes of an undisturbed one, and files that the tool has not made must stay as they are.
"""
import argparse
import collections
import hashlib
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import time

FIELD = ["sample", "cornell-box", "-M", "2", "-N", "16", "--max-depth", "2", "--spp"]

# The outputs, the commands that write them, and whether something exists already.
Output = collections.namedtuple("Output", "name command is_replaced")
OUTPUTS = [
    Output("video.mp4", FIELD + ["1", "--cache-samples", "64", "--preset", "ultrafast"], False),
    Output("video.mkv", ["encode", "{input}", "--preset", "ultrafast", "--target-ratio", "8"], True),
    Output("images", ["decode", "{input}"], True),
    Output("copy.vti", ["decode", "{input}"], True),
    Output("picture.png", ["trace", "cornell-box", "--size", "8", "8", "--spp", "1"], True),
    Output("scene.obj", ["export", "cornell-box"], True),
]
FOREIGN = ["{}.replaced/thesis", "{}.writable", "{}.partial/thesis", "{}.unfinished"]


class Fault(Exception):
    """Something that must not happen."""


def digest(path):
    """The bytes of a file, or of a folder's files with their names. None if there is nothing."""
    if not os.path.lexists(path):
        return None
    whole = hashlib.sha256()
    files = sorted(path.iterdir()) if path.is_dir() else [path]
    for file in files:
        if path.is_dir():
            whole.update(file.name.encode() + b"\0")
        whole.update(file.read_bytes())
    return whole.hexdigest()


class Bench:
    """Runs the tool in its own folder, and checks what it leaves."""

    def __init__(self, options):
        self.options = options
        self.folder = pathlib.Path(options.folder).resolve()
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        self.input = self.folder / "input.vti"
        self.counts = collections.Counter()
        self.wanted = {}
        self.old = {}
        self.seconds = {}
        error, code = self.run(FIELD + ["1", "--integrator", "path"], self.input)
        if code != 0:
            raise SystemExit(f"the field to work with was not made ({code}): {error}")

    def run(self, command, output, fault="", at=0, delay=None):
        """The exit code and the messages on standard error."""
        environment = dict(os.environ)
        if fault:
            environment.update(
                LD_PRELOAD=self.options.faults, CSLF_FAULT=fault, CSLF_FAULT_AT=str(at),
                CSLF_FAULT_ROOT=str(output.parent) + "/", CSLF_FAULT_LOG=str(self.folder / "log"))
        words = [word.replace("{input}", str(self.input)) for word in command]
        process = subprocess.Popen([self.options.cslf] + words + ["-o", str(output)], env=environment,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        if delay is not None:
            try:
                process.wait(delay)
            except subprocess.TimeoutExpired:
                process.kill()
        return process.communicate()[1], process.returncode

    def prepare(self, output, foreign=True):
        """A new folder with other files and, if requested, an old output."""
        place = self.folder / "place"
        shutil.rmtree(place, ignore_errors=True)
        place.mkdir()
        path = place / output.name
        for pattern in FOREIGN if foreign else []:
            file = place / pattern.format(output.name)
            file.parent.mkdir(exist_ok=True)
            file.write_text("thesis")
        if output.is_replaced:
            old = self.folder / ("old-" + output.name)
            if old.is_dir():
                shutil.copytree(old, path)
            else:
                shutil.copy(old, path)
        return path

    def learn(self, output):
        """The result of an undisturbed run, its time, and its calls."""
        old = self.folder / ("old-" + output.name)
        if output.is_replaced and not old.exists():
            if output.name == "images":
                self.run(FIELD + ["2", "--integrator", "path"], old)
            else:
                old.write_text("old")
        self.old[output.name] = digest(old) if output.is_replaced else None
        path = self.prepare(output)
        begin = time.monotonic()
        error, code = self.run(output.command, path, "count")
        self.seconds[output.name] = time.monotonic() - begin
        if code != 0:
            raise Fault(f"{output.name}: an undisturbed run ended with {code}: {error}")
        self.wanted[output.name] = digest(path)
        return [int(word) for word in (self.folder / "log").read_text().split()]

    def check_foreign(self, path, what):
        for pattern in FOREIGN:
            file = path.parent / pattern.format(path.name)
            if not file.exists() or file.read_text() != "thesis":
                raise Fault(f"{what}: {file.name} was touched")
        allowed = {path.name} | {pattern.format(path.name).split("/")[0] for pattern in FOREIGN}
        others = {file.name for file in path.parent.iterdir()} - allowed
        if others:
            raise Fault(f"{what}: there is {others}")

    def check_after(self, output, path, what):
        """Checks that there is the old output or the new one. Returns whether it is the new one."""
        found = digest(path)
        if found not in (self.old[output.name], self.wanted[output.name]):
            raise Fault(f"{what}: {path.name} is neither the old one nor the new one")
        self.check_foreign(path, what)
        return found == self.wanted[output.name]

    def check_again(self, output, path, what):
        """Checks that the next run gives the same result as an undisturbed one."""
        error, code = self.run(output.command, path)
        if code != 0 or digest(path) != self.wanted[output.name]:
            raise Fault(f"{what}: the next run ended with {code}: {error}")
        self.check_foreign(path, what)
        left = {file.name for file in (path.parent / (path.name + ".partial")).iterdir()}
        if left != {"thesis"}:
            raise Fault(f"{what}: the next run left {left}")

    def inject(self, output, fault, at):
        what = f"{output.name}, {fault} at {at}"
        path = self.prepare(output)
        error, code = self.run(output.command, path, fault, at)
        is_new = self.check_after(output, path, what)
        self.counts[fault] += 1
        if fault == "kill":
            if code not in (0, -signal.SIGKILL):
                raise Fault(f"{what}: ended with {code}: {error}")
        elif code == 0 and not is_new:
            raise Fault(f"{what}: success was reported, but nothing was written")
        elif code not in (0, 1) or (code == 1 and error.count("\n") != 1):
            raise Fault(f"{what}: ended with {code}: {error}")
        elif code == 1 and fault == "full" and "No space left" not in error:
            raise Fault(f"{what}: the disk is full, but the tool says {error}")
        self.counts["failures told"] += code == 1
        self.check_again(output, path, what)

    def kill_alone(self, output, at):
        """Checks that without other files, nothing is left beside the output."""
        what = f"{output.name}, killed alone at {at}"
        path = self.prepare(output, foreign=False)
        self.run(output.command, path, "kill", at)
        self.counts["kill alone"] += 1
        error, code = self.run(output.command, path)
        if code != 0 or digest(path) != self.wanted[output.name]:
            raise Fault(f"{what}: the next run ended with {code}: {error}")
        left = {file.name for file in path.parent.iterdir()} - {path.name}
        if left:
            raise Fault(f"{what}: the next run left {left}")

    def kill(self, output, delay):
        what = f"{output.name}, killed after {delay:.3f} s"
        path = self.prepare(output)
        _, code = self.run(output.command, path, delay=delay)
        self.check_after(output, path, what)
        self.counts["random kills"] += 1
        self.counts["random kills in time"] += code == -signal.SIGKILL
        self.check_again(output, path, what)


def choose(count, most):
    """Numbers from 1 to `count`: all, or so many, evenly spread."""
    if most <= 0 or count <= most:
        return list(range(1, count + 1))
    return [1 + int((k + 0.5) * count / most) for k in range(most)]


def inject_all(bench, outputs, points):
    for output in outputs:
        room, syncs, names, removals = bench.learn(output)
        faults = {"full": room, "eio": room + syncs, "rename": names,
                  "kill": room + syncs + names + removals}
        for fault, count in faults.items():
            for at in choose(count, points):
                bench.inject(output, fault, at)
                if fault == "kill":
                    bench.kill_alone(output, at)
        if output.name == "images":
            bench.inject(output, "noexchange", 0)
    # A file system without locks.
    bench.inject(outputs[-1], "nolock", 0)


def kill_all(bench, outputs, kills, seed):
    """At random moments of runs that take a while."""
    numbers = random.Random(seed)
    for output in outputs:
        if output.name not in bench.wanted:
            bench.learn(output)
    for number in range(kills):
        output = outputs[number % len(outputs)]
        bench.kill(output, numbers.uniform(0.0, 1.1 * bench.seconds[output.name]))


def hold(bench):
    """Without locks, what a killed run has left keeps others out until it is removed by hand."""
    output = OUTPUTS[2]
    path = bench.prepare(output)
    folder = path.parent / (path.name + ".partial")
    (folder / "cslf.lock").write_text("CSLF: a light field is being written here.\n")
    holder = folder / "cslf.lock.held"
    holder.write_text("process 1 on elsewhere")
    error, code = bench.run(output.command, path, "nolock")
    if code != 1 or f"remove {holder} and run again" not in error:
        raise Fault(f"a file held by another process: ended with {code}: {error}")
    if not bench.check_after(output, path, "held") and holder.read_text() != "process 1 on elsewhere":
        raise Fault("the file of the holder was touched")
    holder.unlink()
    bench.check_again(output, path, "no holder")


def enter_namespace():
    """Runs this program again where it may mount disks, if the system lets it."""
    for words in (["unshare", "--mount"], ["unshare", "--user", "--map-root-user", "--mount"]):
        if not shutil.which("unshare") or "CSLF_NAMESPACE" in os.environ:
            return
        if subprocess.call(words + ["true"], stderr=subprocess.DEVNULL) == 0:
            os.environ["CSLF_NAMESPACE"] = "1"
            os.execvp(words[0], words + [sys.executable] + sys.argv)


def fill_disk(bench):
    """A disk of 60 kB, and then a larger one. Tells whether such a disk could be made."""
    place = bench.folder / "disk"
    place.mkdir()
    path = place / "video.mp4"
    command = ["sample", "cornell-box", "-M", "5", "-N", "16", "--spp", "1", "--max-depth", "2",
               "--preset", "ultrafast", "--integrator", "path"]
    if subprocess.call(["mount", "-t", "tmpfs", "-o", "size=60k", "tmpfs", str(place)],
                       stderr=subprocess.DEVNULL) != 0:
        return False
    try:
        error, code = bench.run(command, path)
        if code != 1 or path.exists() or "kept" not in error or "the disk has only" not in error:
            raise Fault(f"a disk of 60 kB: ended with {code}: {error}")
        print(error, end="")
        parts = len(list(place.glob("video.mp4.partial/*.part")))
        subprocess.check_call(["mount", "-o", "remount,size=4M", str(place)])
        error, code = bench.run(command, path)
        if code != 0 or error:
            raise Fault(f"a larger disk: ended with {code}: {error}")
        bench.run(command, bench.folder / "reference.mp4")
        if digest(path) != digest(bench.folder / "reference.mp4"):
            raise Fault("a larger disk: other bytes")
        print(f"disk of 60 kB: {parts} parts kept, and gone on from")
    finally:
        subprocess.call(["umount", str(place)])
    return True


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("cslf", help="the tool")
    parser.add_argument("faults", help="the library to preload")
    parser.add_argument("folder", help="to work in, emptied first")
    parser.add_argument("--points", type=int, default=0, help="calls of each kind to disturb (all)")
    parser.add_argument("--kills", type=int, default=100, help="runs to kill at random times")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--outputs", nargs="+", default=[output.name for output in OUTPUTS])
    parser.add_argument("--disk", action="store_true", help="fill a small disk instead")
    options = parser.parse_args()
    if options.disk:
        enter_namespace()
    options.cslf = os.path.abspath(options.cslf)
    options.faults = os.path.abspath(options.faults)
    begin = time.monotonic()
    bench = Bench(options)
    try:
        if options.disk:
            # 125 tells ctest that the test was skipped.
            return 0 if "CSLF_NAMESPACE" in os.environ and fill_disk(bench) else 125
        outputs = [output for output in OUTPUTS if output.name in options.outputs]
        inject_all(bench, outputs, options.points)
        kill_all(bench, outputs[:4], options.kills, options.seed)
        if OUTPUTS[2] in outputs:
            hold(bench)
    except Fault as fault:
        print(f"error: {fault}", file=sys.stderr)
        return 1
    for name, count in bench.counts.items():
        print(f"{name}: {count}")
    print(f"{time.monotonic() - begin:.0f} s")
    return 0


sys.exit(main())
