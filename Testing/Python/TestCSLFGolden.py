# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""The golden files as the reader in Utilities, which has nothing of CSLF's, reads them: the texels
that lie beside them, to the last bit.

usage: TestCSLFGolden.py [--make FILE...]

--make writes the texels beside new golden files instead."""
import concurrent.futures
import glob
import gzip
import os
import shutil
import sys

SKIPPED = 125
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
GOLDEN = os.path.join(ROOT, "Testing", "Data", "Golden")


def list_bytes(read_light_field, path):
    """The bytes of some viewpoints' texels, fewer for larger fields."""
    texels, _ = read_light_field(path)
    step = 5 if texels["Color"].shape[1] < 64 else 12
    arrays = [texels[name][::step] for name in ("Color", "Depth") if name in texels]
    # Numbers have their low bytes first.
    return b"".join(array.astype(array.dtype.newbyteorder("<")).tobytes() for array in arrays)


def name_texels(path):
    return os.path.splitext(path)[0] + ".texels.gz"


def make(read_light_field, paths):
    for path in paths:
        with open(name_texels(path), "wb") as file:
            file.write(gzip.compress(list_bytes(read_light_field, path), mtime=0))


def compare(read_light_field):
    """The golden files whose texels differ, and how many there are."""
    paths = sorted(glob.glob(os.path.join(GOLDEN, "*.m[pk][4v]")))
    different = []
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = pool.map(lambda path: list_bytes(read_light_field, path), paths)
    for path, texels in zip(paths, found):
        with gzip.open(name_texels(path)) as file:
            equal = texels == file.read()
        print(os.path.basename(path), "equal" if equal else "DIFFERENT")
        if not equal:
            different.append(os.path.basename(path))
    return different, len(paths)


def main():
    try:
        import numpy  # pylint: disable=import-outside-toplevel,unused-import
    except ImportError:
        print("There is no numpy: skipped.")
        return SKIPPED
    if not shutil.which("ffmpeg") or not shutil.which("ffprobe"):
        print("There is no ffmpeg: skipped.")
        return SKIPPED
    sys.path.insert(0, os.path.join(ROOT, "Utilities"))
    from read_light_field import read_light_field  # pylint: disable=import-outside-toplevel
    if sys.argv[1:2] == ["--make"]:
        make(read_light_field, sys.argv[2:])
        return 0
    different, count = compare(read_light_field)
    if different or count == 0:
        print("ERROR: %d of %d files differ" % (len(different), count))
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
