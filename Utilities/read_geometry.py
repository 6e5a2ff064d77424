# SPDX-FileCopyrightText: Copyright (c) CSLF contributors
# SPDX-License-Identifier: BSD-3-Clause
"""Reads the geometry of a coded light field as Documentation/FileFormat.md describes it, without
CSLF, and computes the depth and the exact colours that viewpoints see of it."""
import json
import struct
import zlib

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkJPEGReader

TYPE = "model/vnd.cslf.geometry"
NOTHING = 65535  # the depth where a texel sees no triangle
FACES = (  # the axes of sc and tc, and the normal
    ((0, 0, -1), (0, -1, 0), (1, 0, 0)), ((0, 0, 1), (0, -1, 0), (-1, 0, 0)),
    ((1, 0, 0), (0, 0, 1), (0, 1, 0)), ((1, 0, 0), (0, 0, -1), (0, -1, 0)),
    ((1, 0, 0), (0, -1, 0), (0, 0, 1)), ((-1, 0, 0), (0, -1, 0), (0, 0, -1)))
AT_ONCE = 1 << 22  # pairs of a texel and a triangle


# The bitstreams of EXT_meshopt_compression.


class Corners:
    """The mode TRIANGLES, version 1."""

    def __init__(self, stream, triangles):
        if stream[0] != 0xe1:
            raise ValueError("its corners have another version")
        self.edges = [(0, 0)] * 16
        self.points = [0] * 16
        self.edge = self.point = self.next = self.last = 0
        self.stream = stream
        self.place = 1 + triangles
        table = stream[-16:]
        self.corners = [self.read_triangle(code, table) for code in stream[1:1 + triangles]]
        if self.place + 16 != len(stream):
            raise ValueError("its corners are damaged")

    def read_triangle(self, code, table):
        if code < 0xf0:
            a, b = self.edges[(self.edge - 1 - (code >> 4)) & 15]
            c = self.read_third(code & 15)
            self.keep_edges((c, b), (a, c))
            return a, b, c
        if code < 0xfe:
            kinds = 0, table[code & 15] >> 4, table[code & 15] & 15
        else:
            both = self.stream[self.place]
            self.place += 1
            if both == 0:
                self.next = 0
            kinds = 0 if code == 0xfe else 15, both >> 4, both & 15
        before, start = list(self.points), self.point
        # New points come before those that the stream states.
        corners = [self.take_next() if kind == 0 else before[(start - kind) & 15]
                   for kind in kinds]
        for k, kind in enumerate(kinds):
            if kind == 15:
                corners[k] = self.read_point()
            if kind in (0, 15):
                self.keep_point(corners[k])
        a, b, c = corners
        self.keep_edges((b, a), (c, b), (a, c))
        return a, b, c

    def read_third(self, kind):
        """The corner opposite a known edge."""
        if 0 < kind < 13:
            return self.points[(self.point - 1 - kind) & 15]
        if kind == 0:
            point = self.take_next()
        elif kind < 15:
            point = self.last = self.last + (-1 if kind == 13 else 1)
        else:
            point = self.read_point()
        self.keep_point(point)
        return point

    def take_next(self):
        self.next += 1
        return self.next - 1

    def read_point(self):
        """The next number is the difference to the last such point."""
        number = shift = 0
        while True:
            byte = self.stream[self.place]
            self.place += 1
            number |= (byte & 127) << shift
            shift += 7
            if byte < 128:
                break
        self.last += (number >> 1) ^ -(number & 1)
        return self.last

    def keep_point(self, point):
        self.points[self.point] = point
        self.point = (self.point + 1) & 15

    def keep_edges(self, *edges):
        for edge in edges:
            self.edges[self.edge] = edge
            self.edge = (self.edge + 1) & 15


def read_group(stream, place, kind):
    """16 bytes of one kind, and where the next group begins."""
    if kind == 0:
        return [0] * 16, place
    if kind == 3:
        return list(stream[place:place + 16]), place + 16
    bits = 2 * kind
    escape = (1 << bits) - 1
    more = place + 2 * bits
    numbers = []
    for byte in stream[place:more]:
        for shift in range(8 - bits, -1, -bits):
            number = byte >> shift & escape
            if number == escape:
                number = stream[more]
                more += 1
            numbers.append(number)
    return numbers, more


def read_attributes(stream, points, size):
    """The mode ATTRIBUTES, version 0: `size` bytes for each point."""
    if stream[0] != 0xa0:
        raise ValueError("its points have another version")
    last = numpy.frombuffer(stream[-size:], "u1")
    most = min(8192 // size & ~15, 256)
    place = 1
    blocks = []
    for first in range(0, points, most):
        count = min(most, points - first)
        groups = (count + 15) // 16
        block = numpy.empty((count, size), "u1")
        for k in range(size):
            kinds = stream[place:place + (groups + 3) // 4]
            place += len(kinds)
            numbers = []
            for group in range(groups):
                found, place = read_group(stream, place, kinds[group // 4] >> group % 4 * 2 & 3)
                numbers += found
            codes = numpy.array(numbers[:count], "u1")
            steps = (codes >> 1) ^ (0 - (codes & 1)).astype("u1")
            block[:, k] = last[k] + numpy.cumsum(steps, dtype="u1")
        last = block[-1]
        blocks.append(block)
    return numpy.concatenate(blocks)


def read_colors(header, streams):
    """The exact colours of bytes: front and back, point, red, green, blue and whether it is exact;
    nothing if there are none."""
    if header.get("colors") not in ("srgb8", "light8"):
        return None
    count = header["points"]
    if count == 0:
        return numpy.zeros((2, 0, 4), "u1")
    sizes = [header["color_bytes"], header.get("back_color_bytes", 0), header["exact_bytes"]]
    ends = numpy.cumsum(sizes)
    sides = [read_attributes(streams[end - size:end], count, 4) if size else None
             for size, end in zip(sizes, ends)]
    subtracted = header.get("subtracted", ["front"])
    for side in sides[:2]:
        if side is not None and "green" in subtracted:
            side[:, 0] += side[:, 1]
            side[:, 2] += side[:, 1]
    if sides[1] is None:
        sides[1] = sides[0].copy()
        sides[2][:, 1] = sides[2][:, 0]
    elif "front" in subtracted:
        sides[1] += sides[0]
    for k in range(2):
        sides[k][:, 3] = sides[2][:, k]
    return numpy.stack(sides[:2])


def take(stream, count, kind):
    """Numbers whose low bytes come before their high bytes, and what follows them."""
    size = numpy.dtype(kind).itemsize
    planes = numpy.frombuffer(stream[:count * size], "u1").reshape(size, count)
    return numpy.ascontiguousarray(planes.T).view(kind)[:, 0], stream[count * size:]


class Bodies:
    """The bodies of a group: each is the same mesh at another place, with other colours."""

    def __init__(self, header, group, stream, position_bits):
        count = header["sides"] * 3 * group["points"]
        self.size = group["bodies"]
        self.points = group["points"]
        self.sides = header["sides"]
        self.step = header["step"]
        corners, stream = take(stream, 3 * group["triangles"], "<u4")
        points, stream = take(stream, 3 * group["points"], "<i2")
        self.mean, stream = take(stream, count, "<i4")
        vectors = []
        for _ in range(group["vectors"]):
            vector, stream = take(stream, count, "<i2")
            vectors.append(vector)
        self.vectors = numpy.array(vectors, "i8").reshape(-1, count)
        sequences = []
        for k in range(12 + group["vectors"]):
            numbers, stream = take(stream, self.size, "<u2")
            numbers = (numbers >> 1) ^ (0 - (numbers & 1)).astype("u2")
            numbers = numpy.cumsum(numbers, dtype="u2") if k < 12 else numbers
            sequences.append(numbers.view("i2"))
        self.multiples = numpy.array(sequences[12:], "i8").reshape(-1, self.size)
        self.flags = None
        if header["has_exact"]:
            flags, stream = take(stream, 2 * self.points * self.size, "u1")
            self.flags = flags.reshape(2, -1)
        self.rest = stream
        steps = 1 << (position_bits - 1)
        matrices = numpy.array(sequences[:12], float).T.reshape(-1, 3, 4)
        matrices[:, :, 3] /= steps - 1
        matrices[:, :, :3] *= 1.0 / (steps * group["extent"])
        x, y, z = points.reshape(-1, 3).T * group["extent"] / 32767
        m = matrices[:, :, :, None]
        places = m[:, :, 0] * x + m[:, :, 1] * y + m[:, :, 2] * z + m[:, :, 3]
        self.places = numpy.clip(places.transpose(0, 2, 1), -1.0, 1.0).reshape(-1, 3)
        starts = self.points * numpy.arange(self.size)
        triangles = corners.astype(int).reshape(-1, 3)
        mirrored = triangles[:, [0, 2, 1]]
        is_mirrored = (numpy.cross(matrices[:, :, 0], matrices[:, :, 1]) * matrices[:, :, 2]).sum(1) < 0
        self.corners = (numpy.where(is_mirrored[:, None, None], mirrored, triangles)
                        + starts[:, None, None]).reshape(-1, 3)

    def colors(self):
        """Those of the front and the back: point, red, green, blue and whether it is exact."""
        sums = self.mean + self.step * (self.multiples.T @ self.vectors) + (1 << 14)
        codes = numpy.clip(sums >> 15, 0, 255).reshape(self.size, self.sides, self.points, 3)
        sides = [codes[:, min(k, self.sides - 1)].reshape(-1, 3) for k in range(2)]
        return numpy.stack([numpy.concatenate([side, flags[:, None]], axis=1)
                            for side, flags in zip(sides, self.flags)])


def to_linear(codes):
    return numpy.where(codes <= 0.04045, codes / 12.92,
                       (numpy.maximum(codes, 0.04045) / 1.055 + 0.055 / 1.055)**2.4)


def to_encoded(light, most=1.0):
    light = numpy.clip(light, 0.0, most)
    return numpy.where(light <= 0.0031308, 12.92 * light,
                       1.055 * numpy.maximum(light, 0.0031308)**(1.0 / 2.4) - 0.055)


class Image:
    """An image in place of a colour map."""

    def __init__(self, header, encoded):
        width, height = header["size"]
        if header["jpeg"]:
            reader = vtkJPEGReader()
            reader.SetMemoryBuffer(encoded)
            reader.SetMemoryBufferLength(len(encoded))
            reader.Update()
            pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
        else:
            planes = numpy.frombuffer(encoded, "u1").reshape(3, -1)
            pixels = numpy.cumsum(planes, axis=1, dtype="u1").T
        self.pixels = to_linear(pixels.reshape(height, width, 3) / 255.0)
        self.size = numpy.array(header["size"])
        self.repeats = numpy.array(header["repeats"])
        self.steps = header["steps"]
        self.is_smooth = header["smooth"]

    def get(self, pixels):
        """The colours of pixels, of which rows have x and y, linear."""
        wrapped = numpy.where(self.repeats, pixels % self.size,
                              numpy.clip(pixels, 0, self.size - 1)).astype(int)
        return self.pixels[wrapped[:, 1], wrapped[:, 0]]

    def show(self, places):
        """The colours at places, linear."""
        if not self.is_smooth:
            return self.get(numpy.floor(places))
        first = numpy.floor(places - 0.5)
        x, y = (places - 0.5 - first).T[:, :, None]
        return ((1.0 - y) * ((1.0 - x) * self.get(first) + x * self.get(first + (1, 0)))
                + y * ((1.0 - x) * self.get(first + (0, 1)) + x * self.get(first + 1)))


class Maps:
    """Colour maps, and where points lie on them."""

    def __init__(self, header, codes, colors):
        self.maps = header["color_maps"]
        self.light_steps = header["light_steps"]
        light = header["maximum_light"] * numpy.arange(self.light_steps + 1) / self.light_steps
        # Linear light has the precision of floats.
        self.codes = to_encoded(to_linear(light).astype("f4").astype(float), None)
        self.colors = []  # linear; the last one is that of what is not a number; or an image
        self.texture_places = header["values"].get("CSLF:TexturePlaces")
        for one in self.maps:
            if "image" in one:
                size = one["image"]["bytes"]
                self.colors.append(Image(one["image"], colors[:size]))
                colors = colors[size:]
                continue
            count = one["steps"] + 3
            planes = numpy.frombuffer(colors[:4 * count], "u1").reshape(4, count)
            colors = colors[4 * count:]
            self.colors.append(to_linear(numpy.cumsum(planes, axis=1, dtype="u1")[:3].T / 255.0))
        self.numbers = codes[:, 2].astype(int)
        places = codes[:, 0].astype(int) + 256 * codes[:, 1].astype(int)
        self.columns = numpy.zeros(len(codes))
        self.is_none = numpy.zeros(len(codes), bool)
        for number, one in enumerate(self.maps, 1):
            if "image" in one:
                continue
            own = self.numbers == number
            none = (1 << one["bits"]) - 1
            first, last = one["places"]
            columns = first + (last - first) * places[own] / (none - 1)
            inset = 1e-6 * (one["steps"] + 2)
            is_within = (columns >= 1.0) & (columns <= 1.0 + one["steps"])
            columns = numpy.where(
                is_within, numpy.clip(columns, 1.0 + inset, 1.0 + one["steps"] - inset), columns)
            whole = numpy.round(columns)
            columns = numpy.where(numpy.abs(columns - whole) < 1e-7, whole, columns)
            self.is_none[own] = places[own] == none
            self.columns[own] = numpy.where(self.is_none[own], 0.5 * (one["steps"] + 2), columns)

    def show(self, corners, lights, shares):
        """The colours, from 0 to 255, at places of triangles with a map, from the bytes of light of
        their corners."""
        codes = self.codes[numpy.minimum(lights, self.light_steps).astype(int)]
        light = to_linear((shares[..., None] * codes).sum(axis=1))
        columns = numpy.floor((shares * self.columns[corners]).sum(axis=1)).astype(int)
        is_none = (shares * self.is_none[corners]).sum(axis=1) > 0.02
        base = numpy.zeros_like(light)
        for number, colors in enumerate(self.colors, 1):
            own = self.numbers[corners[:, 0]] == number
            if isinstance(colors, Image):
                places = self.texture_places[corners[own]] / colors.steps
                base[own] = colors.show((shares[own, :, None] * places).sum(axis=1))
                continue
            places = numpy.where(is_none, len(colors) - 1, numpy.clip(columns, 0, len(colors) - 2))
            base[own] = colors[places[own]]
        return 255.0 * to_encoded(light * base)


def read_maps(header, streams, rest):
    """The colour maps, or nothing, from the streams of places and what follows the bodies."""
    if header.get("colors") != "light8":
        return None
    sizes = header["place_bytes"], header["body_place_bytes"]
    codes = [read_attributes(streams[first:first + size], count, 4)
             for first, size, count in zip((0, sizes[0]), sizes, count_points(header)) if count]
    return Maps(header, numpy.concatenate(codes), rest)


def read_array(header, streams, counts):
    """The values of an array, one row for each point, and the streams after it. What is not a
    number is NaN."""
    steps = numpy.array(header["steps"], float)
    kind = "<u2" if steps.max() < 65535 else "<u4"
    row = (numpy.dtype(kind).itemsize * len(steps) + 3) // 4 * 4
    parts = []
    for size, count in zip((header["bytes"], header["body_bytes"]), counts):
        if count:
            parts.append(read_attributes(streams[:size], count, row))
        streams = streams[size:]
    codes = numpy.concatenate(parts).view(kind)[:, :len(steps)].astype(float)
    first, last = numpy.array(header["ranges"], float).T
    values = first + (last - first) * codes / steps
    return numpy.where(codes > steps, numpy.nan, values), streams


def count_points(header):
    """The points without bodies, and those of all bodies."""
    groups = header.get("bodies", {"groups": []})["groups"]
    return header["points"], sum(group["points"] * group["bodies"] for group in groups)


def read_arrays(header, streams):
    """The arrays by their names, and the streams after them."""
    arrays = {}
    for one in header.get("arrays", []):
        arrays[one["name"]], streams = read_array(one, streams, count_points(header))
    return arrays, streams


def read_geometry(data):
    """Points in CC, the corners of triangles, exact colours, colour maps, and the header, of the
    bytes of the part. The header gets the values of the arrays as "values"."""
    size = struct.unpack_from("<I", data)[0]
    header = json.loads(data[4:4 + size])
    streams = zlib.decompress(data[4 + size:])
    middle = header["corner_bytes"]
    end = middle + header["position_bytes"]
    count = header["points"]
    corners = Corners(streams[:middle], header["triangles"]).corners if count else []
    positions = (read_attributes(streams[middle:end], count, 8) if count
                 else numpy.zeros((0, 8), "u1"))
    steps = positions.view("<u2")[:, :3].astype(float)
    most = 2 ** header.get("position_bits", 16) - 1
    bounds = numpy.array(header.get("position_bounds", [-1, -1, -1, 1, 1, 1]), float)
    points = bounds[:3] + steps / most * (bounds[3:] - bounds[:3])
    corners = numpy.array(corners, int).reshape(-1, 3)
    colors = read_colors(header, streams[end:])
    end += (header.get("color_bytes", 0) + header.get("back_color_bytes", 0)
            + header.get("exact_bytes", 0))
    places = streams[end:]
    end += header.get("place_bytes", 0) + header.get("body_place_bytes", 0)
    header["values"], rest = read_arrays(header, streams[end:])
    if "bodies" in header:
        for group in header["bodies"]["groups"]:
            bodies = Bodies(header["bodies"], group, rest, header.get("position_bits", 16))
            rest = bodies.rest
            corners = numpy.concatenate([corners, bodies.corners + len(points)])
            points = numpy.concatenate([points, bodies.places])
            if colors is not None:
                colors = numpy.concatenate([colors, bodies.colors()], axis=1)
    return points, corners, colors, read_maps(header, places, rest), header


# What viewpoints see of it.


class Viewer:
    def __init__(self, points, corners, colors, maps, nodes, base_nodes, resolution):
        self.triangles = points[corners]  # triangle, corner, axis
        self.colors = None if colors is None else colors[:, corners].astype(float)
        self.corners = corners
        self.maps = maps
        self.nodes = nodes
        self.base_nodes = base_nodes
        self.resolution = resolution

    def see(self, z):
        """The depths of a viewpoint's strip, and its colours: red, green, blue and whether they
        are exact."""
        count = len(self.nodes)
        face, j, i = z // count**2, z // count % count, z % count
        u, v = (2.0 * self.nodes[k] / (self.base_nodes - 1) - 1.0 for k in (i, j))
        right, down, normal = (numpy.array(axis, float) for axis in FACES[face])
        position = normal + u * right + v * down
        tiles = [self.see_tile(position, exit_face) for exit_face in range(6) if exit_face != face]
        return tuple(numpy.concatenate(parts, axis=1) for parts in zip(*tiles))

    def see_tile(self, position, face):
        size = self.resolution
        nearest = numpy.full(size * size, numpy.inf)
        depths = numpy.full(size * size, NOTHING)
        colors = numpy.zeros((size * size, 4), int)
        axes = numpy.array(FACES[face], float)
        distance = 1.0 - axes[2] @ position
        if distance <= 0.0:  # the rays lie in the face
            return depths.reshape(size, size), colors.reshape(size, size, 4)
        seen = (self.triangles - position) @ axes.T
        numbers = numpy.flatnonzero((seen[..., 2] > 0.0).any(axis=1))
        seen = seen[numbers]
        is_mirrored = numpy.linalg.det(axes) < 0.0
        start = -1.0 - axes[:2] @ position
        # The texels that may meet a triangle; all, if it reaches behind the viewpoint.
        ahead = (seen[..., 2] > 1e-6).all(axis=1)
        places = distance * seen[..., :2] / numpy.where(seen[..., 2:] > 1e-6, seen[..., 2:], 1.0)
        places = numpy.clip((places - start) * size / 2.0 - 0.5, -2.0, size + 1.0)
        low = numpy.where(ahead[:, None], numpy.ceil(places.min(axis=1) - 1e-6), 0)
        high = numpy.where(ahead[:, None], numpy.floor(places.max(axis=1) + 1e-6), size - 1)
        low = numpy.maximum(low, 0).astype(int)
        spans = numpy.maximum(numpy.minimum(high, size - 1).astype(int) - low + 1, 0)
        counts = spans.prod(axis=1)
        ends = numpy.cumsum(counts)
        for first in range(0, int(ends[-1]) if len(ends) else 0, AT_ONCE):
            pairs = numpy.arange(first, min(first + AT_ONCE, int(ends[-1])))
            triangle = numpy.searchsorted(ends, pairs, "right")
            number = pairs - (ends - counts)[triangle]
            x = low[triangle, 0] + number % spans[triangle, 0]
            y = low[triangle, 1] + number // spans[triangle, 0]
            rays = numpy.stack([start[0] + (2 * x + 1) / size, start[1] + (2 * y + 1) / size,
                                numpy.full(len(x), distance)], axis=1)
            fractions, weights = meet(rays, seen, triangle)
            # The first of each texel, by distance and then by number.
            order = numpy.argsort(fractions, kind="stable")
            order = order[numpy.isfinite(fractions[order])]
            texels, firsts = numpy.unique((y * size + x)[order], return_index=True)
            first = order[firsts]
            is_nearer = fractions[first] < nearest[texels]
            texels, first = texels[is_nearer], first[is_nearer]
            nearest[texels] = fractions[first]
            steps = numpy.minimum(numpy.floor(65535.0 * fractions[first] + 0.5), NOTHING - 1)
            depths[texels] = steps.astype(int)
            if self.colors is not None:
                is_back = (weights[first].sum(axis=1) > 0.0) != is_mirrored
                colors[texels] = self.mix(numbers[triangle[first]], weights[first], is_back)
        return depths.reshape(size, size), colors.reshape(size, size, 4)

    def mix(self, triangles, weights, is_back):
        """The colours in triangles, exact where those of all three corners are."""
        corners = self.colors[is_back.astype(int), triangles]
        shares = weights / weights.sum(axis=1, keepdims=True)
        mixed = (shares[..., None] * corners).sum(axis=1)
        if self.maps:
            numbers = self.corners[triangles]
            own = self.maps.numbers[numbers[:, 0]] > 0
            mixed[own, :3] = self.maps.show(numbers[own], corners[own, :, :3], shares[own])
        mixed = numpy.floor(mixed + 0.5)
        mixed[:, 3] = (corners[..., 3] > 0).all(axis=1)
        return mixed.astype(int)


def meet(rays, triangles, which):
    """The fractions of rays from 0 at which they meet their triangles, or infinity, and weights
    of the corners there, whose sum is above 0 where the ray meets the back."""
    a, b, c = (triangles[:, k] for k in range(3))
    sides = [(rays * numpy.cross(p, q)[which]).sum(axis=1) for p, q in ((a, b), (b, c), (c, a))]
    volumes = (numpy.cross(a, b) * c).sum(axis=1)[which]
    total = sides[0] + sides[1] + sides[2]
    inside = numpy.logical_or(numpy.minimum.reduce(sides) >= 0.0,
                              numpy.maximum.reduce(sides) <= 0.0) & (total != 0.0)
    fractions = volumes / numpy.where(inside, total, 1.0)
    return (numpy.where(inside & (fractions > 0.0), fractions, numpy.inf),
            numpy.stack([sides[1], sides[2], sides[0]], axis=1))
