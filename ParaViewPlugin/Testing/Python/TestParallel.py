# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A field of distributed input has the same samples, and picture, for any number of ranks. First run on
several ranks, which also writes the input, a piece for each; then on one, which compares."""
import os

import mpi4py.MPI
from cslfparaview import *

serial = mpi4py.MPI.COMM_WORLD.Get_size() == 1
name = "serial" if serial else "parallel"
if not serial:
    SaveData("scene.pvtp", proxy=make_scene())
scene = OpenDataFile(os.path.abspath("scene.pvtp"))
field = bake(scene, Viewpoints=3, Resolution=32)
SaveData(name + ".mp4", proxy=field, Lossless=1, Preset="ultrafast")
view = make_view()
Show(field, view)
look(view)
SaveScreenshot(name + ".png", view, ImageResolution=[SIZE, SIZE])
if serial:
    # The files differ in the fingerprint of the scene only, which tells the pieces apart.
    fields = [OpenDataFile(os.path.abspath(n)) for n in ("serial.mp4", "parallel.mp4")]
    for array in ("Color", "Depth"):
        check((fetch_array(fields[0], array) == fetch_array(fields[1], array)).all(),
              f"the fields differ: {array}")
    quality = psnr(read_picture("serial.png"), read_picture("parallel.png"))
    check(read_picture("serial.png").max() > 50, "the picture is empty")
    check(quality > 60, f"the pictures differ: {quality} dB")
