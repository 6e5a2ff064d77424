#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Compares the colour track of vtkCSLFEncoder's files with the usual ways to code a video.

usage: measure-coding.py FIELD FOLDER [--crfs 20,26,32,38]

FIELD is a light field, best a lossless one, FOLDER where the files and coding.json go. Each of the
peers is one stream of all viewpoints, coded by FFmpeg's libx265 as 4:4:4 of 8 bits and with the
encoder's matrix:

  raster       z order, x265's preset medium and its defaults
  serpentine   every second row of viewpoints backwards, preset medium, psycho-visual options and
               adaptive quantisation off

Bytes are those of colour alone; PSNR is that of red, green and blue of 8 bits over black, one mean
square error over all texels. The delta rate is Bjontegaard's (ITU-T VCEG-M33), with a cubic
polynomial of the logarithm of bytes over PSNR, over the PSNR that both reach.

Needs ffmpeg with libx265 and zscale, numpy, and the Python package cslf.
"""
import argparse
import json
import os
import subprocess

import numpy
from cslf import vtkCSLFDecoder, vtkCSLFEncoder
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline

PEERS = {
    "raster": "",
    "serpentine": ":psy-rd=0:psy-rdoq=0:aq-mode=0",
}
SLAB = 64  # viewpoints read at once
TO_VIDEO = "zscale=matrixin=gbr:rangein=full:matrix=709:range=full,format=yuv444p"
TO_COLOR = "zscale=matrixin=709:rangein=full:matrix=gbr:range=full,format=gbrp,format=rgb24"


def read_colors(field, path):
    """The field's red, green and blue over black in a file: an array (viewpoint, y, x, colour)."""
    decoder = vtkCSLFDecoder()
    decoder.SetFileName(field)
    decoder.UpdateInformation()
    extent = decoder.GetOutputInformation(0).Get(Pipeline.WHOLE_EXTENT())
    width, height, views = (extent[k + 1] - extent[k] + 1 for k in (0, 2, 4))
    colors = numpy.memmap(path, numpy.uint8, "w+", shape=(views, height, width, 3))
    for first in range(0, views, SLAB):
        last = min(first + SLAB, views) - 1
        decoder.UpdateExtent((*extent[:4], extent[4] + first, extent[4] + last))
        color = vtk_to_numpy(decoder.GetOutput().GetPointData().GetArray("Color"))
        colors[first:last + 1] = color.reshape(-1, height, width, 4)[..., :3]
    return colors


def order_views(name, views):
    """The viewpoints (z) in the order used for other encoders."""
    side = round((views / 6)**0.5)
    order = numpy.arange(views).reshape(6, side, side)
    if name == "serpentine":
        order[:, 1::2] = order[:, 1::2, ::-1].copy()
    return order.ravel()


def code(colors, order, options, crf, path):
    """One stream of all viewpoints."""
    views, height, width, _ = colors.shape
    command = ["ffmpeg", "-v", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s",
               "%dx%d" % (width, height), "-r", "30", "-i", "-", "-vf", TO_VIDEO, "-c:v",
               "libx265", "-preset", "medium", "-crf", str(crf), "-x265-params",
               "log-level=error:info=0:range=full:colormatrix=bt709" + options, path]
    with subprocess.Popen(command, stdin=subprocess.PIPE) as process:
        for view in order:
            process.stdin.write(colors[view].tobytes())
    if process.returncode:
        raise SystemExit("FFmpeg could not code " + path)


def compute_psnr(colors, order, path):
    """The PSNR of the colours of a stream, in dB."""
    views, height, width, _ = colors.shape
    command = ["ffmpeg", "-v", "error", "-i", path, "-vf", TO_COLOR, "-f", "rawvideo", "-"]
    squares = 0
    with subprocess.Popen(command, stdout=subprocess.PIPE) as process:
        for view in order:
            frame = numpy.frombuffer(process.stdout.read(colors[view].size), numpy.uint8)
            error = frame.astype(numpy.int32) - colors[view].ravel()
            squares += int(numpy.dot(error, error))
    return 10 * numpy.log10(255**2 * colors.size / squares)


def measure_peer(name, colors, crf, folder):
    path = os.path.join(folder, "%s-%g.hevc" % (name, crf))
    order = order_views(name, len(colors))
    code(colors, order, PEERS[name], crf, path)
    return os.path.getsize(path), compute_psnr(colors, order, path)


def measure_encoder(field, crf, folder):
    path = os.path.join(folder, "encoder-%g.mp4" % crf)
    decoder = vtkCSLFDecoder()
    decoder.SetFileName(field)
    encoder = vtkCSLFEncoder()
    encoder.SetInputConnection(decoder.GetOutputPort())
    encoder.SetFileName(path)
    encoder.GetRateControl().SetCRF(crf)
    encoder.GetRateControl().SetDepthCRF(51)  # not measured
    if not encoder.Write():
        raise SystemExit("The encoder could not write " + path)
    result = vtkCSLFDecoder()
    result.SetFileName(path)
    result.UpdateInformation()
    return result.GetTrackBytes(0), encoder.GetActualPSNR()


def compute_delta_rate(reference, tested):
    """The relative difference of the tested curve's bytes from the reference's at equal PSNR."""
    curves = []
    for curve in (reference, tested):
        rates, psnr = numpy.array(curve).T
        curves.append((numpy.polyfit(psnr, numpy.log(rates), min(3, len(psnr) - 1)), psnr))
    low = max(psnr.min() for _, psnr in curves)
    high = min(psnr.max() for _, psnr in curves)
    means = []
    for polynomial, _ in curves:
        integral = numpy.polyint(polynomial)
        means.append((numpy.polyval(integral, high) - numpy.polyval(integral, low)) / (high - low))
    return float(numpy.exp(means[1] - means[0]) - 1)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("field")
    parser.add_argument("folder")
    parser.add_argument("--crfs", default="20,26,32,38")
    arguments = parser.parse_args()
    os.makedirs(arguments.folder, exist_ok=True)
    crfs = [float(crf) for crf in arguments.crfs.split(",")]
    colors = read_colors(arguments.field, os.path.join(arguments.folder, "colors.rgb"))
    curves = {"encoder": [], **{name: [] for name in PEERS}}
    for crf in crfs:
        for name, curve in curves.items():
            if name == "encoder":
                curve.append(measure_encoder(arguments.field, crf, arguments.folder))
            else:
                curve.append(measure_peer(name, colors, crf, arguments.folder))
            print("%-12s CRF %-4g %12d bytes %8.3f dB" % (name, crf, *curve[-1]), flush=True)
    deltas = {name: compute_delta_rate(curves[name], curves["encoder"]) for name in PEERS}
    for name, delta in deltas.items():
        print("bytes against %-12s %+.1f %%" % (name, 100 * delta))
    with open(os.path.join(arguments.folder, "coding.json"), "w") as file:
        json.dump({"field": arguments.field, "crfs": crfs, "curves": curves, "deltas": deltas},
                  file, indent=1)


if __name__ == "__main__":
    main()
