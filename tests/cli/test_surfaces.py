"""The files of loci over three free coordinates, read by nothing but what their formats say."""

import json
import math
import re
import struct
import unittest
import xml.etree.ElementTree as ElementTree

from program import SOURCE, InOwnFolder


def read_stl(data):
    """Triangles as ((normal), (a), (b), (c))."""
    (count,) = struct.unpack_from("<I", data, 80)
    assert len(data) == 84 + 50 * count, (len(data), count)
    assert not data.startswith(b"solid")
    triangles = []
    for i in range(count):
        numbers = struct.unpack_from("<12f", data, 84 + 50 * i)
        triangles.append(tuple(numbers[k : k + 3] for k in range(0, 12, 3)))
    return triangles


def read_obj(text):
    """Vertices, and the faces of every group, counted from 0."""
    vertices, groups, current = [], {}, None
    for line in text.splitlines():
        words = line.split()
        if not words or words[0] == "#":
            continue
        if words[0] == "v":
            vertices.append(tuple(map(float, words[1:])))
        elif words[0] == "g":
            current = groups.setdefault(words[1], [])
        elif words[0] == "f":
            current.append(tuple(int(word) - 1 for word in words[1:]))
        else:
            assert words[0] in ("mtllib", "usemtl"), line
    return vertices, groups


def minus(a, b):
    return [p - q for p, q in zip(a, b)]


def cross(u, v):
    return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]


def area(a, b, c):
    return math.hypot(*cross(minus(b, a), minus(c, a))) / 2


class Surfaces(InOwnFolder):
    def trace(self, example, *words):
        self.run_program("loci", SOURCE / "examples" / f"{example}.yaml", "--quiet", "-o", self.folder / "out", *words)
        return json.loads((self.folder / "out" / "loci.json").read_text(encoding="utf-8"))

    def test_files_agree(self):
        result = self.trace("three_upu", "--export", "stl,obj,vtk,png,svg,csv")
        self.assertEqual(len(result["surfaces"]), 3)
        vertices, groups = read_obj((self.folder / "out" / "loci.obj").read_text(encoding="utf-8"))
        materials = (self.folder / "out" / "loci.mtl").read_text(encoding="utf-8")
        self.assertEqual(len(re.findall("^newmtl ", materials, re.MULTILINE)), 3)
        for surface in result["surfaces"]:
            name = surface["mesh"]["group"]
            self.assertEqual(surface["mesh"]["file"], "loci.obj")
            faces = groups[name]
            self.assertEqual(len(faces), surface["triangles"])
            total = sum(area(*(vertices[i] for i in face)) for face in faces)
            self.assertAlmostEqual(total, surface["area"], 9)
            self.assertTrue(surface["certified"])
            triangles = read_stl((self.folder / "out" / f"loci-{name}.stl").read_bytes())
            self.assertEqual(len(triangles), len(faces))
            for (normal, a, b, c), face in zip(triangles, faces):
                for corner, i in zip((a, b, c), face):
                    self.assertLess(math.dist(corner, vertices[i]), 1e-6)
                self.assertAlmostEqual(math.hypot(*normal), 1, 5)
                outward = cross(minus(b, a), minus(c, a))
                if math.hypot(*outward) > 1e-6:
                    self.assertGreater(sum(p * q for p, q in zip(normal, outward)), 0)
            # All of them are planes: the polynomial is linear, and vertices satisfy it.
            polynomial = surface["implicit"]["polynomial"].replace("^", "**")
            for face in faces[::50]:
                x, y, z = vertices[face[0]]
                self.assertAlmostEqual(eval(polynomial, {}, {"x": x, "y": y, "z": z}), 0, 9)

    def test_zones_of_all_modes(self):
        out = self.folder / "modes"
        self.run_program("zones", SOURCE / "examples" / "slider_crank.yaml", "--quiet", "--working-mode", "all", "-o", out)
        result = json.loads((out / "zones.json").read_text(encoding="utf-8"))
        modes = [own["working_mode"] for own in result["areas"]]
        self.assertEqual(modes, [{"C": "ahead"}, {"C": "behind"}])
        self.assertEqual([zone["id"] for zone in result["zones"]], [f"z{k + 1}" for k in range(len(result["zones"]))])
        for area in result["areas"]:
            sizes = [zone["at_least"] for zone in result["zones"] if zone["working_mode"] == area["working_mode"]]
            self.assertAlmostEqual(sum(sizes) + area["outside"] + area["in_doubt"], 2 * math.pi)
            side = area["working_mode"]["C"]
            self.assertTrue((out / f"zones-{side}.svg").exists())

    def test_zones_of_three_coordinates(self):
        out = self.folder / "out"
        self.run_program("zones", SOURCE / "examples" / "three_upu.yaml", "--quiet", "--cells", "8000", "-o", out,
                         "--export", "svg,png,vtk,stl")
        result = json.loads((out / "zones.json").read_text(encoding="utf-8"))
        self.assertTrue((out / "zones.png").read_bytes().startswith(b"\x89PNG"))
        self.assertIn("z1 |A|+", (out / "zones.svg").read_text(encoding="utf-8"))
        for zone in result["zones"]:
            # By Gauss: what the surface of a zone holds is what is proven of it.
            for kind in ("stl", "vtp"):
                self.assertTrue((out / f"zones-{zone['id']}.{kind}").exists())
            triangles = read_stl((out / f"zones-{zone['id']}.stl").read_bytes())
            volume = sum(math.sumprod(a, cross(b, c)) if hasattr(math, "sumprod")
                         else sum(p * q for p, q in zip(a, cross(b, c))) for _, a, b, c in triangles) / 6
            self.assertAlmostEqual(volume, zone["at_least"], 5)
        data = (out / "zones.vti").read_bytes()
        self.assertIn(b'WholeExtent="0 63 0 63 0 63"', data)
        start = data.index(b"\n_") + 2
        (size,) = struct.unpack_from("<Q", data, start)
        labels = struct.unpack_from(f"<{size // 8}d", data, start + 8)
        cell = (0.8 / 64) ** 2 * 0.6 / 64
        for number, zone in enumerate(result["zones"], 1):
            self.assertAlmostEqual(labels.count(number) * cell, zone["at_least"], delta=0.01)
        self.assertEqual(len(labels), 64**3)

    def test_errors_of_three_coordinates(self):
        out = self.folder / "out"
        self.run_program("error", SOURCE / "examples" / "three_upu.yaml", "--quiet", "--grid", "4x5x6", "-o", out,
                         "--export", "vtk,csv,svg", "--slice", "z=0.45", "--no-worst-case")
        data = (out / "error.vti").read_bytes()
        self.assertIn(b'WholeExtent="0 3 0 4 0 5"', data)
        rows = (out / "error.csv").read_text(encoding="utf-8").splitlines()
        self.assertEqual(rows[0], "x,y,z,dx,dy,dz,dalpha_x,dalpha_y,dalpha_z,dp")
        self.assertEqual(len(rows), 1 + 4 * 5 * 6)
        start = data.index(b"\n_") + 2
        first = struct.unpack_from("<120d", data, start + 8)
        for row, value in zip(rows[1:], first):
            self.assertEqual(float(row.split(",")[3]), value)
        self.assertIn("z = 0.45 m", (out / "error-dx-z1.svg").read_text(encoding="utf-8"))

    def test_vtk(self):
        result = self.trace("three_upu", "--export", "vtk")
        piece = ElementTree.parse(self.folder / "out" / "loci.vtp").getroot().find("PolyData/Piece")
        count = sum(surface["triangles"] for surface in result["surfaces"])
        self.assertEqual(int(piece.get("NumberOfPolys")), count)
        points = [float(word) for word in piece.find("Points/DataArray").text.split()]
        self.assertEqual(len(points), 3 * int(piece.get("NumberOfPoints")))
        arrays = {array.get("Name"): array.text.split() for array in piece.findall("Polys/DataArray")}
        self.assertEqual([int(word) for word in arrays["offsets"]], list(range(3, 3 * count + 1, 3)))
        corners = [int(word) for word in arrays["connectivity"]]
        self.assertEqual((min(corners), max(corners) + 1), (0, len(points) // 3))
        cells = {array.get("Name"): array.text.split() for array in piece.findall("CellData/DataArray")}
        for values in cells.values():
            self.assertEqual(len(values), count)
        self.assertEqual(set(cells["curve"]), {"0", "1", "2"})

    def test_the_same_bytes_each_time(self):
        seen = []
        for _ in range(2):
            self.trace("three_rpr_orientation", "--mesh-size", "1/16", "--export", "stl,obj,vtk,png,svg,pdf,csv")
            files = {path.name: path.read_bytes() for path in sorted((self.folder / "out").iterdir())}
            files["loci.json"] = re.sub(rb'"timing".*', b"", files["loci.json"], flags=re.DOTALL)
            seen.append(files)
        self.assertEqual(seen[0].keys(), seen[1].keys())
        for name, data in seen[0].items():
            self.assertEqual(data, seen[1][name], name)

    def test_angles_are_in_rad(self):
        result = self.trace("three_rpr_orientation", "--mesh-size", "1/8", "--export", "obj")
        self.assertEqual(result["units"], ["m", "m", "rad"])
        vertices, _ = read_obj((self.folder / "out" / "loci.obj").read_text(encoding="utf-8"))
        self.assertAlmostEqual(max(at[2] for at in vertices), math.radians(120), 9)
        self.assertAlmostEqual(min(at[2] for at in vertices), math.radians(-60), 9)

    def test_a_time_limit(self):
        words = ("loci", SOURCE / "examples" / "three_rrr_orientation.yaml", "--quiet", "--time-limit", "0.9")
        self.run_program(*words, "-o", self.folder / "late", status=3)
        result = json.loads((self.folder / "late" / "loci.json").read_text(encoding="utf-8"))
        self.assertFalse(result["complete"])


if __name__ == "__main__":
    unittest.main()
