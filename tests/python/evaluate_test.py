"""scanloom.evaluate()"""

import json
import unittest
import warnings
from pathlib import Path

import numpy as np
import scanloom
from support import DRIVE, program


class Evaluate(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.poses = list(scanloom.slam(DRIVE))
        scanloom.write_trajectory("slam.tum", cls.poses)
        cls.ended = program("evaluate", "--trajectory", "slam.tum", "--reference", DRIVE / "groundtruth.tum", "--json")

    def test_of_files_is_what_the_program_prints(self):
        evaluation = scanloom.evaluate("slam.tum", DRIVE / "groundtruth.tum")
        self.assertEqual(evaluation.as_dict(), json.loads(self.ended.stdout))
        text = program("evaluate", "--trajectory", "slam.tum", "--reference", DRIVE / "groundtruth.tum").stdout
        self.assertEqual(str(evaluation), text)

    def test_of_poses_is_that_of_the_file_but_for_its_rounding(self):
        evaluation = scanloom.evaluate(self.poses, DRIVE / "groundtruth.tum")
        self.assertAlmostEqual(evaluation.drift, scanloom.evaluate("slam.tum", DRIVE / "groundtruth.tum").drift, 6)
        self.assertLess(evaluation.drift_percent, 5)
        self.assertGreater(evaluation.covered, 0.8)

    def test_of_a_trajectory_with_itself_is_nothing(self):
        evaluation = scanloom.evaluate(self.poses, self.poses)
        self.assertAlmostEqual(evaluation.drift, 0)
        self.assertAlmostEqual(evaluation.ape, 0)

    def test_of_a_trajectory_that_is_a_known_distance_off(self):
        """The second half, shifted by 1 m to the side: aligned on the first 10 %, that is the drift."""
        lines, reference = [], []
        for second in range(101):
            reference.append(f"{second} {second} 0 0 0 0 0 1")
            lines.append(f"{second} {second} {1 if second >= 50 else 0} 0 0 0 0 1")
        Path("reference.tum").write_text("\n".join(reference) + "\n")
        Path("shifted.tum").write_text("\n".join(lines) + "\n")
        evaluation = scanloom.evaluate("shifted.tum", "reference.tum")
        self.assertAlmostEqual(evaluation.drift, 1)
        self.assertAlmostEqual(evaluation.path_length, 100)
        self.assertAlmostEqual(evaluation.drift_percent, 1)

    def test_warns_where_a_prism_is_compared_without_its_place(self):
        with self.assertWarnsRegex(scanloom.ScanloomWarning, "lever-arm"):
            scanloom.evaluate(self.poses, DRIVE / "total_station.csv")

    def test_of_other_times_is_refused(self):
        Path("late.tum").write_text("1 0 0 0 0 0 0 1\n2 1 0 0 0 0 0 1\n")
        with self.assertRaises(ValueError):
            scanloom.evaluate(self.poses, "late.tum")


if __name__ == "__main__":
    unittest.main()
