"""scanloom.scans()"""

import gc
import unittest
import warnings

import numpy as np
import scanloom
from support import DRIVE, extrinsic, program


class Scans(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.given = scanloom.scans(DRIVE)
        cls.scans = list(cls.given)

    def test_have_arrays_of_equal_length_with_the_types_of_the_page(self):
        scan = self.scans[1]
        types = {"xyz": "float32", "x": "float32", "t": "int32", "ring": "uint8", "lidar": "uint8",
                 "intensity": "uint8", "range": "uint32", "column": "uint16", "signal": "uint16", "near_ir": "uint16"}
        for name, dtype in types.items():
            array = getattr(scan, name)
            self.assertEqual((array.dtype, len(array)), (np.dtype(dtype), len(scan)), name)
        self.assertEqual(scan.xyz.shape, (len(scan), 3))

    def test_are_as_many_as_the_program_records(self):
        recorded = program("record", DRIVE, "-o", "scans.rawlog", "-w", "--json")
        self.assertEqual(recorded.returncode, 0, recorded.stderr)
        self.assertIn(f'"scans": {len(self.scans)}', recorded.stdout)

    def test_follow_each_other_without_gap(self):
        ends = [scan.stamp + scan.period for scan in self.scans]
        self.assertEqual(ends[:-1], [scan.stamp for scan in self.scans[1:]])

    def test_are_in_the_order_of_time(self):
        for scan in self.scans:
            self.assertTrue((np.diff(scan.t) >= 0).all())
            self.assertTrue(scan.t.min() >= 0 and scan.t.max() < scan.period)

    def test_hold_points_of_both_lidars(self):
        self.assertEqual(self.given.lidars, ["left", "right"])
        self.assertEqual(set(np.unique(self.scans[1].lidar)), {0, 1})

    def test_have_ranges_that_fit_the_positions(self):
        """With the poses of the lidars that the simulation wrote."""
        scan = self.scans[1]
        for index, name in enumerate(self.given.lidars):
            ours = scan.lidar == index
            distance = np.linalg.norm(scan.xyz[ours] - extrinsic(name)[:3, 3], axis=1)
            np.testing.assert_allclose(distance, 1e-3 * scan.range[ours], atol=0.05)

    def test_come_with_the_samples_of_the_imu(self):
        stamp, accel, sensor = (np.concatenate([getattr(scan.imu, name) for scan in self.scans])
                                for name in ("stamp", "accel", "sensor"))
        self.assertEqual(set(sensor), {-1, 0, 1})  # the body's, and those inside the lidars
        for imu in (-1, 0, 1):
            self.assertTrue((np.diff(stamp[sensor == imu]) > 0).all())
            self.assertAlmostEqual(np.linalg.norm(accel[sensor == imu], axis=1)[:100].mean(), 9.81, delta=0.2)

    def test_tell_at_the_end_that_all_was_read(self):
        self.assertIs(self.given.good, True)
        self.assertEqual(self.given.warnings, [])
        self.assertGreater(self.given.counts["left.blocks_emitted"], 0)
        self.assertIsNone(scanloom.scans(DRIVE).good)


class Views(unittest.TestCase):
    def setUp(self):
        self.scan = next(scanloom.scans(DRIVE))

    def test_write_through(self):
        self.scan.xyz[5] = [1, 2, 3]
        self.assertEqual([self.scan.x[5], self.scan.y[5], self.scan.z[5]], [1, 2, 3])
        self.scan.z[:] = 7
        self.assertTrue((self.scan.xyz[:, 2] == 7).all())
        for name in ("t", "ring", "lidar", "intensity", "range", "column", "signal", "near_ir"):
            getattr(self.scan, name)[3] = 9
            self.assertEqual(getattr(self.scan, name)[3], 9, name)
        self.scan.imu.gyro[0, 1] = 4
        self.scan.imu.stamp[0] = 11
        self.assertEqual((self.scan.imu.gyro[0, 1], self.scan.imu.stamp[0]), (4, 11))

    def test_are_of_one_memory(self):
        self.assertTrue(np.shares_memory(self.scan.xyz, self.scan.xyz))
        self.assertTrue(np.shares_memory(self.scan.xyz, self.scan.y))
        for name in ("t", "ring", "range"):
            self.assertTrue(np.shares_memory(getattr(self.scan, name), getattr(self.scan, name)), name)
            self.assertFalse(getattr(self.scan, name).flags.owndata, name)

    def test_keep_the_scan_alive(self):
        xyz, t, gyro = self.scan.xyz, self.scan.t, self.scan.imu.gyro
        expected = xyz.copy(), t.copy(), gyro.copy()
        self.scan = None
        gc.collect()
        other = [scan.xyz.sum() for scan in scanloom.scans(DRIVE)]  # memory that was freed would be used again
        self.assertTrue(other)
        for array, copy in zip((xyz, t, gyro), expected):
            np.testing.assert_array_equal(array, copy)

    def test_of_a_scan_outlive_its_iterator(self):
        scans = scanloom.scans(DRIVE)
        scan = next(scans)
        expected = scan.xyz.copy()
        del scans
        gc.collect()
        np.testing.assert_array_equal(scan.xyz, expected)


class Inputs(unittest.TestCase):
    def test_are_files_folders_and_configurations(self):
        stamp = next(scanloom.scans(DRIVE)).stamp
        rig = program("config", "--for", DRIVE)
        with open("rig.ini", "w") as file:
            file.write(rig.stdout)
        for given in (DRIVE / "recording.pcap", [DRIVE / "recording.pcap"], str(DRIVE), "rig.ini",
                      scanloom.Configuration("rig.ini"), ["rig.ini", DRIVE]):
            self.assertEqual(next(scanloom.scans(given)).stamp, stamp, given)

    def test_may_be_a_rawlog(self):
        self.assertEqual(program("record", DRIVE, "-o", "input.rawlog", "-w").returncode, 0)
        of_rawlog, of_capture = next(scanloom.scans("input.rawlog")), next(scanloom.scans(DRIVE))
        self.assertEqual((of_rawlog.stamp, len(of_rawlog)), (of_capture.stamp, len(of_capture)))
        np.testing.assert_array_equal(of_rawlog.xyz, of_capture.xyz)

    def test_may_be_one_of_the_lidars(self):
        run = scanloom.scans(DRIVE, lidars="right")
        self.assertEqual(run.lidars, ["right"])
        self.assertEqual(set(next(run).lidar), {0})

    def test_say_what_was_recognised(self):
        self.assertTrue(any("left" in note for note in scanloom.scans(DRIVE).notes))

    def test_that_are_damaged_are_not_good(self):
        capture = (DRIVE / "recording.pcap").read_bytes()
        for file in ("left.json", "right.json", "extrinsics.txt", "imu.csv"):
            with open(file, "wb") as copy:
                copy.write((DRIVE / file).read_bytes())
        end = 24  # of the file's header
        while end < len(capture) // 2:
            end += 16 + int.from_bytes(capture[end + 8 : end + 12], "little")
        with open("damaged.pcap", "wb") as file:
            file.write(capture[:end] + b"\xff" * 16 + capture[end + 16 :])
        run = scanloom.scans("damaged.pcap")
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            list(run)
        self.assertIs(run.good, False)
        self.assertTrue(any("damaged" in warning for warning in run.warnings), run.warnings)
        self.assertTrue(any(issubclass(warning.category, scanloom.ScanloomWarning) for warning in caught))


if __name__ == "__main__":
    unittest.main()
