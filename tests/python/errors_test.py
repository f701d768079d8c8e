"""Bad input is told in the words of the program."""

import unittest
from pathlib import Path

import numpy as np
import scanloom
from support import DRIVE, program


def words_of(ended):
    """Of the last message, without the program's name."""
    return ended.stderr.strip().removeprefix("scanloom slam: ")


class Errors(unittest.TestCase):
    def refused(self, arguments, call):
        ended = program("slam", *arguments, "--out-dir", "refused")
        self.assertEqual(ended.returncode, 2, ended.stderr)
        with self.assertRaises(scanloom.UsageError) as caught:
            call()
        self.assertTrue(words_of(ended).endswith(str(caught.exception)), f"{ended.stderr}\n{caught.exception}")
        return str(caught.exception)

    def test_of_a_file_that_is_missing(self):
        self.refused(["missing.pcap"], lambda: scanloom.slam("missing.pcap"))

    def test_of_a_file_that_is_no_recording(self):
        Path("text.txt").write_text("no recording\n")
        self.refused(["text.txt"], lambda: scanloom.slam(Path("text.txt")))

    def test_of_an_unknown_setting(self):
        text = self.refused([DRIVE, "--set", "slam.every_nht=5"],
                            lambda: scanloom.slam(DRIVE, settings={"slam.every_nht": 5}))
        self.assertIn("did you mean 'every_nth'?", text)

    def test_of_a_value_out_of_bounds(self):
        self.refused([DRIVE, "--set", "slam.every_nth=0"], lambda: scanloom.slam(DRIVE, every_nth=0))

    def test_of_an_unknown_lidar(self):
        self.refused([DRIVE, "--lidars", "middle"], lambda: scanloom.slam(DRIVE, lidars="middle"))

    def test_of_an_imu_that_is_not_there(self):
        self.refused([DRIVE, "--set", "slam.imu=middle"], lambda: scanloom.slam(DRIVE, settings={"slam.imu": "middle"}))

    def test_of_several_mistakes_at_once(self):
        Path("wrong.ini").write_text("[slam]\nevery_nth = 0\nimo = none\n")
        text = self.refused([DRIVE, "-c", "wrong.ini"], lambda: scanloom.slam([DRIVE, "wrong.ini"]))
        self.assertEqual(len(text.splitlines()), 2, text)

    def test_of_scans_are_the_same(self):
        with self.assertRaises(scanloom.UsageError) as caught:
            scanloom.scans("missing.pcap")
        self.assertIn("missing.pcap", str(caught.exception))

    def test_are_value_errors(self):
        self.assertTrue(issubclass(scanloom.UsageError, ValueError))

    def test_of_arrays_say_what_is_expected(self):
        for call, words in (
                (lambda: scanloom.register(np.zeros((5, 2)), np.zeros((5, 3))),
                 "target has the shape (5, 2): must be an array of shape (N, 3)"),
                (lambda: scanloom.register(np.zeros((5, 3)), "abc" * 3 + ".ply"), "abcabcabc.ply"),
                (lambda: scanloom.register(np.zeros((5, 3)), np.zeros((5, 3)), np.ones((4, 4))), "guess: "),
                (lambda: scanloom.register(np.zeros((5, 3)), np.zeros((5, 3)), guess_sigma=(0, 1)),
                 "guess_sigma (0, 1): must be (m, deg), both above 0"),
                (lambda: scanloom.evaluate([], [], align="first"), "align 'first': must be 'yaw' or 'se3'"),
                (lambda: scanloom.Odometry(body_T_imu=np.eye(3)),
                 "body_T_imu has the shape (3, 3): must be an array of shape (4, 4)")):
            with self.assertRaises((scanloom.UsageError, RuntimeError)) as caught:
                call()
            self.assertIn(words, str(caught.exception))


if __name__ == "__main__":
    unittest.main()
