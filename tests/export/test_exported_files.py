#!/usr/bin/env python3
"""Reads exported files with no code of the program's: an XML parser, and the rules of VTK's file format.

usage: test_exported_files.py PROGRAM
"""

import csv
import math
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else None
SERIES = ("grains", "contacts", "walls")
CELLS = ("Verts", "Lines", "Polys")

# A star, concave at four corners, and two disks, one of them on a shelf; a wall that shakes, and one that goes.
SCENARIO = """title = "Star and disk"
source = "made up for a test"

[run]
duration = 0.03
time_step = 1e-4

[materials.stone]
density = 2000.0
restitution = { mean = 0.5, stddev = 0.0 }
friction = 0.3

[shapes.ball]
type = "disk"
radius = 0.01

[shapes.star]
type = "star"
radius = 0.02
inner_radius = 0.008
points = 4

[[walls]]
name = "floor"
material = "stone"
points = [[-0.1, 0.0], [0.2, 0.0]]
motion = { type = "sine", direction = [0, 1], amplitude = 2e-3, frequency = 20.0 }

[[walls]]
name = "gate"
material = "stone"
points = [[0.2, 0.0], [0.2, 0.1], [0.1, 0.1]]
remove_at = 0.02

[[walls]]
name = "shelf"
material = "stone"
points = [[-0.1, 0.2], [-0.02, 0.2]]

[[grains]]
shape = "ball"
material = "stone"
position = [0.0, 0.0105]
velocity = [0.1, 0.0]

[[grains]]
shape = "star"
material = "stone"
position = [0.05, 0.03]
spin = 90.0

[[grains]]
shape = "ball"
material = "stone"
position = [-0.06, 0.2101]

[output]
frames = { every = 0.0 }
trajectory = { every = 0.005 }
series = { every = 0.01 }
"""


class PolyData:
    """A .vtp file; every rule of the format that it breaks is an AssertionError."""

    TYPES = {"Int32": "i", "Float64": "d"}

    def __init__(self, path):
        content = path.read_bytes()
        opening = b'<AppendedData encoding="raw">\n_'
        head, rest = content.split(opening, 1)
        self.bytes, tail = rest.rsplit(b"\n</AppendedData>", 1)
        self.end = 0
        root = ElementTree.fromstring(head + opening + b"</AppendedData>" + tail)
        assert root.tag == "VTKFile" and root.get("type") == "PolyData", root.attrib
        assert root.get("version") == "1.0" and root.get("header_type") == "UInt64", root.attrib
        self.order = {"LittleEndian": "<", "BigEndian": ">"}[root.get("byte_order")]
        time = root.find("./PolyData/FieldData/DataArray[@Name='TimeValue']")
        self.time = float(time.text)
        piece, = root.findall("./PolyData/Piece")
        count = {name: int(piece.get("NumberOf" + name)) for name in ("Points", "Strips", *CELLS)}
        assert count["Strips"] == 0
        self.point_data = {a.get("Name"): self.array(a, count["Points"]) for a in piece.find("PointData")}
        self.cell_data = {a.get("Name"): self.array(a, sum(count[c] for c in CELLS)) for a in piece.find("CellData")}
        points, = piece.find("Points")
        assert points.get("NumberOfComponents") == "3"
        self.points = self.array(points, count["Points"])
        self.cells = {name: self.cells_of(piece.find(name), count[name], count["Points"]) for name in CELLS}
        assert self.end == len(self.bytes), "bytes that belong to no array"

    def array(self, element, count):
        """Tuples of numbers, or plain numbers where there is one component."""
        assert element.get("format") == "appended" and int(element.get("offset")) == self.end, "one after the other"
        components = int(element.get("NumberOfComponents", "1"))
        size, = struct.unpack_from(self.order + "Q", self.bytes, self.end)
        letter = self.TYPES[element.get("type")]
        if count is not None:
            assert size == count * components * struct.calcsize(self.order + letter), element.attrib
        numbers = [n for n, in struct.iter_unpack(self.order + letter, self.bytes[self.end + 8:self.end + 8 + size])]
        self.end += 8 + size
        if components == 1:
            return numbers
        return [tuple(numbers[k:k + components]) for k in range(0, len(numbers), components)]

    def cells_of(self, element, count, points):
        named = {a.get("Name"): a for a in element}
        assert list(named) == ["connectivity", "offsets"]
        corners = self.array(named["connectivity"], None)
        ends = self.array(named["offsets"], count)
        assert all(0 <= corner < points for corner in corners)
        assert ends == sorted(ends) and (ends[-1] if ends else 0) == len(corners)
        return [corners[a:b] for a, b in zip([0, *ends], ends)]

    def area(self, cell):
        corners = [self.points[k] for k in cell]
        return 0.5 * sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(corners, corners[1:] + corners[:1]))


class Export(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.scratch.cleanup)
        cls.top = pathlib.Path(cls.scratch.name)
        (cls.top / "star.toml").write_text(SCENARIO)
        for words in (["run", "star.toml", "-o", "run"], ["export", "run", "-o", "all", "--format", "vtk,csv"],
                      ["export", "run", "-o", "coarse", "--sides", "8", "--every", "3"]):
            subprocess.run([PROGRAM, *words, "--quiet"], cwd=cls.top, check=True)
        with open(cls.top / "all" / "grains.csv", newline="") as table:
            cls.rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(table)]
        cls.frames = {name: cls.collection("all", name) for name in SERIES}

    @classmethod
    def collection(cls, folder, name):
        root = ElementTree.parse(cls.top / folder / (name + ".pvd")).getroot()
        assert root.tag == "VTKFile" and root.get("type") == "Collection", root.attrib
        entries = root.findall("./Collection/DataSet")
        frames = [PolyData(cls.top / folder / entry.get("file")) for entry in entries]
        assert [float(entry.get("timestep")) for entry in entries] == [frame.time for frame in frames]
        return frames

    def test_every_frame_is_there_with_its_time(self):
        times = sorted({row["time"] for row in self.rows})
        self.assertEqual(len(times), 7)
        for name in SERIES:
            self.assertEqual([frame.time for frame in self.frames[name]], times)
        self.assertEqual([frame.time for frame in self.collection("coarse", "walls")], times[::3])

    def test_grains_have_the_numbers_of_the_table(self):
        for frame in self.frames["grains"]:
            data = frame.cell_data
            rows = [row for row in self.rows if row["time"] == frame.time]
            self.assertEqual([row["grain"] for row in rows], [0, 1, 2])
            for c, k in enumerate(data["grain"]):
                row = rows[k]
                self.assertEqual(data["position"][c], (row["x"], row["y"], 0.0))
                self.assertEqual(data["velocity"][c], (row["vx"], row["vy"], 0.0))
                self.assertEqual((data["angle"][c], data["spin"][c]), (row["angle"], row["spin"]))
                self.assertAlmostEqual(data["speed"][c], math.hypot(row["vx"], row["vy"]), delta=1e-15)
                self.assertEqual(data["shape"][c], 1 if k == 1 else 0)
            self.assertAlmostEqual(data["mass"][0], 2000.0 * math.pi * 1e-4, delta=1e-12)

    def test_a_disk_is_a_regular_polygon_and_turns_with_it(self):
        for folder, sides in (("all", 32), ("coarse", 8)):
            for frame in self.collection(folder, "grains"):
                corners = [frame.points[k] for k in frame.cells["Polys"][0]]
                self.assertEqual(len(corners), sides)
                x, y, _ = frame.cell_data["position"][0]
                first = frame.cell_data["angle"][0]
                for k, corner in enumerate(corners):
                    angle = first + 2.0 * math.pi * k / sides
                    self.assertAlmostEqual(corner[0], x + 0.01 * math.cos(angle), delta=1e-15)
                    self.assertAlmostEqual(corner[1], y + 0.01 * math.sin(angle), delta=1e-15)
                    self.assertEqual(corner[2], 0.0)

    def test_a_star_is_filled_by_convex_cells_where_its_pose_puts_it(self):
        # Four points at 20 mm, four at 8 mm half way between: eight triangles.
        area = 8 * 0.5 * 0.02 * 0.008 * math.sin(math.pi / 4)
        for frame in self.frames["grains"]:
            cells = [c for c, k in enumerate(frame.cell_data["grain"]) if k == 1]
            self.assertGreater(len(cells), 1)
            self.assertEqual([frame.cell_data["piece"][c] for c in cells], list(range(len(cells))))
            self.assertAlmostEqual(sum(frame.area(frame.cells["Polys"][c]) for c in cells), area, delta=1e-12 * area)
            x, y, _ = frame.cell_data["position"][cells[0]]
            turned = frame.cell_data["angle"][cells[0]]
            used = {corner for c in cells for corner in frame.cells["Polys"][c]}
            self.assertEqual(len(used), 8)
            for px, py, _ in (frame.points[k] for k in used):
                eighths = (math.atan2(py - y, px - x) - turned) / (math.pi / 4)
                self.assertAlmostEqual(eighths, round(eighths), delta=1e-9)
                radius = 0.02 if round(eighths) % 2 == 0 else 0.008
                self.assertAlmostEqual(math.hypot(px - x, py - y), radius, delta=1e-15)

    def test_walls_move_and_go(self):
        for frame in self.frames["walls"]:
            self.assertEqual(frame.cell_data["wall"], [0, 1, 2] if frame.time < 0.02 else [0, 2])
            height = 2e-3 * math.sin(2.0 * math.pi * 20.0 * frame.time)
            floor = [frame.points[k] for k in frame.cells["Lines"][0]]
            for point, x in zip(floor, (-0.1, 0.2), strict=True):
                self.assertAlmostEqual(point[0], x, delta=1e-15)
                self.assertAlmostEqual(point[1], height, delta=1e-15)
            if frame.time < 0.02:
                gate = [frame.points[k] for k in frame.cells["Lines"][1]]
                self.assertEqual(gate, [(0.2, 0.0, 0.0), (0.2, 0.1, 0.0), (0.1, 0.1, 0.0)])

    def test_contacts_push_along_unit_normals(self):
        found = 0
        for frame in self.frames["contacts"]:
            data = frame.point_data
            self.assertEqual(frame.cells["Verts"], [[k] for k in range(len(frame.points))])
            for c, (nx, ny, nz) in enumerate(data["normal"]):
                found += 1
                self.assertLess(data["a"][c], data["b"][c])
                self.assertAlmostEqual(math.hypot(nx, ny, nz), 1.0, delta=1e-12)
                for force, impulse in zip(data["force"][c], data["impulse"][c]):
                    self.assertAlmostEqual(force, impulse / 1e-4, delta=1e-9 * abs(force))
        self.assertGreater(found, 0)

    def test_equal_exports_have_equal_bytes(self):
        subprocess.run([PROGRAM, "export", "run", "-o", "again", "--format", "csv,vtk"], cwd=self.top, check=True,
                       capture_output=True)
        files = sorted(path.relative_to(self.top / "all") for path in (self.top / "all").rglob("*.*"))
        self.assertEqual(len(files), 3 * 7 + 3 + 1)
        for file in files:
            self.assertEqual((self.top / "all" / file).read_bytes(), (self.top / "again" / file).read_bytes(), file)


if __name__ == "__main__":
    if PROGRAM is None:
        sys.exit(__doc__)
    unittest.main()
