#!/usr/bin/env python3
"""What the check of instruction counts lets pass and what it does not, without counting anything."""

import contextlib
import io
import json
import pathlib
import stat
import sys
import tempfile
import unittest
from unittest import mock

import instruction_counts as counts


class Report(unittest.TestCase):
    RECORDED = {"contact": 1000, "dem": 2000}

    def passes(self, **found):
        return counts.report(self.RECORDED, found)[1]

    def test_three_per_cent_pass_either_way(self):
        self.assertTrue(self.passes(contact=1030, dem=1940))

    def test_more_does_not(self):
        self.assertFalse(self.passes(contact=1031, dem=2000))
        self.assertFalse(self.passes(contact=1000, dem=1939))

    def test_every_engine_counts(self):
        self.assertFalse(self.passes(contact=1000))
        self.assertFalse(self.passes(contact=1000, dem=2000, box2d=1))

    def test_tells_the_difference(self):
        self.assertIn("contact: recorded 1000, counted 1100, +10.00%: more than 3 % off",
                      counts.report(self.RECORDED, {"contact": 1100, "dem": 2000})[0])


class OtherBuild(unittest.TestCase):
    """A program that only tells its version stands for a build."""

    def check(self, flags):
        with tempfile.TemporaryDirectory() as folder:
            program = pathlib.Path(folder, "program")
            program.write_text(f"#!/bin/sh\necho polargrain 0\necho '  compiler   GNU 12'\necho '  flags      {flags}'\n")
            program.chmod(stat.S_IRWXU)
            record = pathlib.Path(folder, "record.json")
            record.write_text(json.dumps({"build": {"compiler": "GNU 12", "flags": "-O2"},
                                          "instructions": {"contact": 1000}}))
            said = io.StringIO()
            with mock.patch.object(counts, "RECORD", record), \
                    mock.patch.object(counts, "count_all", lambda _: {"contact": 1000}), \
                    mock.patch.object(counts.shutil, "which", lambda _: "valgrind"), \
                    mock.patch.object(sys, "argv", ["", str(program), "--check"]), \
                    contextlib.redirect_stdout(said):
                return counts.main(), said.getvalue()

    def test_is_skipped_and_says_why(self):
        code, said = self.check("-O0 -g")
        self.assertEqual(code, counts.SKIPPED)
        self.assertIn("this build is {'compiler': 'GNU 12', 'flags': '-O0 -g'}", said)

    def test_and_the_recorded_one_is_not(self):
        self.assertEqual(self.check("-O2")[0], 0)


if __name__ == "__main__":
    unittest.main()
