"""scanloom.evalio, on a dataset object of our own that reads an MCAP of ours."""

import importlib.util
import unittest

import numpy as np
import scanloom
from support import DRIVE, extrinsic, program, python

if importlib.util.find_spec("evalio") is None:
    import evalio_stand_in

    evalio_stand_in.install()
from evalio.types import SE3, Duration, ImuMeasurement, ImuParams, LidarMeasurement, LidarParams, Point, Stamp
from scanloom.evalio import Scanloom


class Dataset:
    """The left lidar and the IMU of an MCAP, in the order in which evalio gives them: by stamps, scans by their start."""

    def __init__(self, recording):
        self.scans = list(scanloom.scans(recording))

    def imu_T_lidar(self):
        return SE3.from_mat(np.linalg.inv(extrinsic("imu")) @ extrinsic("left"))

    def imu_params(self):
        return ImuParams()

    def lidar_params(self):
        return LidarParams(num_rows=128, num_columns=1024, min_range=0.3, max_range=100.0)

    def __iter__(self):
        return iter(sorted([*self.clouds(), *self.samples()], key=lambda measured: measured.stamp.to_nsec()))

    def clouds(self):
        left_T_body = np.linalg.inv(extrinsic("left"))
        for scan in self.scans:
            left = scan.lidar == 0
            xyz = scan.xyz[left][::4] @ left_T_body[:3, :3].T + left_T_body[:3, 3]
            points = [Point(x=float(x), y=float(y), z=float(z), t=Duration.from_nsec(int(t)), row=int(row))
                      for (x, y, z), t, row in zip(xyz, scan.t[left][::4], scan.ring[left][::4])]
            no_return = Point(x=0.0, y=0.0, z=0.0, t=Duration.from_nsec(0), row=0)
            yield LidarMeasurement(Stamp.from_nsec(scan.stamp), [no_return, *points])

    def samples(self):
        for scan in self.scans:
            body = scan.imu.sensor == -1
            for stamp, gyro, accel in zip(scan.imu.stamp[body], scan.imu.gyro[body], scan.imu.accel[body]):
                yield ImuMeasurement(Stamp.from_nsec(int(stamp)), gyro, accel)


def run(pipeline, dataset):
    """As evalio does."""
    pipeline.set_params(Scanloom.default_params())
    pipeline.set_imu_params(dataset.imu_params())
    pipeline.set_lidar_params(dataset.lidar_params())
    pipeline.set_imu_T_lidar(dataset.imu_T_lidar())
    pipeline.initialize()
    saved = []
    for measured in dataset:
        if isinstance(measured, ImuMeasurement):
            pipeline.add_imu(measured)
        else:
            pipeline.add_lidar(measured)
        saved += pipeline.saved_estimates()
    return saved


class Pipeline(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        program("record", DRIVE, "-o", "drive.rawlog", "-w")
        program("edit", "-i", "drive.rawlog", "--to-mcap", "drive.mcap", "-w")
        cls.dataset = Dataset("drive.mcap")
        cls.saved = run(Scanloom(), cls.dataset)

    def test_gives_a_pose_of_every_scan_but_the_last(self):
        ends = [scan.stamp + scan.period for scan in self.dataset.scans]
        stamps = [stamp.to_nsec() for stamp, _ in self.saved]
        self.assertGreaterEqual(len(stamps), len(ends) - 2)
        self.assertTrue(all(any(abs(stamp - end) < 1e6 for end in ends) for stamp in stamps))

    def test_gives_poses_of_the_imu_that_are_true(self):
        lines = [line.split() for line in (DRIVE / "groundtruth.tum").read_text().splitlines() if line[0] != "#"]
        truth = np.array(lines, dtype=np.float64)
        body_T_imu = extrinsic("imu")

        def true_place(stamp):
            at = np.argmin(np.abs(truth[:, 0] - 1e-9 * stamp))
            x, y, z, w = truth[at, 4:8]
            R = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                          [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                          [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
            return truth[at, 1:4] + R @ body_T_imu[:3, 3]

        def travelled(places):
            return np.linalg.norm(np.array(places) - places[0], axis=1)

        estimated = travelled([pose.to_mat()[:3, 3] for _, pose in self.saved])
        true = travelled([true_place(stamp.to_nsec()) for stamp, _ in self.saved])
        self.assertGreater(true.max(), 1)
        np.testing.assert_allclose(estimated, true, atol=0.05 + 0.02 * true.max())

    def test_has_default_parameters_that_scanloom_knows(self):
        pipeline = Scanloom()
        self.assertEqual(pipeline.set_params(Scanloom.default_params()), {})
        pipeline.initialize()

    def test_refuses_wrong_parameters_in_the_words_of_the_program(self):
        pipeline = Scanloom()
        pipeline.set_params({"slam.every_nth": 0})
        with self.assertRaisesRegex(scanloom.UsageError, "every_nth = 0"):
            pipeline.initialize()

    def test_is_optional(self):
        ended = python("import sys; sys.modules['evalio'] = None\nimport scanloom\nimport scanloom.evalio")
        self.assertIn("scanloom.evalio is for evalio: pip install evalio", ended.stderr)


if __name__ == "__main__":
    unittest.main()
