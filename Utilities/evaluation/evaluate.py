# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the studies that evaluate.sh is called with and writes the page."""
import argparse
import datetime
import json
import os
import platform
import subprocess
import sys
from pathlib import Path

from report import Report, paragraph
from studies import FULL, QUICK, Studies
from tool import Tool

NAMES = ("corpus", "sampling", "scaling", "sizes", "novel-views", "key-views", "frame-rates",
         "integrators", "cycles", "limits")


def describe_machine(cslf):
    """The hardware and software that the figures depend on."""
    def say(*command):
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()
    processor = next((line.split(":")[1].strip() for line in
                      Path("/proc/cpuinfo").read_text().splitlines()
                      if line.startswith("model name")), platform.machine())
    versions = say("dpkg-query", "--show", "--showformat=${Package} ${Version}, ", "libvtk9.1",
                   "libembree3-3", "libavcodec59", "libx265-199", "libgl1-mesa-dri")
    return {"date": datetime.date.today().isoformat(), "processor": processor,
            "cores": len(os.sched_getaffinity(0)), "cslf": say(cslf, "--version"),
            "system": platform.freedesktop_os_release()["PRETTY_NAME"],
            "packages": versions.rstrip(", ")}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--source", type=Path, required=True)
    parser.add_argument("--build", type=Path, required=True)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--scenes", type=lambda text: text.split(","), default=[])
    # With nargs "*", argparse checks the empty list, too.
    parser.add_argument("studies", nargs="*", metavar="STUDY", choices=[[], *NAMES])
    options = parser.parse_args()
    setting = QUICK if options.quick else FULL
    folder = (options.build.parent / "evaluation-scenes" if options.scenes
              else options.build.parent / "evaluation-quick" if options.quick
              else options.source / "Documentation" / "evaluation")
    work = options.build.parent / ("fields-quick" if options.quick else "fields")
    cslf = str(options.build / "bin" / "cslf")
    sys.path.insert(0, str(options.build / "lib" / "python3" / "dist-packages"))
    tool = Tool(cslf, work, folder)
    studies = Studies(tool, setting, options.source / "Testing" / "Data", options.scenes)
    report = Report(tool, setting)
    machine = describe_machine(cslf)
    kept = folder / "parts" / "machines.json"
    machines = json.loads(kept.read_text()) if kept.exists() else {}
    for name in options.studies or NAMES:
        method = name.replace("-", "_")
        part = getattr(report, method)(getattr(studies, method)())
        (folder / "parts" / f"{name}.txt").write_text(part)
        machines[name] = machine
        kept.write_text(json.dumps(machines, indent=1) + "\n")
    seconds = tool.get_seconds()
    write_page(folder, machines, seconds)
    print(f"{folder / 'README.md'}, {seconds:.0f} seconds")


def write_page(folder, machines, seconds):
    """Writes the page from all parts that exist."""
    studies = {}  # by what they were measured on
    for name, machine in machines.items():
        studies.setdefault(json.dumps(machine), []).append(name)
    setups = "; ".join(
        f"{', '.join(names)}: {machine['date']}, {machine['processor']}, {machine['cores']} cores, "
        f"{machine['system']}, CSLF {machine['cslf']}, {machine['packages']}"
        for machine, names in ((json.loads(text), names) for text, names in studies.items()))
    head = ("# Evaluation\n\n" +
            paragraph("`Utilities/evaluate.sh` makes this page. The JSON files with all results "
                      f"are in `parts`. The measurements took {seconds / 60:.0f} minutes in total, "
                      f"on these setups: {setups}."))
    parts = [folder / "parts" / f"{name}.txt" for name in NAMES]
    page = "\n".join([head] + [part.read_text() for part in parts if part.exists()])
    (folder / "README.md").write_text(page)


if __name__ == "__main__":
    main()
