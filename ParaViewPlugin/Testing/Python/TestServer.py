# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""A client of a server shows the same picture as one process: the field delivered to the client, and
drawn by the server. Run by pvpython. Argument: pvserver."""
import subprocess
import sys

from cslfparaview import *


def show():
    """Bakes on the server, or here, and shows the field."""
    view = make_view()
    field = bake(make_scene(), Viewpoints=3, Resolution=32, Samples=4)
    check(Show(field, view).LookupMode == "Geometry", "geometry is not the default")
    UpdatePipeline(proxy=OutputPort(field, 1))
    triangles = field.GetDataInformation(1).GetNumberOfCells()
    check(triangles > 100, f"{triangles} triangles")
    look(view)
    return view


alone = take_picture(show(), "alone.png")
check(alone.max() > 100, "the picture is empty")
server = subprocess.Popen([sys.argv[1], "--server-port=0"], stdout=subprocess.PIPE, text=True)
try:
    port = None
    for line in server.stdout:
        if "Connection URL" in line:
            port = int(line.rsplit(":", 1)[1])
        if "Accepting connection" in line:
            port = int(line.rsplit(":", 1)[1])
            break
    Disconnect()
    Connect("localhost", port)
    view = show()
    for name, threshold in (("delivered.png", 1000), ("remote.png", 0)):
        view.RemoteRenderThreshold = threshold
        quality = psnr(take_picture(view, name), alone)
        check(quality > 60, f"{name}: {quality} dB")
    Disconnect()
finally:
    server.kill()
    server.wait()
