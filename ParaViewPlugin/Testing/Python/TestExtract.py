# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Extract generators bake at chosen time steps."""
import os

from cslfparaview import *

scene = Contour(Input=Wavelet(), ContourBy=["POINTS", "RTData"], Isosurfaces=[150.0])
field = bake(scene, Viewpoints=3, Resolution=32, Samples=4)
extractor = CreateExtractor("CSLF", field, registrationName="light field")
check(extractor is not None, "there is no extractor")
extractor.Writer.FileName = "field_{timestep:03d}.mp4"
extractor.Writer.CRF = 30
extractor.Writer.Preset = "ultrafast"
extractor.Trigger = "TimeStep"
extractor.Trigger.Frequency = 2
animation = GetAnimationScene()
animation.PlayMode, animation.NumberOfFrames = "Sequence", 4
SaveExtracts(ExtractsOutputDirectory=os.path.abspath("extracts"), FrameWindow=[0, 3])
files = sorted(os.listdir("extracts"))
check(files == ["field_000.mp4", "field_002.mp4"], f"extracts {files}")
check(fetch_array(OpenDataFile("extracts/field_002.mp4"), "Color").any(), "it is empty")
