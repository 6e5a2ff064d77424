# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""On several ranks, a field whose viewpoints one rank cannot read is reported and not shown, nor
saved, and all ranks go on. Argument: a coded field."""
import os
import shutil
import sys

import cslf
import mpi4py.MPI
from cslfparaview import *

check(mpi4py.MPI.COMM_WORLD.Get_size() == 2, "this test is for two ranks")
decoder = cslf.vtkCSLFDecoder()
decoder.SetFileName(sys.argv[1])
writer = cslf.vtkCSLFImageWriter()
writer.SetInputConnection(decoder.GetOutputPort())
for name in ("whole", "half"):
    shutil.rmtree(name, ignore_errors=True)
    writer.SetFileName(os.path.abspath(name))
    check(writer.Write() == 1, "the folder was not written")
# The second rank reads the second half of the 24 viewpoints, and the one before it.
for viewpoint in range(11, 24):
    os.remove(f"half/{viewpoint:06d}.Color.png")

view = make_view()
reader = CSLFCubeMapReader(FileName=os.path.abspath("whole"))
Show(reader, view)
ResetCamera(view)
check(take_picture(view, "before.png").max() > 50, "a whole field is not shown")

reader.FileName = os.path.abspath("half")
with Errors() as errors:
    picture = take_picture(view, "half.png")
check(picture.max() == 0, "a field with half of its viewpoints is shown")
check(any("is not shown. Rank 1 has failed" in text for text in errors.messages),
      f"messages: {errors.messages}")
with Errors() as errors:
    try:
        SaveData("half.mp4", proxy=reader, Preset="ultrafast")
    except (AttributeError, RuntimeError):
        pass
check(not os.path.exists("half.mp4"), "half of a field is saved")
check(errors.messages, "no message about a field that is not saved")

# The same reader shows and saves a whole field.
reader.FileName = os.path.abspath("whole")
after = take_picture(view, "after.png")
check(psnr(after, read_picture("before.png")) > 60, "a whole field is not shown afterwards")
SaveData("whole.mp4", proxy=reader, Preset="ultrafast")
check(os.path.getsize("whole.mp4") > 1000, "a whole field is not saved afterwards")
