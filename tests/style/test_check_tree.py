#!/usr/bin/env python3
"""The rules of check_tree.py hold for this tree, and each of them fails where it is broken on purpose."""

import pathlib
import shutil
import sys
import tempfile
import unittest

import check_tree

TOP = pathlib.Path(__file__).resolve().parents[2]


class ThisTree(unittest.TestCase):
    def test_is_clean(self):
        self.assertEqual(check_tree.violations(TOP), [])

    def test_is_seen_at_all(self):
        self.assertGreater(len(list(check_tree.sources(TOP))), 50)


class PlantedViolation(unittest.TestCase):
    """Each test plants one violation in a copy of the tree."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.top = pathlib.Path(self.folder.name)
        for folder in (*check_tree.SOURCE_FOLDERS, "docs"):
            shutil.copytree(TOP / folder, self.top / folder)

    def plant(self, name, line):
        path = self.top / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text((path.read_text() if path.exists() else "") + line + "\n")

    def found(self, *parts):
        before = set(check_tree.violations(TOP))
        new = [line for line in check_tree.violations(self.top) if line not in before]
        self.assertEqual(len(new), 1, new)
        for part in parts:
            self.assertIn(part, new[0])

    def test_upward_include(self):
        self.plant("src/core/vec2.h", '#include "src/model/scene.h"')
        self.found("src/core/vec2.h", "src/model/scene.h")

    def test_engine_that_includes_another(self):
        self.plant("src/engines/dem/dem.h", "")
        self.plant("src/engines/contact/planted.cpp", '#include "src/engines/dem/dem.h"')
        self.found("src/engines/contact/planted.cpp", "src/engines/dem")

    def test_engine_known_outside_the_program(self):
        self.plant("src/engines/dem/dem.h", "")
        self.plant("render/planted.cpp", '#include "src/engines/dem/dem.h"')
        self.found("render/planted.cpp")

    def test_include_that_is_not_from_the_top(self):
        self.plant("src/model/planted.cpp", '#include "scene.h"')
        self.found("src/model/planted.cpp", "scene.h")

    def test_third_party_header_out_of_place(self):
        self.plant("src/model/planted.cpp", "#include <toml++/toml.h>")
        self.found("src/model/planted.cpp", "toml++")

    def test_unknown_third_party_header(self):
        self.plant("src/model/planted.cpp", "#include <somewhere/else.hpp>")
        self.found("src/model/planted.cpp", "somewhere/else.hpp")

    def test_third_party_type_shown_to_another_layer(self):
        self.plant("src/record/planted.h", "#include <hdf5.h>")
        self.plant("src/record/planted_again.h", '#include "src/record/planted.h"')
        self.plant("render/planted.cpp", '#include "src/record/planted_again.h"')
        self.found("render/planted.cpp", "planted_again.h")

    def test_cgal_in_another_file(self):
        self.plant("shapes/planted.cpp", "#include <CGAL/number_utils.h>")
        self.found("CGAL", "shapes/planted.cpp")

    def test_unknown_citation(self):
        self.plant("src/core/planted.cpp", "// as in [Nobody99, eq. 1]")
        self.found("src/core/planted.cpp", "[Nobody99]")

    def test_two_types_of_one_name(self):
        self.plant("src/run/planted.h", "class StepReport final {")
        self.found("StepReport", "src/run/planted.h")

    def test_long_file(self):
        self.plant("src/core/planted.cpp", "\n" * check_tree.LONGEST_FILE)
        self.found("src/core/planted.cpp", "lines")

    def test_unfinished_mark(self):
        self.plant("src/core/planted.cpp", "// " + "TO" + "DO later")
        self.found("src/core/planted.cpp", "unfinished")


if __name__ == "__main__":
    sys.dont_write_bytecode = True
    unittest.main()
