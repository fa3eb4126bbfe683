#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes atrium.glb beside itself: a two-storey colonnade around a court open to the sun.

About 260 000 triangles and 25 textured materials; metres, y up, the court's centre is the origin. The same bytes on each run.
"""

import math
import os
import random
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from geometry import Mesh, roll, smooth_profile
from gltf_writer import GltfWriter
from textures import all_materials

BAY = 2.5
LONG_BAYS, SHORT_BAYS = 8, 4
HALF_X, HALF_Z = LONG_BAYS * BAY / 2, SHORT_BAYS * BAY / 2  # the line of the columns' centres
GALLERY = 3.4  # depth behind that line
WALL = 0.5  # thickness of arcades and outer walls
ARCH_RADIUS = 1.0
COURT_Y = -0.15
FLOOR_Y = (0.0, 5.3)
SPRING_Y = (3.35, 7.85)
TOP_Y = (5.0, 9.2)
EAVES_Y, RIDGE_Y = 9.62, 11.2

# name, turn about y, half length, distance of the column line from the centre, bays. Local +z looks into the court.
SIDES = (
    ("north", 0.0, HALF_X, HALF_Z, LONG_BAYS),
    ("west", math.pi / 2, HALF_Z, HALF_X, SHORT_BAYS),
    ("south", math.pi, HALF_X, HALF_Z, LONG_BAYS),
    ("east", -math.pi / 2, HALF_Z, HALF_X, SHORT_BAYS),
)


def place(side, x, y, z):
    """World position of a side's local one: x along the column line, z out of it towards the court."""
    _, turn, _, distance, _ = side
    c, s = math.cos(turn), math.sin(turn)
    z -= distance
    return (x * c + z * s, y, -x * s + z * c)


def column(fluted, base_y, height):
    """Attic base, shaft with entasis, bell capital with leaves, abacus."""
    mesh = Mesh()
    r = 0.25 if fluted else 0.19
    mesh["capital_stone"].box((-r * 1.45, base_y, -r * 1.45), (r * 1.45, base_y + 0.14, r * 1.45), 1.0, "xXYzZ")
    y = base_y + 0.14
    base = [roll(r * 1.12, y, y + 0.12), [(r * 1.12, y + 0.12), (r * 1.06, y + 0.15), (r * 1.05, y + 0.2)], roll(r * 1.05, y + 0.2, y + 0.27), [(r * 1.05, y + 0.27), (r * 0.9, y + 0.27)]]
    mesh["capital_stone"].lathe(base, 24, 1.0)
    low, high = y + 0.27, base_y + height - 0.62
    rings = 8 if fluted else 12
    shaft = []
    for i in range(rings + 1):
        t = i / rings
        shaft.append((r * (1 - 0.14 * t * t), low + (high - low) * t))
    if fluted:
        mesh["column_travertine"].lathe([shaft], 60, 1.0, lambda a, y: 1 - 0.055 * abs(math.sin(10 * a)) ** 0.7)
    else:
        mesh["column_travertine"].lathe([shaft], 30, 1.0, lambda a, y: 1 + 0.07 * math.cos(3 * a - 7 * y))
    neck = r * 0.86
    mesh["capital_stone"].lathe([[(neck * 0.8, high), (neck, high)], roll(neck, high, high + 0.06, 4)], 24, 1.0)
    bell = smooth_profile([(neck, high + 0.06), (neck * 1.02, high + 0.2), (neck * 1.15, high + 0.36), (neck * 1.55, high + 0.5)], 3)

    def leaves(angle, y):
        rise = (y - high - 0.06) / 0.44
        return 1 + 0.16 * rise * abs(math.cos(4 * angle)) + 0.07 * math.sin(math.pi * min(1, 2 * rise)) * abs(math.sin(4 * angle)) ** 2

    mesh["capital_stone"].lathe([bell], 28, 1.0, leaves)
    half = 0.36
    top = base_y + height
    mesh["capital_stone"].box((-half, top - 0.12, -half), (half, top, half), 1.0)
    return mesh


def corner_pier(base_y, height):
    mesh = Mesh()
    for half, y0, y1, stone in ((0.42, 0.0, 0.22, "capital_stone"), (0.36, 0.22, height - 0.3, "column_travertine"), (0.4, height - 0.3, height - 0.22, "capital_stone"), (0.44, height - 0.22, height, "capital_stone")):
        mesh[stone].box((-half, base_y + y0, -half), (half, base_y + y1, half), 1.0)
    return mesh


def arch_bay(spring, top, stone):
    """The wall above one opening, its soffit, and mouldings on both faces."""
    mesh = Mesh()
    half, t, r, steps = BAY / 2, WALL / 2, ARCH_RADIUS, 18
    for sign in (1, -1):
        for x0, x1 in ((-half, -r), (r, half)):
            a, b = (x0, x1) if sign > 0 else (x1, x0)
            mesh[stone].quad((a, spring, sign * t), (b, spring, sign * t), (b, top, sign * t), (a, top, sign * t), 2.0)

        def face(v, u):
            angle = math.pi * (1 - u if sign > 0 else u)
            x, low = r * math.cos(angle), spring + r * math.sin(angle)
            y = low + (top - low) * v
            return (x, y, sign * t), (x * sign / 2.0, -y / 2.0)

        mesh[stone].sheet(1, steps, face)
        profile = [(0.0, -0.01), (0.0, 0.05), (0.04, 0.065), (0.09, 0.05), (0.1, 0.075), (0.17, 0.1), (0.215, 0.085), (0.235, 0.04), (0.235, -0.01)]

        def moulding(v, u):
            angle = math.pi * (v if sign > 0 else 1 - v)
            radial, out = profile[round(u * (len(profile) - 1))]
            rr = r + radial
            return (rr * math.cos(angle), spring + rr * math.sin(angle), sign * (t + out)), (u, angle * r / 0.5)

        mesh["arch_stone"].sheet(steps, len(profile) - 1, moulding)
    mesh[stone].sheet(steps, 1, lambda v, u: ((r * math.cos(math.pi * v), spring + r * math.sin(math.pi * v), u * WALL - t), (u * 0.25, v * 1.57)))
    for x0, x1 in ((-half, -r), (r, half)):
        mesh[stone].box((x0, spring - 0.001, -t), (x1, spring, t), 2.0, "y")
    key = (0.13, 0.16)
    mesh["capital_stone"].box((-key[0], spring + r - 0.03, -t - key[1]), (key[0], spring + r + 0.34, t + key[1]), 1.0)
    return mesh


def balustrade():
    """Rails and seven balusters across one upper opening."""
    mesh, y = Mesh(), FLOOR_Y[1]
    half = BAY / 2 - 0.2
    stone = mesh["balustrade_marble"]
    stone.box((-half, y + 0.02, -0.13), (half, y + 0.12, 0.13), 1.0, "xXYzZ")
    for low, high, depth in ((0.86, 0.9, 0.1), (0.9, 0.99, 0.14), (0.99, 1.02, 0.12)):
        stone.box((-half, y + low, -depth), (half, y + high, depth), 1.0)
    profile = smooth_profile([(0.035, 0.18), (0.05, 0.22), (0.075, 0.32), (0.06, 0.44), (0.034, 0.56), (0.032, 0.7), (0.05, 0.78), (0.055, 0.8)], 1)
    parts = [[(0.06, 0.12), (0.06, 0.16), (0.035, 0.18)], profile, [(0.06, 0.8), (0.06, 0.86)]]
    for i in range(7):
        x = (i - 3) * (2 * half - 0.26) / 6
        stone.lathe([[(r, y + h) for r, h in part] for part in parts], 10, 1.0, center=(x, 0))
    return mesh


def trim(mesh, material, half_length, profile, tile):
    """Sweeps an (out, y) profile, bottom to top, along one side, mitred at the corners. out: from the column line towards the court."""
    points, uvs, length = [], [], 0.0
    for i, (out, y) in enumerate(profile):
        if i:
            length += math.hypot(out - profile[i - 1][0], y - profile[i - 1][1])
        end = half_length - out
        points.append([(-end, y, out), (end, y, out)])
        uvs.append([(-end / tile, -length / tile), (end / tile, -length / tile)])
    for a in range(len(profile) - 1):
        mesh[material].grid(points[a : a + 2], uvs[a : a + 2])


def side_shell(side):
    """Floors, ceilings, cornices, outer wall, beams, pilasters and roof of one side, in local coordinates."""
    _, _, half, _, bays = side
    mesh = Mesh()
    t, back = WALL / 2, -GALLERY
    trim(mesh, "cornice_stone", half, [(0.45, COURT_Y), (0.45, -0.03), (0.42, 0.0), (-0.4, 0.0)], 1.5)
    trim(mesh, "floor_terracotta", half, [(-0.4, 0.0), (back, 0.0)], 1.6)
    trim(mesh, "wall_plaster", half, [(back, 4.95), (-t, 4.95)], 3.0)
    band = [(t, 5.0), (t + 0.04, 5.02), (t + 0.06, 5.08), (t + 0.12, 5.12), (t + 0.16, 5.2), (t + 0.2, 5.22), (t + 0.2, 5.28), (t + 0.16, 5.3), (-t, 5.3)]
    trim(mesh, "cornice_stone", half, band, 1.5)
    trim(mesh, "floor_planks", half, [(-t, 5.3), (back, 5.3)], 1.6)
    crown = [(t, 9.1), (t + 0.05, 9.14), (t + 0.08, 9.24), (t + 0.18, 9.3), (t + 0.22, 9.42), (t + 0.32, 9.46), (t + 0.34, 9.54), (t + 0.3, 9.6), (-t, 9.6), (-t, 9.2)]
    trim(mesh, "cornice_stone", half, crown, 1.5)
    trim(mesh, "beam_wood", half, [(t + 0.1, 9.55), (t + 0.1, 9.85)], 1.2)
    trim(mesh, "beam_wood", half, [(back, 9.35), (-t, 9.35)], 1.2)
    trim(mesh, "wall_limestone", half, [(back, 0.0), (back, 5.1)], 2.4)
    trim(mesh, "wall_plaster", half, [(back, 5.1), (back, 9.5)], 3.0)
    skirting = [(back, 0.34), (back + 0.04, 0.3), (back + 0.06, 0.0)]
    trim(mesh, "cornice_stone", half, skirting[::-1], 1.5)
    outer = back - WALL
    trim(mesh, "wall_limestone", half, [(outer, RIDGE_Y), (outer, -0.4)], 2.4)
    trim(mesh, "mosaic", half, [(back + 0.012, 2.62), (back + 0.012, 2.98)], 0.36)
    coping = [(outer + 0.3, RIDGE_Y - 0.1), (outer + 0.3, RIDGE_Y + 0.2), (outer - 0.08, RIDGE_Y + 0.26), (outer - 0.08, RIDGE_Y), (outer, RIDGE_Y)]
    trim(mesh, "cornice_stone", half, coping, 1.5)
    beams_and_pilasters(mesh, half, back, bays)
    roof(mesh, half, outer)
    return mesh


def beams_and_pilasters(mesh, half, back, bays):
    for i in range(2 * bays + 1):
        x = -half + i * BAY / 2
        mesh["beam_wood"].box((x - 0.08, 4.72, back), (x + 0.08, 4.95, -WALL / 2), 1.2, "xXy")
        mesh["beam_wood"].box((x - 0.08, 9.12, back), (x + 0.08, 9.35, -WALL / 2), 1.2, "xXy")
    for i in range(bays + 1):
        x = -half + i * BAY
        for y0, y1, w, d in ((0.0, 0.3, 0.26, 0.16), (0.3, 3.1, 0.21, 0.11), (3.1, 3.35, 0.26, 0.16)):
            mesh["column_travertine"].box((x - w, y0, back), (x + w, y1, back + d), 1.0, "xXyYZ")
        mesh["cornice_stone"].box((x - 0.12, 4.3, back), (x + 0.12, 4.72, back + 0.3), 1.0, "xXyZ")


def roof(mesh, half, outer):
    """Barrel tiles: a corrugated sheet, its edge towards the court, and boards below."""
    eaves, ridge = 0.72, outer
    slope = (RIDGE_Y - EAVES_Y) / (eaves - ridge)
    wave, per_wave, rows = 0.3, 6, 6
    columns = round((half - ridge) / wave) * per_wave

    def tile(v, u, lift=1.0):
        out = eaves + (ridge - eaves) * v
        end = half - out
        x = (2 * u - 1) * (half - ridge)
        y = EAVES_Y + (eaves - out) * slope + lift * (0.05 + 0.07 * abs(math.sin(math.pi * x / wave)))
        return (max(-end, min(end, x)), y, out), (x / wave / 8, -v * rows / 4)

    mesh["roof_tiles"].sheet(rows, columns, tile)
    mesh["roof_tiles"].sheet(1, columns, lambda v, u: (lambda a, b: ((a[0][0], a[0][1] if v else b[0][1] - 0.04, a[0][2]), a[1]))(tile(0, u), tile(0, u, 0.0)))
    trim(mesh, "beam_wood", half, [(ridge, RIDGE_Y - 0.04), (eaves, EAVES_Y - 0.04)], 1.2)


def door(width, height):
    """A panelled double door with frame, arched moulding and bronze rings; local z 0 is the wall's face."""
    mesh = Mesh()
    half = width / 2
    mesh["door_wood"].box((-half, 0, 0), (half, height, 0.05), 1.2, "Z")
    for sign in (-1, 1):
        for i in range(3):
            y0 = 0.15 + i * (height - 0.2) / 3
            x0, x1 = sorted((sign * 0.1, sign * (half - 0.1)))
            mesh["door_wood"].box((x0, y0, 0.04), (x1, y0 + (height - 0.2) / 3 - 0.1, 0.085), 1.2, "xXyYZ")
        x0, x1 = sorted((sign * half, sign * (half + 0.2)))
        mesh["arch_stone"].box((x0, 0, 0), (x1, height, 0.14), 1.0, "xXZ")
        ring = mesh["bronze"]
        cx, cy = sign * 0.16, height * 0.45

        def torus(v, u):
            a, b = 2 * math.pi * v, 2 * math.pi * u
            rr = 0.07 + 0.014 * math.cos(b)
            return (cx + rr * math.cos(a), cy + rr * math.sin(a), 0.1 - 0.014 * math.sin(b)), (u, 4 * v)

        ring.sheet(12, 5, torus)
    mesh["cornice_stone"].box((-half - 0.3, height, 0), (half + 0.3, height + 0.2, 0.2), 1.0, "xXyYZ")
    mesh["cornice_stone"].box((-half - 0.38, height + 0.2, 0), (half + 0.38, height + 0.3, 0.27), 1.0, "xXyYZ")
    return mesh


def curtain(material, width, height, folds, seed, parted, rows, columns):
    """Cloth from a bronze rod at y 0 down to -height; parted: pulled together towards one edge below the middle."""
    rng = random.Random(seed)
    mesh, phase = Mesh(), [rng.uniform(0, 6.28) for _ in range(3)]

    def cloth(v, u):
        fall = 1 - v
        t = min(1.0, fall / 0.62)
        gather = 1 - parted * (0.66 * t * t * (3 - 2 * t) - 0.3 * max(0.0, fall - 0.62))
        x = -width / 2 + width * u * gather
        swing = 0.045 + 0.06 * fall
        z = swing * math.sin(2 * math.pi * folds * u + phase[0] + 0.5 * math.sin(3 * fall + phase[1])) + 0.02 * math.sin(5 * math.pi * u + 7 * fall + phase[2])
        y = -height * fall + 0.03 * math.sin(2 * math.pi * folds * u + phase[1]) * fall
        return (x, y, z), (u * 2, fall * height / 1.2)

    mesh[material].sheet(rows, columns, cloth)
    rod = mesh["bronze"]
    rod.sheet(1, 10, lambda v, u: ((width * 0.55 * (1 - 2 * v), 0.03 + 0.025 * math.sin(2 * math.pi * u), 0.025 * math.cos(2 * math.pi * u)), (u, v)), closed=True)
    if not parted:  # a banner: arms from the rail behind it
        for x in (-0.45 * width, 0.45 * width):
            rod.box((x - 0.015, 0.015, -0.45), (x + 0.015, 0.045, 0.0), 0.3, "xXyY")
    return mesh


def vase():
    mesh = Mesh()
    outside = smooth_profile([(0.16, 0.0), (0.2, 0.05), (0.27, 0.2), (0.33, 0.42), (0.28, 0.62), (0.19, 0.72), (0.2, 0.78), (0.26, 0.84)], 3)
    mesh["vase_glaze"].lathe([[(0.0, 0.0), (0.16, 0.0)][::-1], outside, [(0.26, 0.84), (0.22, 0.84)], [(0.22, 0.84), (0.17, 0.74)]], 24, 0.8)
    mesh["beam_wood"].lathe([[(0.18, 0.76), (0.0, 0.78)]], 24, 0.5)
    return mesh


def palm(seed):
    """Arching fronds from the vase's mouth."""
    rng = random.Random(seed)
    mesh = Mesh()
    for i in range(22):
        turn, length, lift = i * 2.399963 + rng.uniform(-0.2, 0.2), rng.uniform(0.75, 1.15), rng.uniform(0.45, 1.25)
        c, s = math.cos(turn), math.sin(turn)

        def frond(v, u):
            reach = length * (math.sin(lift) * 0.25 + 0.75 * v) * v
            y = 0.78 + length * (1.25 * lift * v - (0.55 + 0.5 * lift) * v * v)
            side, droop = (u - 0.5) * 0.34, abs(u - 0.5) * 0.16
            return (reach * c - side * s, y - droop, -(reach * s + side * c)), (u, 1 - v)

        mesh["palm_leaf"].sheet(6, 4, frond)
    return mesh


def ivy(seed, length):
    """Overlapping cards hanging over the balustrade."""
    rng = random.Random(seed)
    mesh = Mesh()
    for i in range(9):
        x, drop, out, phase = rng.uniform(-0.95, 0.95), length * rng.uniform(0.5, 1.0), rng.uniform(0.03, 0.1), rng.uniform(0, 6.28)
        width, shift = rng.uniform(0.22, 0.36), rng.random()

        def strand(v, u):
            fall = 1 - v
            y = 1.1 - drop * fall
            z = 0.2 + out + 0.07 * math.sin(9 * fall + phase) * fall + (0.0 if fall > 0.08 else -0.12 * (1 - fall / 0.08))
            return (x + (u - 0.5) * width * (1 - 0.5 * fall) + 0.06 * math.sin(5 * fall + phase), y, z + 0.05 * math.sin(math.pi * u)), (u * width * 1.6 + shift, fall * drop * 1.6)

        mesh["ivy_leaf"].sheet(12, 2, strand)
    return mesh


def lantern():
    """Hangs from y 0: chain, bronze cap and cage, glowing glass."""
    mesh = Mesh()
    bronze = mesh["bronze"]
    bronze.lathe([[(0.012, -1.0), (0.012, 0.0)]], 6, 0.3)
    bronze.lathe([[(0.0, -1.12), (0.17, -1.12)], smooth_profile([(0.17, -1.12), (0.12, -1.06), (0.03, -1.0), (0.012, -0.98)], 2)], 14, 0.3)
    bronze.lathe([[(0.0, -1.62), (0.05, -1.6), (0.13, -1.56)], [(0.13, -1.56), (0.13, -1.53), (0.0, -1.53)]], 14, 0.3)
    for i in range(6):
        a = math.pi * i / 3
        x, z = 0.145 * math.cos(a), 0.145 * math.sin(a)
        bronze.box((x - 0.01, -1.55, z - 0.01), (x + 0.01, -1.1, z + 0.01), 0.3, "xXzZ")
    mesh["lamp_glass"].lathe([smooth_profile([(0.02, -1.5), (0.1, -1.44), (0.115, -1.3), (0.1, -1.18), (0.05, -1.12)], 2)], 16, 0.4)
    return mesh


def fountain():
    """Basin with a mosaic band, pedestal and bowl in the court's middle."""
    mesh, y = Mesh(), COURT_Y
    mesh["cornice_stone"].lathe([[(2.12, y), (2.12, y + 0.1), (2.0, y + 0.14)]], 56, 1.0)
    mesh["mosaic"].lathe([[(2.0, y + 0.14), (2.0, y + 0.46)]], 56, 0.36)
    mesh["cornice_stone"].lathe([[(2.0, y + 0.46)] + roll(2.03, y + 0.46, y + 0.56, 6), [(2.03, y + 0.56), (1.66, y + 0.56)], [(1.66, y + 0.56), (1.62, y + 0.52), (1.62, y)]], 56, 1.0)
    mesh["water"].lathe([[(1.64, y + 0.4), (0.9, y + 0.4), (0.0, y + 0.4)]], 56, 1.2)
    pedestal = smooth_profile([(0.36, y + 0.3), (0.3, y + 0.5), (0.17, y + 0.7), (0.14, y + 0.95), (0.2, y + 1.12), (0.16, y + 1.22)], 5)
    mesh["balustrade_marble"].lathe([pedestal], 40, 1.0)
    bowl = smooth_profile([(0.16, y + 1.22), (0.5, y + 1.28), (0.82, y + 1.4), (0.95, y + 1.58)], 6)
    mesh["balustrade_marble"].lathe([bowl, [(0.95, y + 1.58), (0.9, y + 1.6), (0.86, y + 1.56)], [(0.86, y + 1.56), (0.7, y + 1.42), (0.3, y + 1.36)]], 56, 1.0, lambda a, h: 1 + 0.03 * abs(math.cos(8 * a)))
    mesh["water"].lathe([[(0.84, y + 1.52), (0.0, y + 1.52)]], 56, 1.2)
    finial = smooth_profile([(0.12, y + 1.4), (0.1, y + 1.7), (0.05, y + 1.85), (0.13, y + 2.0), (0.12, y + 2.14), (0.03, y + 2.26), (0.0, y + 2.34)], 5)
    mesh["balustrade_marble"].lathe([finial], 28, 1.0)
    return mesh


def ground():
    mesh = Mesh()
    x, z = HALF_X - 0.4, HALF_Z - 0.4
    mesh["floor_marble"].quad((-x, COURT_Y, z), (x, COURT_Y, z), (x, COURT_Y, -z), (-x, COURT_Y, -z), 3.2)
    mesh["wall_plaster"].box((-HALF_X - 30, -0.6, -HALF_Z - 30), (HALF_X + 30, -0.4, HALF_Z + 30), 6.0, "Y")
    return mesh


def bench():
    mesh = Mesh()
    stone = mesh["balustrade_marble"]
    stone.box((-0.8, 0.4, -0.22), (0.8, 0.48, 0.22), 1.0)
    for x in (-0.58, 0.58):
        stone.box((x - 0.08, 0.0, -0.17), (x + 0.08, 0.4, 0.17), 1.0, "xXzZ")
    return mesh


def add_meshes(writer):
    for storey in (0, 1):
        writer.add_mesh(("column", "upper_column")[storey], column(storey == 0, FLOOR_Y[storey], SPRING_Y[storey] - FLOOR_Y[storey]))
        writer.add_mesh(("pier", "upper_pier")[storey], corner_pier(FLOOR_Y[storey], TOP_Y[storey] - FLOOR_Y[storey]))
        writer.add_mesh(("arch", "upper_arch")[storey], arch_bay(SPRING_Y[storey], TOP_Y[storey], ("spandrel_stone", "wall_plaster")[storey]))
    writer.add_mesh("balustrade", balustrade())
    writer.add_mesh("shell_long", side_shell(SIDES[0]))
    writer.add_mesh("shell_short", side_shell(SIDES[1]))
    writer.add_mesh("door", door(1.5, 2.4))
    for i, color in enumerate(("red", "green", "blue", "ochre")):
        writer.add_mesh("curtain_" + color, curtain("curtain_" + color, 2.0, 3.1, 9, 100 + i, 1.0, 26, 56))
        writer.add_mesh("banner_" + color, curtain("curtain_" + color, 1.5, 2.2, 4, 200 + i, 0.0, 16, 30))
    writer.add_mesh("vase", vase())
    for i in range(3):
        writer.add_mesh(f"palm_{i}", palm(300 + i))
        writer.add_mesh(f"ivy_{i}", ivy(400 + i, (1.6, 2.3, 1.9)[i]))
    writer.add_mesh("lantern", lantern())
    writer.add_mesh("fountain", fountain())
    writer.add_mesh("ground", ground())
    writer.add_mesh("bench", bench())


COLORS = ("red", "ochre", "blue", "green")


def furnish(writer, side):
    """What hangs and stands on one side, by bay."""
    name, turn, half, _, bays = side
    rng = random.Random(name)
    for i in range(bays):
        x = -half + (i + 0.5) * BAY
        at = lambda kind, y, z, mesh, extra=0.0, dx=0.0, scale=1.0: writer.add_node(f"{kind}_{name}_{i}", mesh, place(side, x + dx, y, z), turn + extra, scale)
        at("arch", 0, 0, "arch")
        at("upper_arch", 0, 0, "upper_arch")
        at("balustrade", 0, 0, "balustrade")
        color = COLORS[(i // 2 + (name == "south")) % 4]
        if bays == LONG_BAYS and i % 2 == (0 if name == "north" else 1):
            at("curtain", 3.42, -0.12, "curtain_" + color, math.pi if i % 4 < 2 else 0.0)
        elif bays == LONG_BAYS or i in (0, 3):
            at("lantern", 4.72, -GALLERY / 2, "lantern")
        if i % 3 == 1:
            at("banner", FLOOR_Y[1] + 1.03, 0.5, "banner_" + COLORS[(i + 1) % 4])
        elif i % 3 == 0:
            at("ivy", FLOOR_Y[1], 0.0, f"ivy_{(i // 3 + len(name)) % 3}")
        if i % 2:
            at("door", 0, -GALLERY, "door")
            at("upper_lantern", 9.12, -GALLERY / 2, "lantern")
        else:
            at("bench", 0, -GALLERY + 0.45, "bench")
            at("upper_door", FLOOR_Y[1], -GALLERY, "door")
        if i:
            writer.add_node(f"column_{name}_{i}", "column", place(side, x - BAY / 2, 0, 0), turn)
            writer.add_node(f"upper_column_{name}_{i}", "upper_column", place(side, x - BAY / 2, 0, 0), turn)
            if i % 2 == 0 or bays == SHORT_BAYS:
                scale = rng.uniform(0.9, 1.1)
                spin = rng.uniform(0, 6.28)
                at("vase", COURT_Y, 1.05, "vase", spin, -BAY / 2, scale)
                at("palm", COURT_Y, 1.05, f"palm_{rng.randrange(3)}", spin, -BAY / 2, scale)


def main():
    writer = GltfWriter("make_atrium.py")
    for material in all_materials():
        writer.add_material(material)
    add_meshes(writer)
    writer.add_node("ground", "ground")
    writer.add_node("fountain", "fountain")
    for side in SIDES:
        name, turn = side[0], side[1]
        writer.add_node("shell_" + name, "shell_long" if side[4] == LONG_BAYS else "shell_short", place(side, 0, 0, 0), turn)
        corner = place(side, -side[2], 0, 0)
        writer.add_node("pier_" + name, "pier", corner)
        writer.add_node("upper_pier_" + name, "upper_pier", corner)
        furnish(writer, side)
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "atrium.glb")
    writer.write(path)
    print(f"{path}: {writer.triangles} triangles, {len(writer.json['materials'])} materials, {len(writer.json['nodes'])} nodes, {os.path.getsize(path) / 1e6:.1f} MB")


if __name__ == "__main__":
    main()
