"""scanloom.Site"""

import unittest
import warnings

import numpy as np
import scanloom
from support import DRIVE, program


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        ended = program("slam", DRIVE, "--out-dir", "map", "-w")
        assert ended.returncode == 0, ended.stderr
        cls.site = scanloom.Site("map")
        cls.pose = list(scanloom.slam(DRIVE, clouds=True))[10]  # near the only keyframe

    def place_of(self, cloud, **known):
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            return self.site.locate(cloud, level_T_body=self.pose.map_T_body, **known), [str(w.message) for w in said]

    def assert_at_the_pose(self, place):
        np.testing.assert_allclose(place.map_T_body[:3, 3], self.pose.position, atol=0.1)
        np.testing.assert_allclose(place.map_T_body[:3, :3], self.pose.map_T_body[:3, :3], atol=0.01)

    def test_finds_a_cloud_where_it_is_about_and_says_nothing(self):
        about = self.pose.map_T_body.copy()
        about[:3, 3] += (3, -2, 0)
        place, said = self.place_of(self.pose.cloud, about=about)
        self.assertEqual((place.outcome, said), ("found", []))
        self.assert_at_the_pose(place)
        self.assertGreater(place.agreement, 0.8)
        self.assertGreater(np.linalg.eigvalsh(place.covariance).min(), 0)

    def test_finds_it_anywhere_in_the_map_but_one_cloud_is_no_proof(self):
        place, said = self.place_of(self.pose.cloud)
        self.assertEqual(place.outcome, "unconfirmed")
        self.assertIn("not confirmed", said[0])
        self.assert_at_the_pose(place)

    def test_takes_a_scan_with_the_machine_in_it(self):
        scan = list(scanloom.scans(DRIVE))[10]
        place, _ = self.place_of(scan, about=self.pose.map_T_body)
        self.assertEqual(place.outcome, "found")
        self.assert_at_the_pose(place)

    def test_says_that_a_cloud_is_not_in_the_map(self):
        cloud = list(scanloom.slam(DRIVE, clouds=True))[10].cloud
        cloud.xyz[:] = np.random.default_rng(1).uniform(-20, 20, cloud.xyz.shape)
        place, said = self.place_of(cloud)
        self.assertLess(place.agreement, 0.7)
        self.assertEqual((place.outcome, place.map_T_body, place.covariance),
                         ("not in map", None, None))
        self.assertIn("not in this map", said[0])

    def test_has_the_keyframes_and_lidars_of_the_drive(self):
        self.assertEqual(self.site.lidars, ["left", "right"])
        self.assertGreaterEqual(len(self.site), 1)

    def test_refuses_what_is_no_map_or_no_cloud(self):
        with self.assertRaisesRegex(scanloom.UsageError, "result folder of `scanloom slam`"):
            scanloom.Site(DRIVE)
        with self.assertRaisesRegex(scanloom.UsageError, "cloud of a pose"):
            self.site.locate(np.zeros((5, 3)))


if __name__ == "__main__":
    unittest.main()
