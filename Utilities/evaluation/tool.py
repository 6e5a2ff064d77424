# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the tools cslf and cslf-lab and keeps their results, so that nothing is measured twice."""
import json
import os
import subprocess
import tempfile
import time
from pathlib import Path


class Tool:
    """The tool, with cslf-lab beside it, a folder for fields (which may be large) and a folder for
    results."""

    def __init__(self, program, work, folder):
        self.program = program
        self.work = Path(work)
        self.folder = Path(folder)
        self.work.mkdir(parents=True, exist_ok=True)
        (self.folder / "parts").mkdir(parents=True, exist_ok=True)

    def measure(self, name, *arguments, output=None):
        """Returns what a command prints as JSON, with its time (seconds_of_run), the processor time
        of all its threads (processor_seconds) and its peak memory (peak_bytes). `output` is a file
        that it makes: if it is missing, the command runs again."""
        command = [self.program, *map(str, arguments), "--json"]
        return self.keep(name, lambda: run_measured(command), output)

    def measure_in_lab(self, name, *arguments):
        """Returns the same for a command of cslf-lab."""
        command = [self.program + "-lab", *map(str, arguments), "--json"]
        return self.keep(name, lambda: run_measured(command))

    def keep(self, name, measure, output=None):
        """Returns the result of `measure`, with seconds_of_run. The result is kept and used again
        if the file `output` still exists."""
        kept = self.folder / "parts" / f"{name}.json"
        if kept.exists() and (output is None or Path(output).exists()):
            return json.loads(kept.read_text())
        print(name, flush=True)
        begin = time.monotonic()
        found = strip_paths(measure())
        found["seconds_of_run"] = time.monotonic() - begin
        whole = kept.with_suffix(".new")
        whole.write_text(json.dumps(found, indent=1) + "\n")
        whole.replace(kept)
        return found

    def get_seconds(self):
        """The total time of the kept measurements."""
        parts = [json.loads(kept.read_text()) for kept in (self.folder / "parts").glob("*.json")]
        return sum(part.get("seconds_of_run", 0.0) for part in parts)

    def ask(self, *arguments):
        """Returns what a command prints as JSON, without measuring it."""
        return json.loads(subprocess.run([self.program, *map(str, arguments), "--json"], check=True,
                                         stdout=subprocess.PIPE).stdout)

    def run(self, *arguments):
        """Runs a command of which only the files are needed."""
        subprocess.run([self.program, *map(str, arguments)], check=True, stdout=subprocess.DEVNULL)


def run_measured(command):
    """Returns what Tool.measure returns, except for seconds_of_run."""
    with tempfile.TemporaryFile() as printed, tempfile.TemporaryFile() as told:
        process = subprocess.Popen(command, stdout=printed, stderr=told)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        printed.seek(0)
        told.seek(0)
        if process.returncode != 0:
            raise SystemExit(f"{' '.join(command)}\n{told.read().decode()}")
        found = json.loads(printed.read())
    found["processor_seconds"] = usage.ru_utime + usage.ru_stime
    found["peak_bytes"] = usage.ru_maxrss * 1024
    return found


def run_program(*command):
    """Runs a program other than the tool. Shows its output only if it fails."""
    command = list(map(str, command))
    process = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if process.returncode != 0:
        raise SystemExit(f"{' '.join(command)}\n{process.stdout}")


def strip_paths(found):
    """Removes the folders of files, which mean nothing on another machine."""
    if isinstance(found, dict):
        return {key: strip_paths(value) for key, value in found.items()}
    if isinstance(found, list):
        return [strip_paths(value) for value in found]
    if isinstance(found, str) and found.startswith("/"):
        return Path(found).name
    return found
