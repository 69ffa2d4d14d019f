#!/usr/bin/env python3
"""Writes the meshes and pictures of librender/scenes that are computed: run it in any folder of the project.

tiles.png    64x64 glazed tiles
sky.exr      64x32 lat-long sky with a sun
torus.ply    smooth torus, binary
knot.serialized  trefoil knot in Mitsuba's format
"""
import math
import pathlib
import struct
import zlib

scenes = pathlib.Path(__file__).resolve().parent.parent / "librender" / "scenes"


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def write_png(path, width, height, pixel):
    rows = b"".join(b"\0" + b"".join(bytes(pixel(x, y)) for x in range(width)) for y in range(height))
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def tile(x, y):
    if x % 16 == 0 or y % 16 == 0:
        return 90, 84, 78  # grout
    if (x // 16 + y // 16) % 4 == 0:
        return 40, 92, 150
    shade = (x * 7 + y * 13) % 12
    return 216 - shade, 208 - shade, 190 - shade


def attribute(name, kind, value):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value


def write_exr(path, width, height, pixel):
    """Uncompressed 32-bit float, one line a block, channels in alphabetical order."""
    channels = b"".join(c + b"\0" + struct.pack("<iiii", 2, 0, 1, 1) for c in (b"B", b"G", b"R")) + b"\0"
    box = struct.pack("<iiii", 0, 0, width - 1, height - 1)
    head = struct.pack("<ii", 20000630, 2) + attribute("channels", "chlist", channels)
    head += attribute("compression", "compression", b"\0") + attribute("dataWindow", "box2i", box)
    head += attribute("displayWindow", "box2i", box) + attribute("lineOrder", "lineOrder", b"\0")
    head += attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    head += attribute("screenWindowCenter", "v2f", struct.pack("<ff", 0, 0))
    head += attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + b"\0"
    line = 8 + 12 * width
    start = len(head) + 8 * height
    offsets = b"".join(struct.pack("<Q", start + y * line) for y in range(height))
    body = b""
    for y in range(height):
        colors = [pixel(x, y) for x in range(width)]
        body += struct.pack("<ii", y, 12 * width)
        for c in (2, 1, 0):
            body += struct.pack(f"<{width}f", *(color[c] for color in colors))
    path.write_bytes(head + offsets + body)


def sky(x, y):
    if y >= 16:  # the ground
        return 0.18, 0.16, 0.13
    if 14 <= x <= 15 and y == 7:  # the sun
        return 900.0, 780.0, 600.0
    t = y / 16
    return 0.25 + 0.5 * t, 0.45 + 0.4 * t, 0.9 + 0.05 * t


def tube(center, radius, segments, sides, closed_turns):
    """A tube about a closed curve: positions, normals, uvs and triangles; the seams have vertices of their own."""
    points, normals, uvs, triangles = [], [], [], []
    for i in range(segments + 1):
        t = 2 * math.pi * closed_turns * i / segments
        p, q = center(t), center(t + 1e-4)
        tangent = unit([b - a for a, b in zip(p, q)])
        across = unit(cross(tangent, [p[0], p[1], p[2] + 3]))
        up = cross(across, tangent)
        for j in range(sides + 1):
            a = 2 * math.pi * j / sides
            n = [math.cos(a) * s + math.sin(a) * u for s, u in zip(across, up)]
            points.append([c + radius * d for c, d in zip(p, n)])
            normals.append(n)
            uvs.append((i / segments, j / sides))
    for i in range(segments):
        for j in range(sides):
            a, b = i * (sides + 1) + j, (i + 1) * (sides + 1) + j
            triangles += [(a, b, b + 1), (a, b + 1, a + 1)]
    return points, normals, uvs, triangles


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(v):
    length = math.sqrt(sum(x * x for x in v))
    return [x / length for x in v]


def outward(mesh):
    """Turns the triangles so that their winding agrees with the normals."""
    points, normals, uvs, triangles = mesh
    turned = []
    for a, b, c in triangles:
        n = cross([q - p for p, q in zip(points[a], points[b])], [q - p for p, q in zip(points[a], points[c])])
        turned.append((a, b, c) if sum(x * y for x, y in zip(n, normals[a])) > 0 else (a, c, b))
    return points, normals, uvs, turned


def write_ply(path, mesh):
    points, normals, uvs, triangles = mesh
    names = "".join(f"property float {n}\n" for n in ("x", "y", "z", "nx", "ny", "nz", "u", "v"))
    header = (f"ply\nformat binary_little_endian 1.0\ncomment tools/make_assets.py\nelement vertex {len(points)}\n{names}"
              f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n")
    body = b"".join(struct.pack("<8f", *p, *n, *t) for p, n, t in zip(points, normals, uvs))
    path.write_bytes(header.encode() + body + b"".join(struct.pack("<B3i", 3, *t) for t in triangles))


def write_serialized(path, mesh):
    points, normals, uvs, triangles = mesh
    body = struct.pack("<I", 0x1003) + b"knot\0" + struct.pack("<QQ", len(points), len(triangles))
    body += b"".join(struct.pack("<3f", *p) for p in points) + b"".join(struct.pack("<3f", *n) for n in normals)
    body += b"".join(struct.pack("<2f", *t) for t in uvs) + b"".join(struct.pack("<3I", *t) for t in triangles)
    path.write_bytes(struct.pack("<HH", 0x041C, 4) + zlib.compress(body, 9) + struct.pack("<QI", 0, 1))


def torus(t):
    return [math.cos(t), 0.0, math.sin(t)]


def trefoil(t):
    return [0.5 * (math.sin(t) + 2 * math.sin(2 * t)), 0.5 * (math.cos(t) - 2 * math.cos(2 * t)), -0.5 * math.sin(3 * t)]


for folder in ("textures", "meshes"):
    (scenes / folder).mkdir(exist_ok=True)
write_png(scenes / "textures" / "tiles.png", 64, 64, tile)
write_exr(scenes / "textures" / "sky.exr", 64, 32, sky)
write_ply(scenes / "meshes" / "torus.ply", outward(tube(torus, 0.35, 48, 24, 1)))
write_serialized(scenes / "meshes" / "knot.serialized", outward(tube(trefoil, 0.3, 160, 20, 1)))
