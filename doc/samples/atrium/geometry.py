# SPDX-License-Identifier: MIT
"""Surfaces built from grids, lathes and boxes. Metres, y up, counter-clockwise is the outside; uv 1 is one texture."""

import math
from array import array


def _cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


class Surface:
    """Triangles of one material."""

    def __init__(self):
        self.positions = array("f")
        self.normals = array("f")
        self.uvs = array("f")
        self.indices = array("I")

    def grid(self, points, uvs, closed=False):
        """points[row][column], smooth within the grid; the outside is columns x rows. closed: first and last column coincide."""
        rows, columns = len(points), len(points[0])
        normals = [[[0.0, 0.0, 0.0] for _ in range(columns)] for _ in range(rows)]
        start = len(self.positions) // 3
        for r in range(rows - 1):
            for c in range(columns - 1):
                corners = ((r, c), (r, c + 1), (r + 1, c + 1), (r + 1, c))
                for triangle in ((0, 1, 2), (0, 2, 3)):
                    (ra, ca), (rb, cb), (rc, cc) = (corners[i] for i in triangle)
                    a = points[ra][ca]
                    n = _cross(_sub(points[rb][cb], a), _sub(points[rc][cc], a))
                    if n[0] * n[0] + n[1] * n[1] + n[2] * n[2] < 1e-18:  # a pole or a clamped edge
                        continue
                    for i, j in ((ra, ca), (rb, cb), (rc, cc)):
                        total = normals[i][j]
                        total[0] += n[0]
                        total[1] += n[1]
                        total[2] += n[2]
                    self.indices.extend((start + ra * columns + ca, start + rb * columns + cb, start + rc * columns + cc))
        if closed:
            for row in normals:
                row[0] = row[-1] = [a + b for a, b in zip(row[0], row[-1])]
        for r in range(rows):
            for c in range(columns):
                n = normals[r][c]
                length = math.sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2])
                self.positions.extend(points[r][c])
                self.normals.extend([v / length for v in n] if length > 0 else (0.0, 1.0, 0.0))
                self.uvs.extend(uvs[r][c])

    def sheet(self, rows, columns, function, closed=False):
        """function(v, u) -> (position, uv), both in 0..1, over rows x columns quads."""
        values = [[function(r / rows, c / columns) for c in range(columns + 1)] for r in range(rows + 1)]
        self.grid([[p for p, _ in row] for row in values], [[uv for _, uv in row] for row in values], closed)

    def lathe(self, parts, segments, tile, shape=None, center=(0, 0)):
        """Turns (radius, y) parts about y; each part is smooth, edges between parts are sharp. shape(angle, y) scales the radius."""
        for part in parts:
            lengths = [0.0]
            for (r0, y0), (r1, y1) in zip(part, part[1:]):
                lengths.append(lengths[-1] + math.hypot(r1 - r0, y1 - y0))
            around = max(1, round(2 * math.pi * max(r for r, _ in part) / tile))
            points, uvs = [], []
            for (radius, y), length in zip(part, lengths):
                row = []
                for s in range(segments + 1):
                    angle = 2 * math.pi * (s % segments) / segments
                    r = radius * (shape(angle, y) if shape else 1.0)
                    row.append((center[0] + r * math.cos(angle), y, center[1] - r * math.sin(angle)))
                points.append(row)
                uvs.append([(around * s / segments, -length / tile) for s in range(segments + 1)])
            self.grid(points, uvs, closed=True)

    def quad(self, a, b, c, d, tile, size=None):
        """Counter-clockwise; uv runs along a->b and a->d in metres / tile, or over size textures."""
        width, height = size or (math.dist(a, b) / tile, math.dist(a, d) / tile)
        self.grid([[a, b], [d, c]], [[(0, 0), (width, 0)], [(0, -height), (width, -height)]])

    def box(self, low, high, tile, faces="xXyYzZ"):
        """faces: small letters are the low sides."""
        (x0, y0, z0), (x1, y1, z1) = low, high
        sides = {
            "x": ((x0, y0, z0), (x0, y0, z1), (x0, y1, z1), (x0, y1, z0)),
            "X": ((x1, y0, z1), (x1, y0, z0), (x1, y1, z0), (x1, y1, z1)),
            "y": ((x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1)),
            "Y": ((x0, y1, z1), (x1, y1, z1), (x1, y1, z0), (x0, y1, z0)),
            "z": ((x1, y0, z0), (x0, y0, z0), (x0, y1, z0), (x1, y1, z0)),
            "Z": ((x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)),
        }
        for face in faces:
            self.quad(*sides[face], tile)


class Mesh(dict):
    """Material name -> Surface, made on first use."""

    def __missing__(self, material):
        self[material] = Surface()
        return self[material]


def smooth_profile(points, steps):
    """A Catmull-Rom curve through (radius, y) points, steps pieces between neighbours."""
    result = []
    for i in range(len(points) - 1):
        p0, p1 = points[max(i - 1, 0)], points[i]
        p2, p3 = points[i + 1], points[min(i + 2, len(points) - 1)]
        for s in range(steps):
            t = s / steps
            result.append(
                tuple(
                    0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t * t + (3 * b - a - 3 * c + d) * t * t * t)
                    for a, b, c, d in zip(p0, p1, p2, p3)
                )
            )
    result.append(points[-1])
    return result


def roll(radius, low, high, steps=5):
    """A half-round moulding (torus) bulging out from radius between two heights."""
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    return [(radius + half * math.sin(math.pi * i / steps), middle - half * math.cos(math.pi * i / steps)) for i in range(steps + 1)]
