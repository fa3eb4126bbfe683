# SPDX-License-Identifier: MIT
"""Procedural, tileable textures of the atrium. Colours are sRGB 0..1; fields are lists of floats in rows from the top."""

import math
import random

SIZE = 256


class Material:
    def __init__(self, name, color, height=None, bump=2.0, rough=0.8, metallic=0.0, mask=None, double_sided=False, emission=0.0, size=SIZE):
        """color: (r, g, b) per texel; height: field for the normal map; rough: a number or a field; mask: alpha field."""
        self.name, self.size = name, size
        self.color = _bytes(color, mask)
        self.mask = mask is not None
        self.normal = normal_map(height, size, bump) if height else None
        self.metallic = metallic
        if isinstance(rough, list):
            self.roughness = 1.0
            blue = 255 if metallic else 0
            self.surface = bytes(v for r in rough for v in (255, _byte(r), blue))
        else:
            self.roughness, self.surface = rough, None
        self.double_sided, self.emission = double_sided, emission


def _byte(value):
    return 0 if value <= 0 else 255 if value >= 1 else int(value * 255 + 0.5)


def _bytes(color, mask):
    if mask is None:
        return bytes(_byte(v) for texel in color for v in texel)
    return bytes(_byte(v) for texel, a in zip(color, mask) for v in (*texel, a))


def value_noise(size, cells_x, cells_y, seed):
    """Smooth noise in 0..1 that repeats after cells_x by cells_y lattice cells."""
    rng = random.Random(seed)
    lattice = [[rng.random() for _ in range(cells_x)] for _ in range(cells_y)]
    columns = []
    for x in range(size):
        f = x * cells_x / size
        i = int(f)
        t = f - i
        columns.append((i, (i + 1) % cells_x, t * t * (3 - 2 * t)))
    field = []
    for y in range(size):
        f = y * cells_y / size
        i = int(f)
        t = f - i
        t = t * t * (3 - 2 * t)
        top, bottom = lattice[i], lattice[(i + 1) % cells_y]
        row = [a + (b - a) * t for a, b in zip(top, bottom)]
        field.extend([row[i] + (row[j] - row[i]) * s for i, j, s in columns])
    return field


_fields = {}


def fbm(cells, octaves, seed, size=SIZE, stretch=1):
    """Sum of octaves in 0..1, contrast-stretched; stretch > 1 makes vertical streaks."""
    key = (cells, octaves, seed, size, stretch)
    if key not in _fields:
        total, weight = [0.0] * (size * size), 1.0
        for octave in range(octaves):
            layer = value_noise(size, min(cells << octave, size), max(1, min(cells << octave, size) // stretch), seed * 31 + octave)
            total = [a + weight * b for a, b in zip(total, layer)]
            weight *= 0.5
        low, high = min(total), max(total)
        _fields[key] = [(v - low) / (high - low) for v in total]
    return _fields[key]


def normal_map(height, size, strength):
    """Tangent-space normals (y up, as glTF wants) of a height field in 0..1; strength in texels a unit of height."""
    out = bytearray()
    for y in range(size):
        row = y * size
        up, down = ((y - 1) % size) * size, ((y + 1) % size) * size
        for x in range(size):
            nx = (height[row + x - 1 if x else row + size - 1] - height[row + (x + 1) % size]) * strength
            ny = (height[down + x] - height[up + x]) * strength
            scale = 127.0 / math.sqrt(nx * nx + ny * ny + 1)
            out += bytes((int(128 + nx * scale), int(128 + ny * scale), int(128 + scale)))
    return bytes(out)


def mix(a, b, t):
    return (a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t, a[2] + (b[2] - a[2]) * t)


def ramp(field, low, high):
    return [mix(low, high, v) for v in field]


def scaled(color, factors):
    return [(r * f, g * f, b * f) for (r, g, b), f in zip(color, factors)]


def veins(cells, seed, size=SIZE, width=0.06):
    """1 on thin winding lines, 0 elsewhere."""
    field = fbm(cells, 5, seed, size)
    return [max(0.0, 1.0 - abs(v - 0.5) / width) ** 2 for v in field]


def blocks(size, columns, rows, joint, seed, shift=0.5):
    """Masonry: a tone per block (0..1) and the joint's depth (1 in the block, 0 in the joint). joint in texels."""
    rng = random.Random(seed)
    tones = [[rng.random() for _ in range(columns)] for _ in range(rows)]
    tone, depth = [], []
    for y in range(size):
        fy = y * rows / size
        row = int(fy)
        dy = min(fy - row, row + 1 - fy) * size / rows
        for x in range(size):
            fx = x * columns / size + (shift if row % 2 else 0.0)
            column = int(fx)
            dx = min(fx - column, column + 1 - fx) * size / columns
            tone.append(tones[row][column % columns])
            depth.append(min(1.0, min(dx, dy) / joint))
    return tone, depth


def stone(name, low, high, seed, columns=0, rows=0, size=SIZE, joint=2.5, rough=0.85, bump=2.5, contrast=0.2):
    """Weathered stone; with columns and rows, cut into blocks."""
    grain, fine = fbm(4, 6, seed, size), fbm(64, 2, seed + 1, size)
    color = ramp([0.7 * a + 0.3 * b for a, b in zip(grain, fine)], low, high)
    height = [0.5 + 0.3 * a + 0.2 * b for a, b in zip(grain, fine)]
    if columns:
        tone, depth = blocks(size, columns, rows, joint, seed + 2)
        color = scaled(color, [(1.0 - contrast * 0.5 + contrast * t) * (0.62 + 0.38 * d) for t, d in zip(tone, depth)])
        height = [h * 0.5 + d for h, d in zip(height, depth)]
    return Material(name, color, height, bump, rough, size=size)


def checker_marble():
    """Two marbles, four tiles a texture, polished."""
    size = 512
    light, dark = veins(3, 11, size), veins(5, 12, size, 0.09)
    cloud = fbm(4, 5, 13, size)
    tone, depth = blocks(size, 4, 4, 2.0, 14, 0.0)
    color, rough = [], []
    for i in range(size * size):
        x, y = i % size, i // size
        if (x * 4 // size + y * 4 // size) % 2:
            texel = mix(mix((0.88, 0.85, 0.79), (0.80, 0.75, 0.67), cloud[i]), (0.62, 0.57, 0.52), 0.6 * light[i])
        else:
            texel = mix(mix((0.55, 0.27, 0.19), (0.42, 0.19, 0.14), cloud[i]), (0.82, 0.66, 0.56), 0.7 * dark[i])
        shade = (0.92 + 0.1 * tone[i]) * (0.6 + 0.4 * depth[i])
        color.append((texel[0] * shade, texel[1] * shade, texel[2] * shade))
        rough.append(0.28 + 0.2 * cloud[i] + 0.35 * (1 - depth[i]))
    return Material("floor_marble", color, depth, 1.0, rough, size=size)


def wood(name, low, high, planks, seed, rough=0.7):
    grain = fbm(32, 3, seed, SIZE, stretch=8)
    tone, depth = blocks(SIZE, planks, 1, 2.0, seed + 1, 0.0)
    rings = [0.5 + 0.5 * math.sin(18 * (g + 0.7 * t)) for g, t in zip(grain, tone)]
    color = scaled(ramp([0.6 * g + 0.4 * r for g, r in zip(grain, rings)], low, high), [(0.8 + 0.35 * t) * (0.45 + 0.55 * d) for t, d in zip(tone, depth)])
    return Material(name, color, [0.3 * g + d for g, d in zip(grain, depth)], 2.0, rough)


def cloth(name, base, trim, seed):
    """Woven cloth with bands of trim, each band a row of lozenges."""
    cloud = fbm(4, 4, seed)
    color, height = [], []
    for i in range(SIZE * SIZE):
        x, y = i % SIZE, i // SIZE
        thread = 0.5 + 0.25 * math.sin(x * math.pi / 2) + 0.25 * math.sin(y * math.pi / 2)
        band = y % 128
        lozenge = abs((x % 32) - 16) + abs(band - 24)
        patterned = band < 4 or 44 < band < 48 or lozenge < 10 and band < 48
        texel = trim if patterned else base
        shade = 0.78 + 0.12 * thread + 0.16 * (cloud[i] - 0.5)
        color.append((texel[0] * shade, texel[1] * shade, texel[2] * shade))
        height.append(thread)
    return Material(name, color, height, 0.8, 0.95, double_sided=True)


def roof_tiles():
    """One course of barrel tiles a half texture; the waves themselves are geometry."""
    cloud = fbm(8, 4, 41)
    tone, depth = blocks(SIZE, 8, 4, 3.0, 42, 0.0)
    color = [mix((0.62, 0.30, 0.19), (0.76, 0.46, 0.31), 0.5 * c + 0.5 * t) for c, t in zip(cloud, tone)]
    return Material("roof_tiles", scaled(color, [0.55 + 0.45 * d for d in depth]), depth, 2.0, 0.9)


def mosaic():
    """Small stones of blues and whites in a wave pattern."""
    count = 32
    tone, depth = blocks(SIZE, count, count, 1.6, 51, 0.0)
    color = []
    for i in range(SIZE * SIZE):
        cx, cy = (i % SIZE) * count // SIZE, (i // SIZE) * count // SIZE
        wave = math.sin(2 * math.pi * cx / 16) * 3 + 16
        if abs(cy - wave) < 2.2:
            texel = (0.83, 0.68, 0.36)
        elif abs(cy - wave) < 6:
            texel = (0.12, 0.33, 0.50)
        else:
            texel = (0.20, 0.52, 0.58) if (cx + cy) % 5 else (0.82, 0.84, 0.80)
        color.append(mix(texel, (0.9, 0.9, 0.86), 0.25 * tone[i]))
    return Material("mosaic", scaled(color, [0.5 + 0.5 * d for d in depth]), depth, 1.5, 0.35)


def leaf_cards(name, seed, low, high):
    """Alpha-masked leaves: 4 x 4 overlapping ellipses, each with a midrib."""
    rng = random.Random(seed)
    color, mask = [low] * (SIZE * SIZE), [0.0] * (SIZE * SIZE)
    for i in range(26):
        cx, cy, angle, length = rng.uniform(0, SIZE), rng.uniform(0, SIZE), rng.uniform(0, 2 * math.pi), rng.uniform(26, 42)
        tint = rng.random()
        ca, sa = math.cos(angle), math.sin(angle)
        for y in range(int(cy - length), int(cy + length)):
            for x in range(int(cx - length), int(cx + length)):
                u, v = ((x - cx) * ca + (y - cy) * sa) / length, ((y - cy) * ca - (x - cx) * sa) / length
                half = 0.42 * (1 - u * u) * (1 + 0.35 * u)
                if abs(u) < 1 and abs(v) < half:
                    rib = 0.75 if abs(v) < 0.03 or abs((u * 6 + abs(v) * 5) % 1 - 0.5) < 0.06 else 1.0
                    r, g, b = mix(low, high, 0.35 * tint + 0.65 * abs(v) / 0.42)
                    index = (y % SIZE) * SIZE + x % SIZE
                    color[index], mask[index] = (r * rib, g * rib, b * rib), 1.0
    return Material(name, color, mask=mask, rough=0.6, double_sided=True)


def palm_leaf():
    """One frond along v: pinnate leaflets on both sides of a stalk."""
    color, mask = [], []
    for i in range(SIZE * SIZE):
        x, y = (i % SIZE) / SIZE * 2 - 1, (i // SIZE) / SIZE
        along = (y * 22 - abs(x) * 5) % 1.0
        inside = abs(x) < 0.03 or (abs(x) < 0.95 * math.sin(math.pi * min(1.0, 0.06 + 0.94 * y)) ** 0.6 and along < 0.66)
        mask.append(1.0 if inside else 0.0)
        color.append(mix((0.16, 0.30, 0.10), (0.38, 0.52, 0.18), 0.6 * abs(x) + 0.4 * along))
    return Material("palm_leaf", color, mask=mask, rough=0.6, double_sided=True)


def all_materials():
    """The 25 materials, textures and all."""
    plaster = fbm(3, 6, 61)
    lamp = [mix((1.0, 0.62, 0.26), (1.0, 0.86, 0.58), v) for v in fbm(4, 3, 71)]
    ripples = fbm(8, 4, 81)
    glaze = fbm(6, 5, 91)
    patina = fbm(6, 5, 95)
    return [
        stone("wall_limestone", (0.66, 0.58, 0.46), (0.84, 0.77, 0.65), 1, 4, 8, 512, 3.0),
        Material("wall_plaster", ramp(plaster, (0.80, 0.62, 0.42), (0.88, 0.73, 0.54)), plaster, 3.0, 0.95),
        stone("column_travertine", (0.72, 0.65, 0.54), (0.89, 0.84, 0.75), 5),
        stone("capital_stone", (0.76, 0.70, 0.60), (0.90, 0.86, 0.78), 7),
        stone("arch_stone", (0.62, 0.45, 0.35), (0.86, 0.74, 0.61), 9, 1, 2, contrast=0.55),
        stone("spandrel_stone", (0.74, 0.67, 0.56), (0.88, 0.81, 0.70), 15, 4, 6),
        stone("cornice_stone", (0.72, 0.68, 0.60), (0.88, 0.85, 0.78), 17),
        checker_marble(),
        stone("floor_terracotta", (0.52, 0.26, 0.17), (0.72, 0.42, 0.28), 21, 4, 4, joint=3.0, rough=0.7),
        wood("floor_planks", (0.34, 0.22, 0.13), (0.54, 0.37, 0.23), 8, 23),
        wood("beam_wood", (0.28, 0.17, 0.10), (0.44, 0.29, 0.17), 2, 25),
        wood("door_wood", (0.20, 0.26, 0.22), (0.32, 0.40, 0.34), 6, 27, 0.55),
        stone("balustrade_marble", (0.80, 0.77, 0.72), (0.93, 0.91, 0.88), 29, rough=0.5),
        cloth("curtain_red", (0.62, 0.07, 0.06), (0.85, 0.62, 0.24), 31),
        cloth("curtain_green", (0.10, 0.36, 0.15), (0.84, 0.70, 0.34), 33),
        cloth("curtain_blue", (0.08, 0.18, 0.50), (0.86, 0.78, 0.55), 35),
        cloth("curtain_ochre", (0.80, 0.48, 0.10), (0.48, 0.12, 0.08), 37),
        roof_tiles(),
        mosaic(),
        Material("vase_glaze", ramp(glaze, (0.05, 0.24, 0.34), (0.14, 0.50, 0.54)), rough=[0.12 + 0.2 * v for v in glaze]),
        leaf_cards("ivy_leaf", 53, (0.12, 0.26, 0.08), (0.34, 0.50, 0.16)),
        palm_leaf(),
        Material("bronze", ramp(patina, (0.52, 0.36, 0.20), (0.66, 0.52, 0.32)), rough=[0.3 + 0.3 * v for v in patina], metallic=1.0),
        Material("lamp_glass", lamp, rough=0.4, emission=14.0),
        Material("water", ramp(ripples, (0.05, 0.17, 0.19), (0.09, 0.25, 0.26)), ripples, 3.0, 0.06),
    ]
