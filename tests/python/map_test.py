"""scanloom.slam(map=...)"""

import unittest
import warnings
from pathlib import Path

import numpy as np
import scanloom
from support import DRIVE, SOURCE, program


def simulate(name, seed):
    ended = program("simulate", "-c", SOURCE / "params/simulation/demo.ini", "--seed", seed, "--out-dir", name, "-w",
                    *(f"--set=simulated_{setting}" for setting in
                      ("stand.seed=7", "drive.speed_up=1", "drive.speed=1.5", "drive.duration=12")))
    assert ended.returncode == 0, ended.stderr


def slam_of_the_program(drive, folder, *arguments):
    return program("slam", drive, "--out-dir", folder, "-w", "--every-nth", 2, *arguments)


def run_of_the_module(drive, **arguments):
    """The run, its poses and what was warned of."""
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        run = scanloom.slam(drive, every_nth=2, **arguments)
        return run, list(run), [str(warning.message) for warning in said]


class ADriveInAMap(unittest.TestCase):
    """Two drives through one stand."""

    @classmethod
    def setUpClass(cls):
        for seed, name in enumerate(("first", "second"), 1):
            simulate(name, seed)
        ended = slam_of_the_program("first", "map")
        assert ended.returncode == 0, ended.stderr

    def assert_bits_of_the_program(self, poses, folder):
        scanloom.write_trajectory(f"{folder}.tum", poses)
        self.assertEqual(Path(f"{folder}.tum").read_bytes(), Path(folder, "trajectory.tum").read_bytes())
        rows = [line.split(",") for line in Path(folder, "trajectory.csv").read_text().splitlines()]
        column = rows[0].index("in_map")
        self.assertEqual([row[column] == "1" for row in rows[1:]], [pose.in_map for pose in poses])

    def test_is_found_there_with_the_bits_of_the_program(self):
        ended = slam_of_the_program("second", "anywhere", "--map", "map")
        run, poses, said = run_of_the_module("second", map=Path("map"))
        self.assertEqual((ended.returncode, run.outcome, run.good, said), (0, "OK", True, []))
        self.assertFalse(poses[0].in_map)
        self.assertTrue(poses[-1].in_map)
        self.assert_bits_of_the_program(poses, "anywhere")

    def test_starts_where_it_is_told(self):
        ended = slam_of_the_program("second", "told", "--map", "map", "--at", "0 0 0 0 0 0")
        self.assertEqual(ended.returncode, 0, ended.stderr)
        Path("start.tum").write_text("1 0 0 0 0 0 0 1\n")
        for at in (Path("start.tum"), np.eye(4)):
            _, poses, _ = run_of_the_module("second", map="map", at=at)
            self.assertLess([pose.in_map for pose in poses].index(True), 15)
            self.assert_bits_of_the_program(poses, "told")

    def test_through_another_stand_has_the_outcome_and_the_warnings_of_the_program(self):
        ended = slam_of_the_program(DRIVE, "elsewhere", "--map", "map")
        run, poses, said = run_of_the_module(DRIVE, map="map")
        self.assertEqual(ended.returncode, 3, ended.stderr)
        self.assertEqual((run.outcome, run.good), ("NOT IN MAP", False))
        self.assertIn("NOT IN MAP", ended.stdout)
        for line in ended.stderr.splitlines():
            if line.startswith("warning: ") and "trajectory.csv" not in line:
                self.assertIn(line[len("warning: "):], said)
        self.assertFalse(any(pose.in_map for pose in poses))
        self.assert_bits_of_the_program(poses, "elsewhere")

    def test_is_refused_in_the_program_s_words_without_a_map(self):
        with self.assertRaisesRegex(scanloom.UsageError, "result folder of `scanloom slam`"):
            scanloom.slam("second", map="second")
        with self.assertRaisesRegex(scanloom.UsageError, "name its folder with map"):
            scanloom.slam("second", at=np.eye(4))
        with self.assertRaisesRegex(scanloom.UsageError, "x y z yaw pitch roll"):
            scanloom.slam("second", map="map", at="there")


if __name__ == "__main__":
    unittest.main()
