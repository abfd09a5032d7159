#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes plow.obj and plow.mtl beside itself: `python3 make_plow.py`.

A snow plow truck as a driver behind it sees it, after the report's: two bright amber lamps on top, two red tail lamps that are
far dimmer, and two flaps of bare metal. Vehicle frame: metres, z up, forward is +y, the origin on the road below the
middle of the rear; the OBJ is y up as readers expect (file y = z, file z = -y). Put lights where LAMPS says.
"""
import math
import pathlib

HERE = pathlib.Path(__file__).resolve().parent

MATERIALS = {  # name: (albedo, emission, roughness or None for matt, metallic)
    "paint": ((0.55, 0.22, 0.03), None, 0.45, 0),
    "hopper": ((0.5, 0.5, 0.48), None, 0.6, 0),
    "rubber": ((0.03, 0.03, 0.03), None, None, 0),
    "frame": ((0.08, 0.08, 0.09), None, None, 0),
    "flap": ((0.85, 0.85, 0.87), None, 0.22, 1),
    "glass": ((0.04, 0.05, 0.06), None, 0.2, 0),
    "blade": ((0.6, 0.3, 0.05), None, 0.5, 0),
    "amber_lamp": ((0.3, 0.2, 0.02), (60, 32, 2.5), None, 0),
    "red_lamp": ((0.3, 0.02, 0.02), (5.5, 0.22, 0.12), None, 0),
}
LAMPS = {"amber": [(-0.95, -0.2, 3.05), (0.95, -0.2, 3.05)], "red": [(-1.05, -0.12, 1.05), (1.05, -0.12, 1.05)]}


def number_of(table, triple):
    """In the order of first mention, from 1 on."""
    return table.setdefault(tuple(round(c, 3) for c in triple), len(table) + 1)


class Mesh:
    """Polygons by material; counter-clockwise seen from outside."""

    def __init__(self):
        self.vertices = {}
        self.normals = {}
        self.faces = {}

    def face(self, material, *points, normals=()):
        """Flat, or with a normal for each point."""
        corners = [str(number_of(self.vertices, point)) for point in points]
        if normals:
            corners = [f"{corner}//{number_of(self.normals, normal)}" for corner, normal in zip(corners, normals)]
        self.faces.setdefault(material, []).append(corners)

    def box(self, material, low, high):
        (x0, y0, z0), (x1, y1, z1) = low, high
        corners = {(i, j, k): (x, y, z) for i, x in enumerate((x0, x1)) for j, y in enumerate((y0, y1)) for k, z in enumerate((z0, z1))}
        for face in (((0, 0, 0), (1, 0, 0), (1, 0, 1), (0, 0, 1)), ((1, 1, 0), (0, 1, 0), (0, 1, 1), (1, 1, 1)),
                     ((0, 1, 0), (0, 0, 0), (0, 0, 1), (0, 1, 1)), ((1, 0, 0), (1, 1, 0), (1, 1, 1), (1, 0, 1)),
                     ((0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)), ((0, 1, 0), (1, 1, 0), (1, 0, 0), (0, 0, 0))):
            self.face(material, *(corners[c] for c in face))

    def disc(self, material, axis, centre, radius, half_width, sides=16):
        """A short cylinder along x (a wheel) or y (a lamp that looks back)."""
        ring = [(math.cos(2 * math.pi * i / sides) * radius, math.sin(2 * math.pi * i / sides) * radius) for i in range(sides)]

        def place(along, u, v):
            x, y, z = centre
            return (x + along, y + u, z + v) if axis == "x" else (x + u, y + along, z + v)

        ends = [[place(side * half_width, u, v) for u, v in ring] for side in (-1, 1)]
        outward = axis == "x"
        self.face(material, *(reversed(ends[0]) if outward else ends[0]))
        self.face(material, *(ends[1] if outward else reversed(ends[1])))
        for i in range(sides):
            j = (i + 1) % sides
            quad = (ends[0][i], ends[0][j], ends[1][j], ends[1][i])
            self.face(material, *(quad if outward else reversed(quad)))

    def write(self, path):
        lines = ["# snow plow; written by make_plow.py; y up, metres", "mtllib plow.mtl"]
        lines += ["v {:g} {:g} {:g}".format(x, z, -y) for x, y, z in self.vertices]
        lines += ["vn {:g} {:g} {:g}".format(x, z, -y) for x, y, z in self.normals]
        for material, faces in self.faces.items():
            lines.append(f"usemtl {material}")
            lines += ["f " + " ".join(face) for face in faces]
        path.write_text("\n".join(lines) + "\n")


def flap(mesh, x):
    """Bare metal behind a rear wheel, bent a little so that it catches lamps from several sides."""
    rows, columns = 8, 8

    def point(row, column):
        across, down = column / columns * 2 - 1, row / rows
        bulge = 0.04 * math.cos(across * math.pi / 2) + 0.05 * math.sin(down * math.pi)
        return x + 0.32 * across, -0.08 - bulge, 0.95 - 0.67 * down

    def normal(row, column):
        across, down = column / columns * 2 - 1, row / rows
        by_x = 0.04 * math.pi / 2 * math.sin(across * math.pi / 2) / 0.32  # slopes of y along x and z
        by_z = 0.05 * math.pi * math.cos(down * math.pi) / 0.67
        length = math.sqrt(by_x**2 + 1 + by_z**2)
        return by_x / length, -1 / length, by_z / length

    for row in range(rows):
        for column in range(columns):
            corners = [(row + 1, column), (row + 1, column + 1), (row, column + 1), (row, column)]
            mesh.face("flap", *(point(*c) for c in corners), normals=[normal(*c) for c in corners])


def plow():
    mesh = Mesh()
    mesh.box("frame", (-1.1, 0.0, 0.7), (1.1, 8.2, 1.0))
    mesh.box("frame", (-1.2, -0.08, 0.95), (1.2, 0.0, 1.2))  # bumper beam with the tail lamps
    mesh.box("hopper", (-1.2, 0.1, 1.25), (1.2, 4.6, 2.7))
    mesh.box("paint", (-1.25, 0.02, 1.25), (-1.1, 0.1, 2.75))
    mesh.box("paint", (1.1, 0.02, 1.25), (1.25, 0.1, 2.75))
    mesh.box("paint", (-1.25, 0.02, 2.6), (1.25, 0.1, 2.8))
    for stripe in range(4):  # slats of the tailgate
        z = 1.45 + 0.28 * stripe
        mesh.box("paint", (-1.0, 0.06, z), (1.0, 0.1, z + 0.1))
    mesh.box("paint", (-1.2, 5.0, 0.9), (1.2, 7.2, 3.0))
    mesh.box("glass", (-1.0, 4.98, 2.0), (1.0, 5.0, 2.8))
    mesh.box("paint", (-1.1, 7.2, 0.8), (1.1, 8.4, 1.9))
    mesh.box("blade", (-1.8, 8.9, 0.1), (1.8, 9.05, 1.2))
    for x in (-0.95, 0.95):
        for y in (0.75, 1.95, 7.4):
            mesh.disc("rubber", "x", (x, y, 0.5), 0.5, 0.22)
        flap(mesh, x)
    for x, y, z in LAMPS["amber"]:
        mesh.box("frame", (x - 0.2, y + 0.02, z - 0.3), (x + 0.2, y + 0.3, z + 0.18))
        mesh.disc("amber_lamp", "y", (x, y, z), 0.14, 0.04)
    for x, y, z in LAMPS["red"]:
        mesh.disc("red_lamp", "y", (x, y, z), 0.10, 0.03)
    mesh.write(HERE / "plow.obj")


def materials():
    lines = ["# written by make_plow.py"]
    for name, (albedo, emission, roughness, metallic) in MATERIALS.items():
        lines += [f"newmtl {name}", "Kd {:g} {:g} {:g}".format(*albedo)]
        if emission:
            lines.append("Ke {:g} {:g} {:g}".format(*emission))
        if roughness:
            lines += ["Pr {:g}".format(roughness), "Pm {:g}".format(metallic)]
    (HERE / "plow.mtl").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    plow()
    materials()
