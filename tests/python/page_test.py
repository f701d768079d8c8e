"""The examples of doc/python.md run, each in an interpreter of its own, without an error or a warning."""

import importlib.util
import re
import unittest
from pathlib import Path

from support import DRIVE, EXAMPLES, PAGE, program, python


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if not Path("drive").exists():
            Path("drive").symlink_to(DRIVE)
        ended = program("slam", "drive", "--out-dir", "map", "-w")
        assert ended.returncode == 0, ended.stderr

    def test_has_ten_examples(self):
        self.assertEqual(re.findall(r"^\*\*(\d+)\. ", PAGE, re.MULTILINE), [str(i) for i in range(1, 11)])

    def test_names_every_attribute_of_its_table(self):
        import scanloom

        for name in re.findall(r"`scan\.(\w+)`", PAGE):
            self.assertTrue(hasattr(scanloom.Scan, name), name)
        for name in re.findall(r"`pose\.(\w+)`", PAGE):
            self.assertTrue(hasattr(scanloom.Pose, name), name)
        for name in re.findall(r"`result\.(\w+)`", PAGE):
            self.assertTrue(hasattr(scanloom.Registration, name), name)


def runs(example):
    def test(self):
        if "matplotlib" in example and importlib.util.find_spec("matplotlib") is None:
            self.skipTest("python3-matplotlib is missing")
        ended = python(example)
        print(ended.stdout, end="")
        self.assertEqual((ended.returncode, ended.stderr), (0, ""))

    return test


for number, text in enumerate(EXAMPLES, 1):
    setattr(Page, f"test_runs_example_{number:02}", runs(text))


if __name__ == "__main__":
    unittest.main()
