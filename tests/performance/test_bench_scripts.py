#!/usr/bin/env python3
"""What scripts/bench-table and scripts/plot-scaling make of numbers, without measuring any."""

import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "bench"))
import scaling
import table

POUR = {"real_time": 3.0, "simulated": 1.5, "fall": 0.1, "collapse": 0.2, "rest": 0.3, "whole": 0.25, "step": 1e-3,
        "rejected": 0.0, "overlap": 1.23e-3, "deepest": 0.1, "bytes": 2048.0}


class Table(unittest.TestCase):
    def row(self, found):
        return {"scene": "rough", "engine": "contact", "threads": 1, "grains": 500, **table.measured(found)}

    def test_wall_clock_is_per_simulated_second(self):
        self.assertEqual(self.row(POUR)["wall"], 2.0)

    def test_has_a_cell_for_every_column(self):
        header, *body = table.pour_rows([self.row(POUR), self.row({"error_occurred": True, "error_message": "no"})])
        self.assertEqual([len(row) for row in body], [len(header)] * 2)
        self.assertEqual(body[0][4:], ["1", "0.1", "0.2", "0.3", "0.25", "2", "0", "0.12", "10", "2"])
        self.assertEqual(body[1][4], "no")

    def test_stages_have_a_column_per_state(self):
        found = [{"name": f"stage/energy_sum/grains:500/warm_up:{state}", "s_per_grain": 1e-9 * k,
                  "contacts_per_grain": 0.0} for k, state in enumerate(table.STAGE_STATES, 1)]
        header, row = table.stage_rows(found, 1000.0)
        self.assertEqual(row, ["energy sum", "1", "2", "3", "", "", "", ""])
        self.assertEqual(len(row), len(header))

    def test_stages_are_held_to_their_floor_at_rest(self):
        found = [{"name": f"stage/detection/grains:500/warm_up:{state}", "s_per_grain": 1e-7,
                  "contacts_per_grain": contacts} for state, contacts in zip(table.STAGE_STATES, (0.0, 9.0, 2.0))]
        # 2 x 30 + 70 operations, 8 in a cycle of 1 ns, take longer than 2 x 100 + 240 bytes at 32.
        self.assertEqual(list(table.stage_rows(found, 1000.0))[1][4:], ["16.2", "6.15", "130", "440"])

    def test_kernels_are_in_nanoseconds_and_fits_left_out(self):
        found = [{"name": "impact", "run_type": "iteration", "cpu_time": 2.5, "time_unit": "us"},
                 {"name": "impact_BigO", "run_type": "aggregate"}]
        self.assertEqual(list(table.kernel_rows(found))[1:], [["impact", "2.5e+03"]])

    def test_slow_engines_are_left_out_of_large_pours_unless_asked_for(self):
        self.assertNotIn(("rough", "dem", 1, 8000), list(table.cases([8000], [], ["dem", "contact"], False)))
        self.assertIn(("rough", "contact", 2, 8000), list(table.cases([8000], [], ["dem", "contact"], False)))
        self.assertIn(("rough", "dem", 1, 8000), list(table.cases([8000], [], ["dem"], True)))


class Scaling(unittest.TestCase):
    def test_a_power_is_found_again(self):
        factor, exponent = scaling.fit_power([(n, 3e-4 * n ** 1.25) for n in (125, 500, 2000)])
        self.assertAlmostEqual(factor, 3e-4)
        self.assertAlmostEqual(exponent, 1.25)

    def test_one_size_has_no_power(self):
        self.assertIsNone(scaling.fit_power([(500, 1.0), (500, 2.0)]))

    def test_curves_are_of_rough_grains_by_engine_and_threads(self):
        rows = [{"scene": scene, "engine": "contact", "threads": threads, "grains": grains, "rest": cost}
                for scene, threads, grains, cost in (("rough", "1", "500", "2"), ("rough", "1", "125", "1"),
                                                     ("rough", "2", "500", "3"), ("rough", "1", "2000", ""),
                                                     ("disks", "1", "500", "4"))]
        self.assertEqual(scaling.curves(rows, "rest"),
                         {"contact": [(125.0, 1.0), (500.0, 2.0)], "contact, 2 threads": [(500.0, 3.0)]})


if __name__ == "__main__":
    unittest.main()
