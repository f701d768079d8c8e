"""scanloom as a pipeline of evalio (https://github.com/contagon/evalio), which runs it over public datasets.

    EVALIO_CUSTOM=scanloom.evalio evalio run -p scanloom -d multi_campus/ntu_day_01 -o results
"""

import numpy as np

import scanloom

try:
    from evalio.pipelines import Pipeline
    from evalio.types import SE3, Stamp
except ImportError as missing:
    raise ImportError("scanloom.evalio is for evalio: pip install evalio") from missing


class Scanloom(Pipeline):
    """The body is evalio's IMU frame. Parameters are keys of `scanloom config --default slam`."""

    def __init__(self):
        super().__init__()
        self._settings = {}
        self._imu_T_lidar = np.eye(4)
        self._lidar = None
        self._odometry = None

    @staticmethod
    def name():
        return "scanloom"

    @staticmethod
    def version():
        return scanloom.__version__

    @staticmethod
    def default_params():
        """evalio refuses names and types of parameters that are not among these."""
        return {"slam.every_nth": 1, "slam.forest": False, "slam.relative": True, "slam.imu_delay_ms": 0.0,
                "start.duration": 2.0, "imu_noise.gyro_noise_deg": 0.003, "imu_noise.accel_noise": 0.00025,
                "imu_noise.gyro_bias_walk_deg": 0.0004, "imu_noise.accel_bias_walk": 0.0001, "crop.min_range": 0.5,
                "crop.max_range": 100.0, "scan_cells.cell_size": 2.5, "fine_cells.cell_size": 1.0,
                "map_cells.cell_size": 1.0, "keyframe_cells.cell_size": 0.75, "local_map.keyframe_distance": 4.0,
                "local_map.keyframes": 12}

    def set_params(self, params):
        """Takes all of them; initialize() refuses wrong values in the program's words."""
        self._settings = dict(params)
        return {}

    def set_imu_params(self, params):
        """The noise of [imu_noise] stays: a dataset's is that of a data sheet, not of the IMU on its mount."""

    def set_lidar_params(self, params):
        self._lidar = params

    def set_imu_T_lidar(self, T):
        self._imu_T_lidar = np.asarray(T.to_mat())

    def initialize(self):
        self._odometry = scanloom.Odometry(body_T_lidar={"lidar": self._imu_T_lidar}, body_T_imu=np.eye(4),
                                           settings=self._settings)

    def add_imu(self, mm):
        self._save(self._odometry.add_imu(mm.stamp.to_nsec(), mm.gyro, mm.accel))

    def add_lidar(self, mm):
        xyz = np.asarray(mm.to_vec_positions(), dtype=np.float64).reshape(-1, 3)
        t = np.rint(1e9 * np.asarray(mm.to_vec_stamps(), dtype=np.float64)).astype(np.int64)
        rings = np.array([point.row for point in mm.points], dtype=np.int64)
        distance = np.linalg.norm(xyz, axis=1)
        kept = np.isfinite(distance) & (distance >= self._lidar.min_range) & (distance <= self._lidar.max_range)
        kept &= distance > 0  # a row-major cloud has points without a return at the origin
        if not kept.any():
            return
        body = xyz[kept] @ self._imu_T_lidar[:3, :3].T + self._imu_T_lidar[:3, 3]
        begin = int(t[kept].min())  # scans that are stamped at their end have times below 0
        self._save(self._odometry.add_cloud(mm.stamp.to_nsec() + begin, body, t[kept] - begin, ring=rings[kept]))

    def map(self):
        return {}

    def _save(self, poses):
        for pose in poses:
            self.save(Stamp.from_nsec(pose.stamp), SE3.from_mat(pose.map_T_body))
