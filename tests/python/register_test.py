"""scanloom.register()"""

import unittest
import warnings

import numpy as np
import scanloom
from support import DRIVE


def pose(x, y, z, yaw):
    """yaw in rad."""
    T = np.eye(4)
    T[:2, :2] = [[np.cos(yaw), -np.sin(yaw)], [np.sin(yaw), np.cos(yaw)]]
    T[:3, 3] = x, y, z
    return T


def moved(points, T):
    return points @ T[:3, :3].T + T[:3, 3]


def room(rng, count=20000):
    """Points on a floor, two walls and a slanted roof: every direction is observed."""
    u, v = rng.uniform(-10, 10, (2, count))
    floor = np.stack([u, v, np.full(count, -1.5)], 1)
    wall_x = np.stack([np.full(count, 9.3), u, np.abs(v) / 2], 1)
    wall_y = np.stack([u, np.full(count, -8.1), np.abs(v) / 2], 1)
    roof = np.stack([u, v, 5 + 0.3 * u], 1)
    return np.concatenate([floor, wall_x, wall_y, roof]) + rng.normal(0, 0.01, (4 * count, 3))


class Register(unittest.TestCase):
    def test_finds_a_motion_that_is_known(self):
        rng = np.random.default_rng(1)
        truth = pose(0.4, -0.3, 0.1, np.radians(3))
        result = scanloom.register(room(rng), moved(room(rng), np.linalg.inv(truth)))
        np.testing.assert_allclose(result.T, truth, atol=0.01)
        self.assertTrue(result.trustworthy, str(result))
        self.assertEqual(result.outcome, "converged")
        self.assertEqual(result.degenerate_directions.shape, (0, 6))
        self.assertEqual(result.covariance.shape, (6, 6))

    def test_names_the_directions_that_a_floor_leaves_open(self):
        rng = np.random.default_rng(1)
        floor = np.stack([*rng.uniform(-10, 10, (2, 40000)), rng.normal(0, 0.01, 40000)], 1)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            result = scanloom.register(floor, moved(floor, pose(0.1, 0, 0.05, 0)))
        self.assertEqual(result.outcome, "degenerate")
        open_steps = result.degenerate_directions
        self.assertEqual(open_steps.shape, (3, 6))  # x, y, and about z
        np.testing.assert_allclose(np.abs(open_steps[:, [2, 3, 4]]), 0, atol=0.1)
        self.assertFalse(result.trustworthy)
        self.assertIn("not trustworthy: degenerate", str(caught[0].message))

    def test_warns_where_clouds_do_not_overlap(self):
        rng = np.random.default_rng(1)
        with self.assertWarnsRegex(scanloom.ScanloomWarning, "not trustworthy"):
            scanloom.register(room(rng), room(rng) + 500)

    def test_takes_scans_arrays_and_views_alike(self):
        scans = list(scanloom.scans(DRIVE))
        of_scans = scanloom.register(scans[1], scans[3])
        of_arrays = scanloom.register(scans[1].xyz, scans[3].xyz.astype(np.float64))
        np.testing.assert_array_equal(of_scans.T, of_arrays.T)

    def test_leaves_points_out_that_are_not_finite(self):
        rng = np.random.default_rng(1)
        target, source = room(rng), room(rng)
        expected = scanloom.register(target, source)
        result = scanloom.register(np.concatenate([target, [[np.nan] * 3]]), source)
        np.testing.assert_array_equal(result.T, expected.T)
        self.assertIn("1 not finite, dropped", str(result))


if __name__ == "__main__":
    unittest.main()
