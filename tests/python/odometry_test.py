"""scanloom.Odometry"""

import unittest
import warnings

import numpy as np
import scanloom
from support import DRIVE, extrinsic


def fed(odometry, scans, add):
    """Samples and scans in the order in which the recording gave them."""
    poses = []
    for scan in scans:
        body = scan.imu.sensor == -1  # not those inside the lidars
        for stamp, gyro, accel in zip(scan.imu.stamp[body], scan.imu.gyro[body], scan.imu.accel[body]):
            poses += odometry.add_imu(stamp, gyro, accel)
        poses += add(scan)
    return poses + odometry.finish()


class Odometry(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scans = list(scanloom.scans(DRIVE))

    def odometry(self, **settings):
        return scanloom.Odometry(body_T_lidar={"left": extrinsic("left"), "right": extrinsic("right")},
                                 body_T_imu=extrinsic("imu"), **settings)

    def assert_same_track(self, poses, expected, tolerance):
        """Poses of sensors as matrices differ from those as angles in the last bits, and so do the first estimates."""
        self.assertEqual([pose.stamp for pose in poses], [pose.stamp for pose in expected])
        for pose, other in zip(poses, expected):
            np.testing.assert_allclose(pose.position, other.position, atol=tolerance)

    def test_gives_the_poses_of_slam_if_it_is_fed_the_same(self):
        odometry = self.odometry()
        poses = fed(odometry, self.scans, odometry.add_scan)
        self.assert_same_track(poses, list(scanloom.slam(DRIVE)), 1e-3)
        self.assertEqual((odometry.outcome, odometry.good), ("OK", True))

    def test_takes_clouds_as_arrays(self):
        odometry = self.odometry()
        poses = fed(odometry, self.scans,
                    lambda scan: odometry.add_cloud(scan.stamp, scan.xyz, scan.t, lidar=scan.lidar, ring=scan.ring,
                                                    intensity=scan.intensity, period=scan.period))
        self.assert_same_track(poses, list(scanloom.slam(DRIVE)), 1e-3)

    def test_takes_points_in_any_order(self):
        odometry, shuffled = self.odometry(), self.odometry()
        rng = np.random.default_rng(1)

        def add(scan):
            order = rng.permutation(len(scan))
            return shuffled.add_cloud(scan.stamp, scan.xyz[order], scan.t[order], lidar=scan.lidar[order],
                                      ring=scan.ring[order], period=scan.period)

        expected = fed(odometry, self.scans[:30], odometry.add_scan)
        self.assert_same_track(fed(shuffled, self.scans[:30], add), expected, 0.01)

    def test_gives_the_same_bits_twice(self):
        poses = [fed(odometry, self.scans[:30], odometry.add_scan) for odometry in (self.odometry(), self.odometry())]
        for one, other in zip(*poses):
            np.testing.assert_array_equal(one.map_T_body, other.map_T_body)

    def test_goes_without_an_imu_and_says_so(self):
        odometry = scanloom.Odometry()
        poses = []
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            for scan in self.scans[:20]:
                poses += odometry.add_cloud(scan.stamp, scan.xyz, scan.t, period=scan.period)
            poses += odometry.finish()
        self.assertGreater(len(poses), 15)
        self.assertIn("there is no IMU", str(caught[0].message))

    def test_refuses_what_no_scan_can_be(self):
        odometry = self.odometry()
        xyz = np.ones((3, 3))
        for arguments, words in (
                (dict(t=[0, 1]), "t has 2 values, xyz 3 points: must be as many"),
                (dict(t=[0, 1, -5]), "t has -5: must be from 0"),
                (dict(lidar=[0, 1, 2]), "lidar has 2: must be from 0 to 1"),
                (dict(ring=[0, 1, 256]), "ring has 256: must be from 0 to 255"),
                (dict(period=0), "a scan of 0 s: must be above 0"),
                (dict(t=[0, 1, 3_000_000_000]), "a scan of 3")):
            with self.assertRaises(scanloom.UsageError) as caught:
                odometry.add_cloud(1_000_000_000, xyz, **arguments)
            self.assertIn(words, str(caught.exception))
        odometry.add_cloud(1_000_000_000, xyz, [0, 1, 2])
        with self.assertRaisesRegex(scanloom.UsageError, "must end after the one before"):
            odometry.add_cloud(900_000_000, xyz, [0, 1, 2])
        with self.assertRaisesRegex(scanloom.UsageError, "every_nht"):
            scanloom.Odometry(settings={"slam.every_nht": 1})

    def test_is_over_after_finish(self):
        odometry = scanloom.Odometry()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            odometry.finish()
        with self.assertRaisesRegex(scanloom.UsageError, "finish\\(\\) was called"):
            odometry.add_imu(1, [0, 0, 0], [0, 0, 9.81])


if __name__ == "__main__":
    unittest.main()
