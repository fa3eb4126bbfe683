# SPDX-License-Identifier: MIT
"""Writes a .glb: meshes made of surfaces, instanced nodes, materials with embedded PNG textures."""

import json
import math
import struct
import zlib
from array import array


def png(width, height, channels, texels):
    """An 8-bit PNG of bytes in rows from the top; channels is 3 or 4. Rows are stored as differences to the row above, which compresses well."""
    stride = width * channels
    rows = bytearray()
    above = bytes(stride)
    for start in range(0, len(texels), stride):
        row = texels[start : start + stride]
        rows.append(2)
        rows += bytes((a - b) & 255 for a, b in zip(row, above))
        above = row

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 2 if channels == 3 else 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(bytes(rows), 6)) + chunk(b"IEND", b"")


class GltfWriter:
    def __init__(self, generator):
        self.blob = bytearray()
        self.json = {
            "asset": {"version": "2.0", "generator": generator},
            "extensionsUsed": ["KHR_materials_emissive_strength"],
            "scene": 0,
            "scenes": [{"nodes": []}],
            "nodes": [],
            "meshes": [],
            "materials": [],
            "textures": [],
            "images": [],
            "samplers": [{"magFilter": 9729, "minFilter": 9987, "wrapS": 10497, "wrapT": 10497}],
            "accessors": [],
            "bufferViews": [],
        }
        self.material_index = {}
        self.mesh_index = {}
        self.mesh_triangles = {}
        self.triangles = 0

    def add_view(self, data, target=None):
        self.blob += bytes(-len(self.blob) % 4)
        view = {"buffer": 0, "byteOffset": len(self.blob), "byteLength": len(data)}
        if target:
            view["target"] = target
        self.blob += data
        self.json["bufferViews"].append(view)
        return len(self.json["bufferViews"]) - 1

    def add_accessor(self, values, component, kind, width, bounds=False):
        target = 34963 if kind == "SCALAR" else 34962
        accessor = {"bufferView": self.add_view(values.tobytes(), target), "componentType": component, "count": len(values) // width, "type": kind}
        if bounds:
            accessor["min"] = [min(values[i::width]) for i in range(width)]
            accessor["max"] = [max(values[i::width]) for i in range(width)]
        self.json["accessors"].append(accessor)
        return len(self.json["accessors"]) - 1

    def add_texture(self, name, data):
        self.json["images"].append({"name": name, "mimeType": "image/png", "bufferView": self.add_view(data)})
        self.json["textures"].append({"sampler": 0, "source": len(self.json["images"]) - 1})
        return {"index": len(self.json["textures"]) - 1}

    def add_material(self, material):
        """A textures.Material."""
        channels = 4 if material.mask else 3
        base = self.add_texture(material.name + "_color", png(material.size, material.size, channels, material.color))
        pbr = {"baseColorTexture": base, "metallicFactor": material.metallic, "roughnessFactor": material.roughness}
        entry = {"name": material.name, "pbrMetallicRoughness": pbr}
        if material.surface:
            pbr["metallicRoughnessTexture"] = self.add_texture(material.name + "_surface", png(material.size, material.size, 3, material.surface))
        if material.normal:
            entry["normalTexture"] = self.add_texture(material.name + "_normal", png(material.size, material.size, 3, material.normal))
        if material.mask:
            entry["alphaMode"] = "MASK"
            entry["alphaCutoff"] = 0.5
        if material.double_sided:
            entry["doubleSided"] = True
        if material.emission:
            entry["emissiveTexture"] = base
            entry["emissiveFactor"] = [1.0, 1.0, 1.0]
            entry["extensions"] = {"KHR_materials_emissive_strength": {"emissiveStrength": material.emission}}
        self.material_index[material.name] = len(self.json["materials"])
        self.json["materials"].append(entry)

    def add_mesh(self, name, surfaces):
        """surfaces: material name -> geometry.Surface."""
        primitives, triangles = [], 0
        for material, surface in surfaces.items():
            attributes = {
                "POSITION": self.add_accessor(surface.positions, 5126, "VEC3", 3, bounds=True),
                "NORMAL": self.add_accessor(surface.normals, 5126, "VEC3", 3),
                "TEXCOORD_0": self.add_accessor(surface.uvs, 5126, "VEC2", 2),
            }
            wide = len(surface.positions) // 3 > 65535
            indices = surface.indices if wide else array("H", surface.indices)
            primitives.append(
                {
                    "attributes": attributes,
                    "indices": self.add_accessor(indices, 5125 if wide else 5123, "SCALAR", 1),
                    "material": self.material_index[material],
                }
            )
            triangles += len(surface.indices) // 3
        self.mesh_index[name] = len(self.json["meshes"])
        self.mesh_triangles[name] = triangles
        self.json["meshes"].append({"name": name, "primitives": primitives})

    def add_node(self, name, mesh, position=(0, 0, 0), turn=0.0, scale=1.0):
        """turn: about y, radians."""
        node = {"name": name, "mesh": self.mesh_index[mesh]}
        if any(position):
            node["translation"] = [round(v, 6) for v in position]
        if turn:
            node["rotation"] = [0.0, round(math.sin(turn / 2), 9), 0.0, round(math.cos(turn / 2), 9)]
        if scale != 1.0:
            node["scale"] = [scale] * 3
        self.json["scenes"][0]["nodes"].append(len(self.json["nodes"]))
        self.json["nodes"].append(node)
        self.triangles += self.mesh_triangles[mesh]

    def write(self, path):
        self.blob += bytes(-len(self.blob) % 4)
        self.json["buffers"] = [{"byteLength": len(self.blob)}]
        text = json.dumps(self.json, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        with open(path, "wb") as file:
            file.write(struct.pack("<4sII", b"glTF", 2, 12 + 8 + len(text) + 8 + len(self.blob)))
            file.write(struct.pack("<I4s", len(text), b"JSON") + text)
            file.write(struct.pack("<I4s", len(self.blob), b"BIN\0") + self.blob)
