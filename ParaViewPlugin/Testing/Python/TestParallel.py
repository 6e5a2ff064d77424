# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Fields of distributed input are the same files, byte for byte, on any number of ranks, and give the
same picture. First run on several ranks, which also writes the input, a piece for each; then on one,
which compares."""
import os

import mpi4py.MPI
from cslfparaview import *

rank = mpi4py.MPI.COMM_WORLD.Get_rank()
serial = mpi4py.MPI.COMM_WORLD.Get_size() == 1
name = "serial" if serial else "parallel"


def make_contour():
    """Divided like the pieces of its image data."""
    return Contour(Input=Wavelet(), ContourBy=["POINTS", "RTData"], Isosurfaces=[150.0])


def save(scene, kind, **parameters):
    """Bakes a scene into a file and returns the field."""
    field = bake(scene, Viewpoints=3, Resolution=32, **parameters)
    SaveData(f"{kind}-{name}.mp4", proxy=field, Lossless=1, Preset="ultrafast")
    return field


if not serial:
    # Binary: with newer expat, ParaView 5.11 cannot read all files of appended data.
    SaveData("scene.pvtp", proxy=make_scene(), DataMode="Binary")
field = save(OpenDataFile(os.path.abspath("scene.pvtp")), "pieces")
save(make_contour(), "contour")
save(make_contour(), "cached", Integrator="Radiance Caching", CacheSamples=64)
view = make_view()
Show(field, view)
look(view)
SaveScreenshot(name + ".png", view, ImageResolution=[SIZE, SIZE])
if serial:
    for kind in ("pieces", "contour", "cached"):
        files = [open(f"{kind}-{n}.mp4", "rb").read() for n in ("serial", "parallel")]
        check(files[0] == files[1], f"the files differ: {kind}")
    quality = psnr(read_picture("serial.png"), read_picture("parallel.png"))
    check(read_picture("serial.png").max() > 50, "the picture is empty")
    check(quality > 60, f"the pictures differ: {quality} dB")
