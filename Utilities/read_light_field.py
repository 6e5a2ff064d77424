#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Reads a coded light field as Documentation/FileFormat.md describes it, without CSLF.

usage: read_light_field.py FILE [-o TEXELS.npz] [--compare TEXELS.npz]

FFmpeg's commands give the samples of the video tracks, numpy does the rest. Depth and
colour that are computed from a geometry take about a second per viewpoint. Checksums of the description, of its parts, of
the parameter sets and of all groups are checked. The texels are the
arrays "Color" (viewpoint, row, column, 4), as bytes or float32, and "Depth" (viewpoint, row,
column), as uint16, row 0 on top. --compare ends with 1 where any texel differs.
"""
import argparse
import base64
import json
import re
import struct
import subprocess
import sys
import zlib

import numpy

import read_geometry

TILES = 5
FRAME_RATE = 25
FAR = 65535
FORMAT = 2
TAGS = ("comment", "description")
MARK = bytes.fromhex("0d5f9a6e5b1c4e279c836a1fd240b735")  # of units with bytes for CSLF
ROLES = ("color", "coverage", "depth", "depth-high", "depth-low")


class Fault(Exception):
    """An error in a file."""


def require(condition, fault):
    if not condition:
        raise Fault(fault)


def run(*command):
    """The output of one of FFmpeg's commands."""
    result = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, check=False)
    require(result.returncode == 0, command[0] + " fails")
    return result.stdout


def probe(path):
    """The container's tags and its video streams, with the times of their packets."""
    entries = "format_tags:stream=index,codec_name,codec_type,pix_fmt:packet=stream_index,pts_time"
    found = json.loads(run("ffprobe", "-v", "error", "-of", "json", "-show_entries", entries, path))
    for stream in found["streams"]:
        stream["times"] = sorted(float(packet["pts_time"]) for packet in found["packets"]
                                 if packet["stream_index"] == stream["index"])
    tags = {name.lower(): text for name, text in found["format"].get("tags", {}).items()}
    return tags, [stream for stream in found["streams"] if stream["codec_type"] == "video"]


# The description.


def read_sealed(text):
    """The JSON of a tag's text of format 2, or nothing."""
    match = re.fullmatch(r"CSLF (\d+) ([0-9a-f]{8}) (.*)", text, re.DOTALL)
    if not match:
        return None
    require(int(match[1]) == FORMAT, "it has format " + match[1])
    return match[3] if zlib.crc32(match[3].encode()) == int(match[2], 16) else None


def read_version_1(text):
    """Format 1: the checksum is one of the JSON's keys, over a canonical form of the others."""
    header = json.loads(text)
    checksum = header.pop("checksum")
    canonical = json.dumps(header, sort_keys=True, separators=(",", ":"), ensure_ascii=False)
    require(zlib.crc32(canonical.encode()) == checksum, "its description is damaged")
    require(header["version"] == 1 and header["coding"]["version"] == 1, "it has another version")
    for track in header["coding"]["tracks"]:
        transfer = track.get("transfer")
        if transfer == "mu-law-40":
            track.update(transfer="mu-law", mu=40)
        elif transfer == "smpte2084":
            track.update(reference_white=203)
        if track["role"] == "coverage":
            track["tolerance"] = 0 if track["lossless"] else 8
    return header


def read_header(tags):
    texts = [tags.get(name, "") for name in TAGS]
    if not any(text.startswith("CSLF ") for text in texts):
        return read_version_1(texts[0])
    copies = [read_sealed(text) for text in texts]
    whole = [copy for copy in copies if copy is not None]
    require(whole, "its description is damaged")
    if len(whole) < len(copies):
        print("One copy of the description is damaged.", file=sys.stderr)
    header = json.loads(whole[0])
    require(header["version"][0] == FORMAT, "it has another format")
    computes = "from_geometry" in header["coding"]
    require(header.get("required", []) == (["geometry"] if computes else []),
            "it requires features that this reader does not support")
    for track in header["coding"]["tracks"]:
        crcs = base64.b64decode(track["crc"], validate=True)
        track["crc"] = numpy.frombuffer(crcs, ">u4").tolist()
    return header


def read_parts(header, tags, carried):
    """The other parts of a file: (type, name, bytes), without damaged ones. `carried` are the bytes
    in the first picture."""
    places, parts = {}, []
    for part in header.get("parts", []):
        if "frame" in part:
            require(part["frame"] == 0, "it has parts elsewhere")
            data, carried = carried[:part["bytes"]], carried[part["bytes"]:]
        else:
            size = (part["bytes"] + 2) // 3 * 4
            place = places.get(part["tag"], 0)
            places[part["tag"]] = place + size + 1
            try:
                data = base64.b64decode(tags.get(part["tag"], "")[place:place + size],
                                        validate=True)
            except ValueError:
                data = b""
        if len(data) == part["bytes"] and zlib.crc32(data) == part["crc"]:
            parts.append((part["type"], part["name"], data))
        else:
            print("A part of type %s is damaged." % part["type"], file=sys.stderr)
    return parts


def list_slices(order, count):
    """The viewpoint (z) of each frame."""
    slices = [start + step * k for start, step, times in order for k in range(times)]
    require(sorted(slices) == list(range(count)), "its order is not each viewpoint once")
    return slices


# Coded data, for the checksums.


def split_units(stream):
    """The NAL units of a stream with start codes."""
    for unit in re.split(b"\x00\x00\x01", stream)[1:]:
        yield unit.rstrip(b"\x00")


def split_open_units(stream):
    """Type and payload of AV1's open bitstream units, all of which state their sizes."""
    place = 0
    while place < len(stream):
        kind = stream[place] >> 3 & 15
        place += 2 if stream[place] & 4 else 1
        size = shift = 0
        while True:
            byte = stream[place]
            place += 1
            size |= (byte & 127) << shift
            shift += 7
            if byte < 128:
                break
        yield kind, stream[place:place + size]
        place += size


def unpack_message(unit):
    """What a unit of supplemental enhancement information carries for CSLF."""
    message = re.sub(b"\x00\x00\x03", b"\x00\x00", unit).rstrip(b"\x00")
    size, place = 0, 1
    while message[place] == 255:
        size += 255
        place += 1
    size += message[place]
    content = message[place + 1:place + 1 + size]
    require(message[0] == 5 and content.startswith(MARK) and message[place + 1 + size:] == b"\x80",
            "it has unknown units")
    return content[len(MARK):]


def list_parts(codec, stream):
    """The data of checksums: ("sets", bytes), ("frame", bytes) for first units, ("more", bytes);
    and ("carried", bytes)."""
    if codec == "av1":
        is_first = True
        for kind, payload in split_open_units(stream):
            if kind == 2:  # temporal delimiter
                is_first = True
            elif kind == 1:
                yield "sets", payload
            elif kind in (3, 4, 6):
                yield "frame" if is_first else "more", payload
                is_first = False
            elif kind == 5:
                content = payload.rstrip(b"\x00")
                require(content.startswith(b"\x04\xff\xff" + MARK) and content.endswith(b"\x80"),
                        "it has unknown units")
                yield "carried", content[3 + len(MARK):-1]
        return
    is_hevc = codec == "hevc"
    for unit in split_units(stream):
        kind = unit[0] >> 1 & 63 if is_hevc else unit[0] & 31
        if kind in ((32, 33, 34) if is_hevc else (7, 8)):
            yield "sets", unit
        elif kind == (39 if is_hevc else 6):
            yield "carried", unpack_message(unit[2 if is_hevc else 1:])
        elif kind < 32 if is_hevc else 1 <= kind <= 5:
            # The first bit of a slice's header is that of the first slice in a picture.
            yield "frame" if unit[2 if is_hevc else 1] & 128 else "more", unit


def check_track(path, index, track, groups):
    """Compares the checksums of parameter sets and groups with the header's. The bytes that the
    first picture carries."""
    codec = track["codec"]
    # FFmpeg omits the filter if the first unit's length looks like a start code.
    options = [] if codec == "av1" else ["-bsf:v", codec + "_mp4toannexb"]
    stream = run("ffmpeg", "-v", "error", "-i", path, "-map", "0:%d" % index, "-c", "copy",
                 *options, "-f", "obu" if codec == "av1" else codec, "-")
    starts = numpy.cumsum([0] + groups)
    crcs = [0] * len(groups)
    sets = 0
    carried = b""
    frame = -1
    for kind, data in list_parts(codec, stream):
        if kind == "sets":
            sets = zlib.crc32(data, sets) if frame < 0 else sets
            continue
        if kind == "carried":
            carried += data if frame < 0 else b""
            continue
        frame += kind == "frame"
        require(frame < starts[-1], "it has too many frames")
        group = int(numpy.searchsorted(starts, frame, "right")) - 1
        crcs[group] = zlib.crc32(data, crcs[group])
    require(sets == track["parameter_sets_crc"], "the parameter sets of a track are damaged")
    require(crcs == track["crc"], "a group is damaged")
    return carried


# Samples.


def read_planes(path, stream, size, count):
    """Luma or green, and the other planes, of all frames of a stream."""
    columns, rows = TILES * size, size
    times = stream["times"]
    numbers = [round((time - times[0]) * FRAME_RATE) for time in times]
    require(numbers == list(range(count)), "its frames have other times")
    raw = run("ffmpeg", "-v", "error", "-i", path, "-map", "0:%d" % stream["index"], "-fps_mode",
              "passthrough", "-f", "rawvideo", "-")
    kind = stream["pix_fmt"]
    deep = re.search(r"1[02](le|be)$", kind)
    samples = numpy.frombuffer(raw, {"le": "<u2", "be": ">u2"}[deep[1]] if deep else "u1")
    samples = samples.reshape(count, -1)
    shapes = [(rows, columns)]
    if "420" in kind:
        shapes += 2 * [(rows // 2, columns // 2)]
    elif "422" in kind:
        shapes += 2 * [(rows, columns // 2)]
    elif not kind.startswith("gray"):
        shapes += 2 * [(rows, columns)]
    planes, place = [], 0
    for shape in shapes:
        end = place + shape[0] * shape[1]
        planes.append(samples[:, place:end].reshape(count, *shape).astype(numpy.int64))
        place = end
    require(place == samples.shape[1], "its frames have another size")
    return planes


def nearest(numbers):
    """The nearest integers, halves away from zero."""
    numbers = numpy.asarray(numbers)
    return (numpy.sign(numbers) * numpy.floor(numpy.abs(numbers) + 0.5)).astype(numpy.int64)


def spread(plane, track, size):
    """Subsampled chroma at full resolution, with samples 16 times as large."""
    views, rows, columns = plane.shape
    if rows < size:
        row = numpy.arange(size)
        far = numpy.clip(row // 2 + numpy.where(row % 2 == 0, -1, 1), 0, rows - 1)
        sums = 3 * plane[:, row // 2] + plane[:, far]
    else:
        sums = 4 * plane
    sums = sums.reshape(views, size, TILES, size // 2)
    before = numpy.concatenate([sums[..., :1], sums[..., :-1]], axis=-1)
    after = numpy.concatenate([sums[..., 1:], sums[..., -1:]], axis=-1)
    even, odd = (4, 2) if track.get("chroma_location") == "left" else (3, 3)
    both = [even * sums + (4 - even) * before, odd * sums + (4 - odd) * after]
    return numpy.stack(both, axis=-1).reshape(views, size, 2 * columns)


def to_colors(planes, track, size, peak, fraction):
    """Red, green and blue from 0 to a peak."""
    if track["pixel_format"] == "gbrp":
        return numpy.stack([planes[2], planes[0], planes[1]], axis=-1)
    bits = track["bits"]
    luma, blue, red = planes
    scale = 1
    if blue.shape != luma.shape:
        scale = 16
        blue, red = (spread(plane, track, size) for plane in (blue, red))
    level = peak / (2**bits - 1) * 2**fraction
    chroma = level / scale
    weights = nearest([level, 1.5748 * chroma, -0.2126 * 1.5748 / 0.7152 * chroma,
                       -0.0722 * 1.8556 / 0.7152 * chroma, 1.8556 * chroma])
    middle = scale * 2**(bits - 1)
    gray = weights[0] * luma + 2**(fraction - 1)
    blue = blue - middle
    red = red - middle
    colors = [gray + weights[1] * red, gray + weights[2] * red + weights[3] * blue,
              gray + weights[4] * blue]
    return numpy.clip(numpy.stack(colors, axis=-1) >> fraction, 0, peak)


def list_radiances(white):
    """The radiance of each code of 16 bits (SMPTE ST 2084)."""
    m1, m2, c1, c2, c3 = 2610 / 16384, 2523 / 32, 3424 / 4096, 2413 / 128, 2392 / 128
    power = (numpy.arange(65536) / 65535.0)**(1 / m2)
    luminance = (numpy.maximum(power - c1, 0.0) / (c2 - c3 * power))**(1 / m1)
    radiances = (10000 / 203 * luminance).astype(numpy.float32)
    return radiances * numpy.float32(203 / white)


def list_depths(track):
    """The depth of each code."""
    most = 2**track["bits"] - 1
    codes = numpy.arange(most + 1)
    if track.get("transfer") != "mu-law":
        return (65535 * codes + most // 2) // most
    mu = track["mu"]
    return numpy.floor(65535 * numpy.expm1(codes / most * numpy.log1p(mu)) / mu + 0.5)


def read_light_field(path):
    """The arrays of a file, by name, and its parts."""
    tags, streams = probe(path)
    header = read_header(tags)
    require(header["format"] == "cube surface light field", "it is not a light field")
    coding, size = header["coding"], header["resolution"]
    count = 6 * len(header["nodes"])**2
    slices = list_slices(coding["order"], count)
    groups = [length for length, times in coding["groups"] for _ in range(times)]
    require(sum(groups) == count, "its groups are not its viewpoints")
    codecs = {track["codec"] for track in coding["tracks"]}
    streams = [stream for stream in streams if stream["codec_name"] in codecs]
    require(len(streams) >= len(coding["tracks"]), "it lacks a track")
    names = coding.get("from_geometry", [])
    # If the geometry tells everything, the other groups are computed.
    coded = groups[:1] if "all" in names else groups
    tracks, planes, carried = {}, {}, b""
    for stream, track in zip(streams, coding["tracks"]):
        if track["role"] not in ROLES:
            print("A track is of an unknown kind: " + track["role"], file=sys.stderr)
            continue
        found = check_track(path, stream["index"], track, coded)
        carried = carried if tracks else found
        tracks[track["role"]] = track
        planes[track["role"]] = [
            numpy.concatenate([plane, numpy.zeros((count - sum(coded), *plane.shape[1:]), int)])
            for plane in read_planes(path, stream, size, sum(coded))]
    parts = read_parts(header, tags, carried)
    computed = exact = None
    if names:
        computed, exact = compute_texels(header, parts, slices)
        if "coverage" in names:
            tracks["coverage"] = {"tolerance": 0}
            planes["coverage"] = [numpy.where(computed < FAR, 255, 0)]
    texels = make_texels(tracks, planes, size, slices, computed,
                         exact if "color" in names else None, "all" in names)
    return texels, parts


def compute_texels(header, parts, slices):
    """The depths that the viewpoints of the frames see of the field's geometry, and the exact
    colours."""
    found = [data for kind, name, data in parts
             if kind == read_geometry.TYPE and name == "geometry"]
    require(found, "it has no geometry")
    points, corners, colors, maps, _ = read_geometry.read_geometry(found[0])
    viewer = read_geometry.Viewer(points, corners, colors, maps, header["nodes"],
                                  header["base_nodes"],
                                  header["resolution"])
    return tuple(numpy.stack(parts) for parts in zip(*(viewer.see(z) for z in slices)))


def make_texels(tracks, planes, size, slices, depth, exact, is_all):
    """`depth` and `exact` are what was computed, or None. `is_all`: no other colours count."""
    color = tracks["color"]
    is_float = color.get("transfer") == "smpte2084"
    shape = (len(slices), size, TILES * size)
    coverage = numpy.full(shape, 255, numpy.int64)
    if "coverage" in tracks:
        coverage = planes["coverage"][0].copy()
        tolerance = tracks["coverage"]["tolerance"]
        coverage[coverage <= tolerance] = 0
        coverage[coverage >= 255 - tolerance] = 255
    texels = {}
    if is_float:
        codes = to_colors(planes["color"], color, size, 65535, 14)
        colors = list_radiances(color["reference_white"])[codes]
        colors[coverage == 0] = 0
        alpha = coverage.astype(numpy.float32) / numpy.float32(255)
    else:
        colors = to_colors(planes["color"], color, size, 255, 20)
        colors = numpy.minimum(colors, coverage[..., None])
        if exact is not None:
            shown = numpy.floor(coverage[..., None] * exact[..., :3] / 255 + 0.5).astype(int)
            colors = numpy.where(exact[..., 3:] > 0, shown, 0 if is_all else colors)
        colors = colors.astype(numpy.uint8)
        alpha = coverage.astype(numpy.uint8)
    texels["Color"] = numpy.concatenate([colors, alpha[..., None]], axis=-1)
    if "depth" in tracks:
        depth = list_depths(tracks["depth"])[planes["depth"][0]]
    elif "depth-high" in tracks:
        depth = 256 * planes["depth-high"][0] + planes["depth-low"][0]
    if depth is not None:
        texels["Depth"] = numpy.where(coverage == 0, FAR, depth).astype(numpy.uint16)
    # Converts the order of the frames to that of the viewpoints.
    places = numpy.argsort(slices)
    return {name: array[places] for name, array in texels.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file")
    parser.add_argument("-o", "--output", help="write the texels")
    parser.add_argument("--compare", help="compare with such texels")
    arguments = parser.parse_args()
    try:
        texels, parts = read_light_field(arguments.file)
    except (Fault, IndexError, KeyError, TypeError, ValueError, struct.error,
            zlib.error) as fault:
        raise SystemExit("%s: %s" % (arguments.file, fault)) from fault
    for name, array in texels.items():
        print(name, array.dtype, array.shape, "CRC-32 %08x" % zlib.crc32(array.tobytes()))
    for kind, name, data in parts:
        print("part", kind, name, len(data), "bytes")
    if arguments.output:
        numpy.savez_compressed(arguments.output, **texels)
    if arguments.compare:
        with numpy.load(arguments.compare) as other:
            equal = set(other.files) == set(texels) and all(
                numpy.array_equal(other[name], texels[name]) for name in texels)
        print("The texels are the same." if equal else "The texels differ.")
        return 0 if equal else 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
