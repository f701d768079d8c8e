"""scanloom.slam()"""

import signal
import threading
import time
import unittest
import warnings
from pathlib import Path

import numpy as np
import scanloom
from support import DRIVE, program, python


class Poses(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.given = scanloom.slam(DRIVE)
        cls.poses = list(cls.given)
        cls.program = program("slam", DRIVE, "--out-dir", "slam", "-w", "--set", "output.maps=false")

    def test_are_the_bits_that_the_program_writes(self):
        scanloom.write_trajectory("trajectory.tum", self.poses)
        self.assertEqual(Path("trajectory.tum").read_bytes(), Path("slam/trajectory.tum").read_bytes())

    def test_have_the_health_and_the_covariance_that_the_program_writes(self):
        rows = [line.split(",") for line in Path("slam/trajectory.csv").read_text().splitlines()]
        header, rows = rows[0], [dict(zip(rows[0], row)) for row in rows[1:]]
        self.assertEqual(len(rows), len(self.poses))
        for row, pose in zip(rows, self.poses):
            self.assertEqual((int(row["stamp_ns"]), row["health"]), (pose.stamp, pose.health))
            self.assertEqual(row["trusted"] == "1", pose.trusted)
            sigma = np.sqrt(pose.covariance_since_start.diagonal())
            written = [float(row[f"sigma_{axis}"]) for axis in ("x", "y", "z", "rx", "ry", "rz")]
            np.testing.assert_allclose(sigma, written, rtol=1e-3)  # four digits are written

    def test_are_rigid(self):
        for pose in self.poses:
            R = pose.map_T_body[:3, :3]
            np.testing.assert_allclose(R @ R.T, np.eye(3), atol=1e-12)
            np.testing.assert_array_equal(pose.map_T_body[:3, 3], pose.position)
            self.assertAlmostEqual(np.linalg.norm(pose.quaternion), 1)

    def test_have_covariances_that_are_positive(self):
        for pose in self.poses[1:]:
            self.assertEqual(pose.covariance.shape, (6, 6))
            self.assertGreater(np.linalg.eigvalsh(pose.covariance).min(), 0)

    def test_end_with_the_program_s_outcome(self):
        self.assertEqual(self.program.stdout.split(":")[0], self.given.outcome)
        self.assertIs(self.given.good, self.program.returncode == 0)
        self.assertEqual(self.given.counts["poses"], len(self.poses))

    def test_hold_no_cloud_unless_asked(self):
        self.assertIsNone(self.poses[0].cloud)
        pose = next(scanloom.slam(DRIVE, clouds=True))
        self.assertEqual(pose.cloud.xyz.shape, (len(pose.cloud), 3))
        self.assertGreater(len(pose.cloud), 1000)

    def test_of_every_fifth_scan_without_an_imu_are_the_program_s(self):
        poses = list(scanloom.slam(DRIVE, every_nth=5, settings={"slam.imu": "none"}))
        program("slam", DRIVE, "--out-dir", "fifth", "-w", "--every-nth", 5, "--set", "slam.imu=none",
                "--set", "output.maps=false")
        scanloom.write_trajectory("fifth.tum", poses)
        self.assertEqual(Path("fifth.tum").read_bytes(), Path("fifth/trajectory.tum").read_bytes())

    def test_may_be_computed_twice_at_once(self):
        for one, other in zip(scanloom.slam(DRIVE), scanloom.slam(DRIVE)):
            np.testing.assert_array_equal(one.map_T_body, other.map_T_body)

    def test_may_be_left_in_the_middle(self):
        run = scanloom.slam(DRIVE)
        next(run)
        del run


class Python(unittest.TestCase):
    def test_runs_other_threads_meanwhile(self):
        counted = []
        going = True

        def count():
            while going:
                counted.append(1)
                time.sleep(0.001)

        thread = threading.Thread(target=count)
        thread.start()
        for _ in scanloom.slam(DRIVE, every_nth=3):
            pass
        going = False
        thread.join()
        self.assertGreater(len(counted), 10)

    def interrupt(self, loop):
        ended = python(
            "import os, signal, threading, time, scanloom\n"
            "threading.Timer(1.0, lambda: os.kill(os.getpid(), signal.SIGINT)).start()\n"
            "try:\n"
            f"    {loop}\n"
            "except KeyboardInterrupt:\n"
            "    print('interrupted')\n")
        self.assertEqual((ended.stdout, ended.returncode), ("interrupted\n", 0), ended.stderr)

    def test_ends_slam_by_ctrl_c(self):
        self.interrupt(f"[list(scanloom.slam({str(DRIVE)!r})) for _ in range(100)]")

    def test_ends_scans_by_ctrl_c(self):
        self.interrupt(f"[list(scanloom.scans({str(DRIVE)!r})) for _ in range(100)]")


class ResultsThatMayBeWrong(unittest.TestCase):
    """A drive whose lidars are exchanged: the program ends with 3."""

    @classmethod
    def setUpClass(cls):
        for file in ("recording.pcap", "imu.csv", "left.json", "right.json"):
            Path(file).write_bytes((DRIVE / file).read_bytes())
        poses = (DRIVE / "extrinsics.txt").read_text().replace("T_body_left ", "T_body_other ")
        poses = poses.replace("T_body_right ", "T_body_left ").replace("T_body_other ", "T_body_right ")
        Path("extrinsics.txt").write_text(poses)

    def test_are_warnings_as_the_program_s_status(self):
        ended = program("slam", "recording.pcap", "--out-dir", "wrong", "-w", "--set", "output.maps=false")
        self.assertEqual(ended.returncode, 3, ended.stderr)
        run = scanloom.slam("recording.pcap")
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            list(run)
        self.assertIs(run.good, False)
        self.assertEqual(run.outcome, ended.stdout.split(":")[0])
        texts = [str(warning.message) for warning in caught]
        self.assertIn(f"the result is not good: {run.outcome}", texts)
        for line in ended.stderr.splitlines():
            if line.startswith("warning: ") and "trajectory.csv" not in line:
                self.assertIn(line[len("warning: "):], texts)

    def test_are_exceptions_if_wanted(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error", scanloom.ScanloomWarning)
            with self.assertRaises(scanloom.ScanloomWarning):
                list(scanloom.slam("recording.pcap"))


if __name__ == "__main__":
    unittest.main()
