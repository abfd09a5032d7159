#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes town.obj, street.obj, town.mtl and lamp.gltf beside itself: `python3 make_town.py`.

Layout, in the scene's frame (metres, z up, origin at the south-west corner; the OBJ and glTF files are y up as their
readers expect: x stays, file y = z, file z = -y). The town covers x and y from 0 to 160.

  street       along y at x = 80, from y = 0 to 160: road 8 m wide (x 76..84), pavements to x = 72.5 and 87.5
  side street  along x at y = 84, road 6 m wide (y 81..87)
  houses       two rows facing the street (fronts near x = 72 and x = 88), eight more behind them, at most 17 m high
  church       tower at (104, 128), top of its spire at z = 38
  lamp (OBJ)   post at (74.5, 44), arm over the road, lamp housing at (76.1, 44, 6.0): put the sodium light at (76.1, 44, 5.8)
  lamp.gltf    one more lamp with its own punctual spot light; origin at the foot of the post, arm along +x, light at 5.8 m
  camera       eye (80, 14, 1.7) looks at (79, 80, 5) down the street; lamp in its left half

town.obj is solid (houses stand on the ground without a floor); street.obj (road, kerbs, markings) is a few centimetres high and
meant to be drawn only, the ground plane at z = 0 catches the flakes.
"""
import base64
import json
import math
import pathlib
import struct

HERE = pathlib.Path(__file__).resolve().parent

MATERIALS = {  # name: (albedo, emission)
    "plaster_cream": ((0.62, 0.56, 0.44), None),
    "plaster_ochre": ((0.55, 0.38, 0.20), None),
    "plaster_grey": ((0.45, 0.46, 0.48), None),
    "plaster_rose": ((0.52, 0.32, 0.28), None),
    "brick": ((0.35, 0.15, 0.10), None),
    "stone": ((0.42, 0.40, 0.37), None),
    "roof_tile": ((0.30, 0.13, 0.09), None),
    "roof_slate": ((0.16, 0.17, 0.20), None),
    "roof_snow": ((0.80, 0.82, 0.86), None),
    "wood": ((0.20, 0.12, 0.07), None),
    "window_dark": ((0.05, 0.06, 0.08), None),
    "window_lit": ((0.30, 0.22, 0.10), (0.90, 0.55, 0.20)),
    "iron": ((0.06, 0.06, 0.07), None),
    "lamp_glass": ((0.60, 0.45, 0.20), (9.0, 4.6, 0.9)),
    "asphalt": ((0.12, 0.12, 0.13), None),
    "pavement": ((0.36, 0.36, 0.36), None),
    "marking": ((0.75, 0.75, 0.72), None),
}


class Mesh:
    """Polygons by material; counter-clockwise seen from outside."""

    def __init__(self):
        self.vertices = {}
        self.faces = {}

    def face(self, material, *points):
        indices = []
        for point in points:
            key = tuple(round(c, 3) for c in point)
            indices.append(self.vertices.setdefault(key, len(self.vertices) + 1))
        self.faces.setdefault(material, []).append(indices)

    def write(self, path, title):
        lines = [f"# {title}; written by make_town.py; y up, metres", "mtllib town.mtl"]
        lines += ["v {:g} {:g} {:g}".format(x, z, -y) for x, y, z in self.vertices]
        for material, faces in self.faces.items():
            lines.append(f"usemtl {material}")
            lines += ["f " + " ".join(map(str, face)) for face in faces]
        path.write_text("\n".join(lines) + "\n")


def box(mesh, material, low, high, bottom=False):
    (x0, y0, z0), (x1, y1, z1) = low, high
    mesh.face(material, (x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1))
    mesh.face(material, (x1, y1, z0), (x0, y1, z0), (x0, y1, z1), (x1, y1, z1))
    mesh.face(material, (x0, y1, z0), (x0, y0, z0), (x0, y0, z1), (x0, y1, z1))
    mesh.face(material, (x1, y0, z0), (x1, y1, z0), (x1, y1, z1), (x1, y0, z1))
    mesh.face(material, (x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1))
    if bottom:
        mesh.face(material, (x0, y1, z0), (x1, y1, z0), (x1, y0, z0), (x0, y0, z0))


def pane(mesh, material, side, at, along, bottom, width, height):
    """A window or door 5 cm in front of a wall; side: the wall's outward normal, along: its centre on the wall."""
    a, b = along - width / 2, along + width / 2
    z0, z1 = bottom, bottom + height
    if side == "-x":
        x = at - 0.05
        corners = [(x, b, z0), (x, a, z0), (x, a, z1), (x, b, z1)]
    elif side == "+x":
        x = at + 0.05
        corners = [(x, a, z0), (x, b, z0), (x, b, z1), (x, a, z1)]
    elif side == "-y":
        y = at - 0.05
        corners = [(a, y, z0), (b, y, z0), (b, y, z1), (a, y, z1)]
    else:
        y = at + 0.05
        corners = [(b, y, z0), (a, y, z0), (a, y, z1), (b, y, z1)]
    mesh.face(material, *corners)


def windows(mesh, house, floors, floor_height):
    """Rows of windows on the four walls; about one in four is lit, chosen by a fixed hash of its place."""
    x0, y0, x1, y1 = house
    walls = [("-x", x0, y0, y1), ("+x", x1, y0, y1), ("-y", y0, x0, x1), ("+y", y1, x0, x1)]
    for wall, (side, at, begin, end) in enumerate(walls):
        count = max(2, int((end - begin) / 2.6))
        for floor in range(floors):
            for n in range(count):
                along = begin + (end - begin) * (n + 0.5) / count
                door = floor == 0 and n == count // 2 and wall < 2
                draw = (int(x0 * 7 + y0 * 13) + wall * 31 + floor * 17 + n * 11) * 2654435761 % 2**32
                lit = draw >> 30 == 0
                if door:
                    pane(mesh, "wood", side, at, along, 0.1, 1.2, 2.2)
                else:
                    bottom = floor * floor_height + 0.9
                    pane(mesh, "window_lit" if lit else "window_dark", side, at, along, bottom, 1.1, 1.4)


def gable(mesh, wall, roof, house, eaves, ridge, axis):
    """Walls up to the eaves, two gable triangles and a roof that hangs over by 0.4 m and is 0.25 m thick."""
    x0, y0, x1, y1 = house
    over = 0.4
    if axis == "y":  # ridge along y
        xm = (x0 + x1) / 2
        mesh.face(wall, (x0, y0, eaves), (x1, y0, eaves), (xm, y0, ridge))
        mesh.face(wall, (x1, y1, eaves), (x0, y1, eaves), (xm, y1, ridge))
        drop = over * (ridge - eaves) / (xm - x0)
        for t, under in ((0.25, False), (0.0, True)):
            left = [(x0 - over, y0 - over, eaves - drop + t), (xm, y0 - over, ridge + t),
                    (xm, y1 + over, ridge + t), (x0 - over, y1 + over, eaves - drop + t)]
            right = [(x1 + over, y1 + over, eaves - drop + t), (xm, y1 + over, ridge + t),
                     (xm, y0 - over, ridge + t), (x1 + over, y0 - over, eaves - drop + t)]
            for side in (left, right):
                mesh.face("wood" if under else roof, *(reversed(side) if under else side))
        rims = [((x0 - over, y0 - over, eaves - drop), (xm, y0 - over, ridge)),
                ((xm, y0 - over, ridge), (x1 + over, y0 - over, eaves - drop)),
                ((x1 + over, y0 - over, eaves - drop), (x1 + over, y1 + over, eaves - drop)),
                ((x1 + over, y1 + over, eaves - drop), (xm, y1 + over, ridge)),
                ((xm, y1 + over, ridge), (x0 - over, y1 + over, eaves - drop)),
                ((x0 - over, y1 + over, eaves - drop), (x0 - over, y0 - over, eaves - drop))]
    else:  # ridge along x
        ym = (y0 + y1) / 2
        mesh.face(wall, (x1, y0, eaves), (x1, y1, eaves), (x1, ym, ridge))
        mesh.face(wall, (x0, y1, eaves), (x0, y0, eaves), (x0, ym, ridge))
        drop = over * (ridge - eaves) / (ym - y0)
        for t, under in ((0.25, False), (0.0, True)):
            south = [(x0 - over, y0 - over, eaves - drop + t), (x1 + over, y0 - over, eaves - drop + t),
                     (x1 + over, ym, ridge + t), (x0 - over, ym, ridge + t)]
            north = [(x1 + over, y1 + over, eaves - drop + t), (x0 - over, y1 + over, eaves - drop + t),
                     (x0 - over, ym, ridge + t), (x1 + over, ym, ridge + t)]
            for side in (south, north):
                mesh.face("wood" if under else roof, *(reversed(side) if under else side))
        rims = [((x0 - over, y0 - over, eaves - drop), (x1 + over, y0 - over, eaves - drop)),
                ((x1 + over, y0 - over, eaves - drop), (x1 + over, ym, ridge)),
                ((x1 + over, ym, ridge), (x1 + over, y1 + over, eaves - drop)),
                ((x1 + over, y1 + over, eaves - drop), (x0 - over, y1 + over, eaves - drop)),
                ((x0 - over, y1 + over, eaves - drop), (x0 - over, ym, ridge)),
                ((x0 - over, ym, ridge), (x0 - over, y0 - over, eaves - drop))]
    for (ax, ay, az), (bx, by, bz) in rims:
        mesh.face("wood", (ax, ay, az), (bx, by, bz), (bx, by, bz + 0.25), (ax, ay, az + 0.25))


def walls(mesh, material, house, height):
    x0, y0, x1, y1 = house
    mesh.face(material, (x0, y0, 0), (x1, y0, 0), (x1, y0, height), (x0, y0, height))
    mesh.face(material, (x1, y1, 0), (x0, y1, 0), (x0, y1, height), (x1, y1, height))
    mesh.face(material, (x0, y1, 0), (x0, y0, 0), (x0, y0, height), (x0, y1, height))
    mesh.face(material, (x1, y0, 0), (x1, y1, 0), (x1, y1, height), (x1, y0, height))


def gabled_house(mesh, house, floors, wall, roof, axis, rise):
    eaves = 3.0 * floors + 0.4
    walls(mesh, wall, house, eaves)
    gable(mesh, wall, roof, house, eaves, eaves + rise, axis)
    windows(mesh, house, floors, 3.0)
    x0, y0, x1, y1 = house
    cx, cy = x0 + 0.3 * (x1 - x0), y0 + 0.3 * (y1 - y0)  # chimney
    box(mesh, "brick", (cx - 0.4, cy - 0.4, eaves), (cx + 0.4, cy + 0.4, eaves + rise + 0.9))


def flat_house(mesh, house, floors, wall):
    height = 3.2 * floors + 0.3
    x0, y0, x1, y1 = house
    walls(mesh, wall, house, height)
    mesh.face("roof_snow", (x0, y0, height), (x1, y0, height), (x1, y1, height), (x0, y1, height))
    for low, high in (((x0, y0), (x1, y0 + 0.3)), ((x0, y1 - 0.3), (x1, y1)),
                      ((x0, y0 + 0.3), (x0 + 0.3, y1 - 0.3)), ((x1 - 0.3, y0 + 0.3), (x1, y1 - 0.3))):
        box(mesh, wall, (*low, height), (*high, height + 0.7))
    windows(mesh, house, floors, 3.2)


def church(mesh, x, y):
    """Tower 7 x 7 m with a pyramid spire, nave of 11 x 22 m north of it."""
    tower = (x - 3.5, y - 3.5, x + 3.5, y + 3.5)
    walls(mesh, "stone", tower, 24)
    x0, y0, x1, y1 = (x - 3.9, y - 3.9, x + 3.9, y + 3.9)
    top = (x, y, 38.0)
    base = [(x0, y0, 24.0), (x1, y0, 24.0), (x1, y1, 24.0), (x0, y1, 24.0)]
    for i in range(4):
        mesh.face("roof_slate", base[i], base[(i + 1) % 4], top)
    mesh.face("wood", *reversed(base))
    for side, at, along in (("-x", x - 3.5, y), ("+x", x + 3.5, y), ("-y", y - 3.5, x), ("+y", y + 3.5, x)):
        pane(mesh, "window_dark", side, at, along, 19.0, 1.6, 3.2)
        pane(mesh, "window_lit", side, at, along, 9.0, 1.0, 2.6)
    pane(mesh, "wood", "-y", y - 3.5, x, 0.1, 2.2, 3.4)
    nave = (x - 5.5, y + 3.5, x + 5.5, y + 25.5)
    walls(mesh, "stone", nave, 9)
    gable(mesh, "stone", "roof_snow", nave, 9, 16, "y")
    for n in range(5):
        for side, at in (("-x", x - 5.5), ("+x", x + 5.5)):
            pane(mesh, "window_lit", side, at, y + 6 + 4.2 * n, 2.5, 1.3, 4.6)


def tube(mesh, material, a, b, radius, sides=6):
    """A closed prism from a to b."""
    d = [b[i] - a[i] for i in range(3)]
    length = math.sqrt(sum(c * c for c in d))
    d = [c / length for c in d]
    u = (0.0, 0.0, 1.0) if abs(d[2]) < 0.9 else (1.0, 0.0, 0.0)
    v = (d[1] * u[2] - d[2] * u[1], d[2] * u[0] - d[0] * u[2], d[0] * u[1] - d[1] * u[0])
    norm = math.sqrt(sum(c * c for c in v))
    v = [c / norm for c in v]
    w = (d[1] * v[2] - d[2] * v[1], d[2] * v[0] - d[0] * v[2], d[0] * v[1] - d[1] * v[0])
    ring = []
    for i in range(sides):
        c, s = math.cos(2 * math.pi * i / sides) * radius, math.sin(2 * math.pi * i / sides) * radius
        ring.append([c * v[k] + s * w[k] for k in range(3)])
    near = [tuple(a[k] + r[k] for k in range(3)) for r in ring]
    far = [tuple(b[k] + r[k] for k in range(3)) for r in ring]
    for i in range(sides):
        j = (i + 1) % sides
        mesh.face(material, near[i], near[j], far[j], far[i])
    mesh.face(material, *reversed(near))
    mesh.face(material, *far)


def lamp(mesh, x, y):
    """Post, arm along +x, housing over the road; the light hangs at (x + 1.6, y, 5.8)."""
    tube(mesh, "iron", (x, y, 0), (x, y, 0.9), 0.14)
    tube(mesh, "iron", (x, y, 0.9), (x, y, 6.0), 0.07)
    tube(mesh, "iron", (x, y, 6.0), (x + 1.3, y, 6.25), 0.045)
    box(mesh, "iron", (x + 1.15, y - 0.18, 6.02), (x + 2.05, y + 0.18, 6.28), bottom=True)
    box(mesh, "lamp_glass", (x + 1.25, y - 0.14, 5.92), (x + 1.95, y + 0.14, 6.02), bottom=True)


def town():
    mesh = Mesh()
    west = [  # y0, y1, depth, floors, kind, wall, roof, rise
        (6, 17, 12, 2, "gable_x", "plaster_cream", "roof_snow", 4.5),
        (19, 29, 11, 3, "gable_y", "brick", "roof_tile", 4.0),
        (31, 41, 13, 2, "gable_y", "plaster_rose", "roof_snow", 4.2),
        (50, 64, 14, 4, "flat", "plaster_grey", None, 0),
        (66, 76, 11, 2, "gable_x", "plaster_ochre", "roof_slate", 5.0),
        (91, 103, 12, 3, "gable_y", "plaster_cream", "roof_snow", 4.6),
        (106, 117, 12, 2, "gable_x", "brick", "roof_tile", 4.0),
        (121, 136, 14, 3, "gable_y", "plaster_grey", "roof_snow", 5.0),
    ]
    east = [
        (4, 16, 12, 3, "gable_y", "plaster_ochre", "roof_snow", 4.5),
        (19, 33, 15, 2, "flat", "brick", None, 0),
        (36, 46, 11, 2, "gable_x", "plaster_grey", "roof_slate", 4.6),
        (48, 58, 12, 3, "gable_y", "plaster_cream", "roof_snow", 4.0),
        (61, 75, 13, 2, "gable_y", "plaster_rose", "roof_tile", 5.0),
        (92, 104, 12, 4, "flat", "plaster_ochre", None, 0),
    ]
    behind = [
        ((30, 10, 44, 20), 2, "gable_x", "plaster_grey", "roof_snow", 4.4),
        ((28, 34, 40, 46), 3, "gable_y", "plaster_cream", "roof_tile", 4.6),
        ((26, 58, 42, 70), 2, "flat", "brick", None, 0),
        ((28, 96, 41, 108), 2, "gable_y", "plaster_ochre", "roof_snow", 4.8),
        ((120, 12, 134, 24), 3, "gable_x", "plaster_rose", "roof_slate", 4.4),
        ((118, 40, 131, 52), 2, "gable_y", "plaster_cream", "roof_snow", 4.2),
        ((122, 62, 138, 75), 2, "flat", "plaster_grey", None, 0),
        ((122, 100, 135, 112), 3, "gable_y", "brick", "roof_snow", 5.0),
    ]
    houses = [((72 - d, y0, 72, y1), f, k, w, r, h) for y0, y1, d, f, k, w, r, h in west]
    houses += [((88, y0, 88 + d, y1), f, k, w, r, h) for y0, y1, d, f, k, w, r, h in east]
    for house, floors, kind, wall, roof, rise in houses + behind:
        if kind == "flat":
            flat_house(mesh, house, floors, wall)
        else:
            gabled_house(mesh, house, floors, wall, roof, kind[-1], rise)
    church(mesh, 104, 128)
    lamp(mesh, 74.5, 44)
    mesh.write(HERE / "town.obj", "the houses of the town, solid")


def street():
    mesh = Mesh()
    for y0, y1 in ((0, 81), (87, 160)):
        mesh.face("asphalt", (76, y0, 0.04), (84, y0, 0.04), (84, y1, 0.04), (76, y1, 0.04))
        for x0, x1 in ((72.5, 76), (84, 87.5)):
            box(mesh, "pavement", (x0, y0, 0), (x1, y1, 0.15))
    mesh.face("asphalt", (0, 81, 0.04), (160, 81, 0.04), (160, 87, 0.04), (0, 87, 0.04))
    for y in range(2, 160, 6):
        if y < 78 or y > 88:
            mesh.face("marking", (79.93, y, 0.07), (80.07, y, 0.07), (80.07, y + 3, 0.07), (79.93, y + 3, 0.07))
    mesh.write(HERE / "street.obj", "road, kerbs and markings, drawn only")


def materials():
    lines = ["# written by make_town.py"]
    for name, (albedo, emission) in MATERIALS.items():
        lines += [f"newmtl {name}", "Kd {:g} {:g} {:g}".format(*albedo)]
        if emission:
            lines.append("Ke {:g} {:g} {:g}".format(*emission))
    (HERE / "town.mtl").write_text("\n".join(lines) + "\n")


def lamp_gltf():
    """The lamp as glTF 2 with an embedded buffer, a node transform and a KHR_lights_punctual spot."""
    mesh = Mesh()
    lamp(mesh, 0, 0)
    points = list(mesh.vertices)
    buffer, views, accessors, primitives = b"", [], [], []

    def add(data, component, kind, count, target, low=None, high=None):
        nonlocal buffer
        buffer += b"\0" * (-len(buffer) % 4)
        views.append({"buffer": 0, "byteOffset": len(buffer), "byteLength": len(data), "target": target})
        accessor = {"bufferView": len(views) - 1, "componentType": component, "count": count, "type": kind}
        if low:
            accessor |= {"min": low, "max": high}
        accessors.append(accessor)
        buffer += data
        return len(accessors) - 1

    for number, (_, faces) in enumerate(mesh.faces.items()):
        positions, normals, indices = [], [], []
        for face in faces:
            p = [(points[i - 1][0], points[i - 1][2], -points[i - 1][1]) for i in face]
            a = [p[1][k] - p[0][k] for k in range(3)]
            b = [p[2][k] - p[0][k] for k in range(3)]
            n = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
            norm = math.sqrt(sum(c * c for c in n))
            first = len(positions)
            positions += p
            normals += [tuple(c / norm for c in n)] * len(p)
            for i in range(1, len(p) - 1):
                indices += [first, first + i, first + i + 1]
        low = [min(p[k] for p in positions) for k in range(3)]
        high = [max(p[k] for p in positions) for k in range(3)]
        single = lambda bound: [struct.unpack("<f", struct.pack("<f", c))[0] for c in bound]
        position = add(b"".join(struct.pack("<3f", *p) for p in positions), 5126, "VEC3", len(positions), 34962,
                       single(low), single(high))
        normal = add(b"".join(struct.pack("<3f", *n) for n in normals), 5126, "VEC3", len(normals), 34962)
        index = add(struct.pack(f"<{len(indices)}H", *indices), 5123, "SCALAR", len(indices), 34963)
        primitives.append({"attributes": {"POSITION": position, "NORMAL": normal}, "indices": index, "material": number})

    gltf_materials = []
    for name in mesh.faces:
        albedo, emission = MATERIALS[name]
        entry = {"name": name, "pbrMetallicRoughness": {"baseColorFactor": [*albedo, 1.0], "metallicFactor": 0.0,
                                                        "roughnessFactor": 0.8}}
        if emission:
            strength = max(emission)
            entry["emissiveFactor"] = [c / strength for c in emission]
            entry["extensions"] = {"KHR_materials_emissive_strength": {"emissiveStrength": strength}}
        gltf_materials.append(entry)

    down = [-math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)]  # a glTF light shines along its node's -z; this turns it to -y
    document = {
        "asset": {"version": "2.0", "generator": "make_town.py"},
        "extensionsUsed": ["KHR_lights_punctual", "KHR_materials_emissive_strength"],
        "extensions": {"KHR_lights_punctual": {"lights": [{
            "name": "sodium", "type": "spot", "color": [1.0, 0.55, 0.13], "intensity": 120.0, "range": 60.0,
            "spot": {"innerConeAngle": 0.7, "outerConeAngle": 1.2}}]}},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "lamp", "mesh": 0, "children": [1]},
                  {"name": "light", "translation": [1.6, 5.8, 0.0], "rotation": down,
                   "extensions": {"KHR_lights_punctual": {"light": 0}}}],
        "meshes": [{"name": "lamp", "primitives": primitives}],
        "materials": gltf_materials,
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": len(buffer),
                     "uri": "data:application/octet-stream;base64," + base64.b64encode(buffer).decode()}],
    }
    (HERE / "lamp.gltf").write_text(json.dumps(document, indent=1) + "\n")


if __name__ == "__main__":
    town()
    street()
    materials()
    lamp_gltf()
