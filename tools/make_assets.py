#!/usr/bin/env python3
"""Writes the meshes and pictures of librender/scenes that are computed: run it in any folder of the project.

textures/tiles.png        64x64 glazed tiles
textures/sky.exr          64x32 lat-long sky with a sun
textures/dusk.hdr         64x32 lat-long evening sky, in Radiance's format
textures/map.png          128x64 map of a small planet
textures/leaf.png         64x64 outline of a leaf, white on black
textures/gradient.pfm     the four corners of book1-gradient
meshes/torus.ply          smooth torus, binary
meshes/knot.serialized    trefoil knot in Mitsuba's format
meshes/arcade.ply         walls, floor and arches of an open courtyard
book1-cover.xml           the spheres of a book's cover
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


def dusk(x, y):
    """A low sun in the west, a red horizon under a dark sky, dark ground."""
    height = math.cos(math.pi * (y + 0.5) / 32)
    away = math.hypot((x + 0.5) / 64 - 0.75, 0.5 * height - 0.07) * 2 * math.pi
    sun = 60 * math.exp(-((away / 0.12) ** 2)) + 1.5 * math.exp(-away)
    if height < 0:
        return 0.06, 0.05, 0.05
    glow = math.exp(-height / 0.2)
    return sun + 0.5 * glow + 0.05, 0.6 * sun + 0.2 * glow + 0.08, 0.25 * sun + 0.12 * glow + 0.2


def rgbe(color):
    mantissa, exponent = math.frexp(max(color))
    return [int(c * mantissa * 256 / max(color)) for c in color] + [exponent + 128]


def runs(values):
    """Bytes as counted runs and as counted others."""
    out, i = b"", 0
    while i < len(values):
        n = 1
        while i + n < len(values) and n < 127 and values[i + n] == values[i]:
            n += 1
        if n > 2:
            out += bytes([128 + n, values[i]])
        else:
            n = min(len(values) - i, 2)
            out += bytes([n]) + bytes(values[i : i + n])
        i += n
    return out


def write_hdr(path, width, height, pixel):
    data = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + f"-Y {height} +X {width}\n".encode()
    for y in range(height):
        row = [rgbe(pixel(x, y)) for x in range(width)]
        data += bytes([2, 2, width // 256, width % 256]) + b"".join(runs([p[c] for p in row]) for c in range(4))
    path.write_bytes(data)


def planet(x, y):
    """Land and sea by waves, ice about the poles; whole waves, so that the edges meet."""
    u, v = 2 * math.pi * (x + 0.5) / 128, math.pi * (y + 0.5) / 64
    land = math.sin(2 * u) * math.sin(2 * v) + 0.7 * math.sin(3 * u + 1) * math.sin(v) ** 2 + 0.5 * math.cos(5 * v + u)
    if abs(math.cos(v)) > 0.93 + 0.02 * math.sin(7 * u):
        return 236, 240, 244
    if land > 0.35:
        return (150, 128, 84) if land > 0.9 else (86, 128, 62)
    return 30, 66, 122


def leaf(x, y):
    """Its tip at the top, a toothed edge, and a stalk."""
    along, across = (y + 0.5) / 64, abs((x + 0.5) / 64 - 0.5)
    t = along / 0.85
    teeth = 0.03 * ((9 * t) % 1)
    blade = t < 1 and across < 0.3 * math.sin(math.pi * t**0.75) ** 0.9 - teeth
    return (255,) * 3 if blade or (along > 0.8 and across < 0.025) else (0,) * 3


def write_pfm(path, rows):
    """Rows of colours, the bottom one first, as the format has it."""
    values = [c for row in rows for color in row for c in color]
    path.write_bytes(f"PF\n{len(rows[0])} {len(rows)}\n-1\n".encode() + struct.pack(f"<{len(values)}f", *values))


def tube(center, aside, radius, segments, sides):
    """A tube about a closed curve: positions, normals, uvs and triangles; the seams have vertices of their own. `aside`
    of a point must never be along the curve: where it were the tube would be twisted by half a turn."""
    points, normals, uvs, triangles = [], [], [], []
    for i in range(segments + 1):
        t = 2 * math.pi * i / segments
        p, q = center(t), center(t + 1e-4)
        tangent = unit([b - a for a, b in zip(p, q)])
        across = unit(cross(tangent, aside(p)))
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


def arch(x, z, width, height, depth, pillar):
    """A wall in the plane of constant z from x to x + width, `depth` thick, with a round arch on two pillars in it."""
    steps, left, right = 16, x + pillar, x + width - pillar
    radius, middle = (right - left) / 2, (left + right) / 2
    spring = height - radius - 0.35
    curve = [(left, 0.0)] + [(middle - radius * math.cos(math.pi * i / steps), spring + radius * math.sin(math.pi * i / steps))
                             for i in range(steps + 1)] + [(right, 0.0)]
    outer = [(x, 0.0)] + [(x if i <= steps // 4 else x + width if i >= 3 * steps // 4 else px, height if steps // 4 <= i <= 3 * steps // 4
                           else py) for i, (px, py) in enumerate(curve[1:-1])] + [(x + width, 0.0)]
    points, triangles = [], []

    def quad(*corners):
        triangles.extend([(len(points), len(points) + 1, len(points) + 2), (len(points), len(points) + 2, len(points) + 3)])
        points.extend(corners)

    for (a, b), (c, d) in zip(zip(curve, curve[1:]), zip(outer, outer[1:])):
        for side in (0, depth):
            quad((*a, z + side), (*b, z + side), (*d, z + side), (*c, z + side))
        quad((*a, z), (*b, z), (*b, z + depth), (*a, z + depth))
    return points, triangles


def courtyard():
    """Five arches on each of two sides, a wall behind them, and what is above: one mesh without normals and uvs."""
    points, triangles = [], []
    for turn in (1, -1):
        for i in range(5):
            p, t = arch(-7.5 + 3 * i, 3, 3, 4, 0.5, 0.35)
            triangles += [tuple(len(points) + k for k in abc) for abc in t]
            points += [(x, y, turn * z) for x, y, z in p]
        for corners in (((-8, 0, 6), (8, 0, 6), (8, 4, 6), (-8, 4, 6)), ((-8, 4, 3), (8, 4, 3), (8, 4, 6), (-8, 4, 6)),
                        ((-8, 4, 3), (8, 4, 3), (8, 7, 3), (-8, 7, 3))):
            n = len(points)
            triangles += [(n, n + 1, n + 2), (n, n + 2, n + 3)]
            points += [(x, y, turn * z) for x, y, z in corners]
    n = len(points)
    triangles += [(n, n + 1, n + 2), (n, n + 2, n + 3)]
    points += [(8, 0, -6), (8, 0, 6), (8, 7, 6), (8, 7, -6)]
    return points, triangles


def write_plain_ply(path, points, triangles):
    header = (f"ply\nformat binary_little_endian 1.0\ncomment tools/make_assets.py\nelement vertex {len(points)}\n"
              "property float x\nproperty float y\nproperty float z\n"
              f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n")
    path.write_bytes(header.encode() + b"".join(struct.pack("<3f", *p) for p in points)
                     + b"".join(struct.pack("<B3i", 3, *t) for t in triangles))


def glibc_random():
    """rand() of glibc, not seeded, over 2^31: what the book's program draws on most machines."""
    r = [1]
    for i in range(1, 31):
        r.append(16807 * r[-1] % 2147483647)
    for i in range(31, 34):
        r.append(r[i - 31])
    while True:
        r.append((r[-3] + r[-31]) & 0xFFFFFFFF)
        if len(r) > 344:
            yield (r[-1] >> 1) / 2147483648


def cover_spheres():
    """Centre, radius and BSDF of [Shirley16]'s cover, as g++ compiles the book's program: it draws the last argument of
    a call first."""
    draw = glibc_random()

    def color(lo, hi):
        return [lo + (hi - lo) * next(draw) for _ in range(3)][::-1]

    yield (0, -1000, 0), 1000, ("diffuse", [0.5] * 3, 0)
    for a in range(-11, 11):
        for b in range(-11, 11):
            choose = next(draw)
            z = b + 0.9 * next(draw)
            x = a + 0.9 * next(draw)
            if math.dist((x, 0.2, z), (4, 0.2, 0)) <= 0.9:
                continue
            if choose < 0.8:
                yield (x, 0.2, z), 0.2, ("diffuse", [p * q for p, q in zip(color(0, 1), color(0, 1))], 0)
            elif choose < 0.95:
                albedo = color(0.5, 1)
                yield (x, 0.2, z), 0.2, ("metal", albedo, 0.5 * next(draw))
            else:
                yield (x, 0.2, z), 0.2, ("glass", None, 0)
    yield (0, 1, 0), 1, ("glass", None, 0)
    yield (-4, 1, 0), 1, ("diffuse", [0.4, 0.2, 0.1], 0)
    yield (4, 1, 0), 1, ("metal", [0.7, 0.6, 0.5], 0)


def number(x):
    return f"{x:.9g}"


def cover_bsdf(kind, albedo, fuzz):
    if kind == "glass":
        return '<ref id="glass"/>'
    rgb = ", ".join(number(c) for c in albedo)
    if kind == "diffuse":
        return f'<bsdf type="diffuse"><rgb name="reflectance" value="{rgb}"/></bsdf>'
    return f'<bsdf type="fuzzymetal"><rgb name="albedo" value="{rgb}"/><float name="fuzz" value="{number(fuzz)}"/></bsdf>'


def write_cover(path):
    shapes = "".join(
        f'\t<shape type="sphere"><point name="center" x="{number(x)}" y="{number(y)}" z="{number(z)}"/>'
        f'<float name="radius" value="{number(radius)}"/>{cover_bsdf(*bsdf)}</shape>\n'
        for (x, y, z), radius, bsdf in cover_spheres())
    path.write_text(COVER.replace("@SPHERES@", shapes))


COVER = """<?xml version="1.0" encoding="utf-8"?>
<!-- Ray Tracing in One Weekend (P. Shirley), its cover: written by tools/make_assets.py, which draws the spheres as the program of the
     book's later edition does under glibc when g++ has compiled it -->
<scene version="0.6.0">
	<integrator type="path">
		<integer name="maxDepth" value="50"/>
	</integrator>

	<sensor type="thinlens">
		<string name="fovAxis" value="y"/>
		<float name="fov" value="20"/>
		<float name="apertureRadius" value="0.0523604"/>
		<float name="focusDistance" value="10"/>
		<transform name="toWorld">
			<lookAt origin="13, 2, 3" target="0, 0, 0" up="0, 1, 0"/>
		</transform>
		<sampler type="sobol">
			<integer name="sampleCount" value="64"/>
		</sampler>
		<film type="hdrfilm">
			<integer name="width" value="1200"/>
			<integer name="height" value="675"/>
			<rfilter type="box"/>
		</film>
	</sensor>

	<emitter type="gradient">
		<rgb name="bottom" value="1, 1, 1"/>
		<rgb name="top" value="0.5, 0.7, 1"/>
	</emitter>

	<bsdf type="dielectric" id="glass">
		<float name="intIOR" value="1.5"/>
		<float name="extIOR" value="1"/>
	</bsdf>

@SPHERES@</scene>
"""

for folder in ("textures", "meshes"):
    (scenes / folder).mkdir(exist_ok=True)
write_png(scenes / "textures" / "tiles.png", 64, 64, tile)
write_exr(scenes / "textures" / "sky.exr", 64, 32, sky)
write_hdr(scenes / "textures" / "dusk.hdr", 64, 32, dusk)
write_png(scenes / "textures" / "map.png", 128, 64, planet)
write_png(scenes / "textures" / "leaf.png", 64, 64, leaf)
write_pfm(scenes / "textures" / "gradient.pfm", [[(0, 0, 0.2), (1, 0, 0.2)], [(0, 1, 0.2), (1, 1, 0.2)]])
write_ply(scenes / "meshes" / "torus.ply", outward(tube(torus, lambda p: (0, 1, 0), 0.35, 48, 24)))
write_serialized(scenes / "meshes" / "knot.serialized", outward(tube(trefoil, lambda p: (p[0], p[1], p[2] + 3), 0.3, 160, 20)))
write_plain_ply(scenes / "meshes" / "arcade.ply", *courtyard())
write_cover(scenes / "book1-cover.xml")
