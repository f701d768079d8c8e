"""Stands in for evalio where it is not installed: the parts of its interface that scanloom.evalio uses."""

import sys
from dataclasses import dataclass, field
from types import ModuleType

import numpy as np


@dataclass(frozen=True)
class Stamp:
    nsec: int

    @staticmethod
    def from_nsec(nsec):
        return Stamp(nsec)

    def to_nsec(self):
        return self.nsec


class SE3:
    def __init__(self, matrix):
        self.matrix = np.array(matrix, dtype=float)

    @staticmethod
    def from_mat(matrix):
        return SE3(matrix)

    def to_mat(self):
        return self.matrix


@dataclass
class Duration:
    nsec: int

    @staticmethod
    def from_nsec(nsec):
        return Duration(nsec)

    def to_sec(self):
        return self.nsec / 1e9


@dataclass
class Point:
    x: float
    y: float
    z: float
    t: Duration
    row: int


@dataclass
class LidarMeasurement:
    stamp: Stamp
    points: list

    def to_vec_positions(self):
        return [np.array([point.x, point.y, point.z]) for point in self.points]

    def to_vec_stamps(self):
        return [point.t.to_sec() for point in self.points]


@dataclass
class ImuMeasurement:
    stamp: Stamp
    gyro: np.ndarray
    accel: np.ndarray


@dataclass
class LidarParams:
    num_rows: int
    num_columns: int
    min_range: float
    max_range: float
    rate: float = 10.0


@dataclass
class ImuParams:
    rate: float = 100.0
    gravity: np.ndarray = field(default_factory=lambda: np.array([0, 0, 9.81]))


class Pipeline:
    def __init__(self):
        self._saved = []

    def save(self, stamp, pose):
        self._saved.append((stamp, pose))

    def saved_estimates(self):
        saved, self._saved = self._saved, []
        return saved


def install():
    """import evalio.pipelines and evalio.types find these."""
    evalio, pipelines, types = (ModuleType(name) for name in ("evalio", "evalio.pipelines", "evalio.types"))
    pipelines.Pipeline = Pipeline
    for part in (Stamp, SE3, Duration, Point, LidarMeasurement, ImuMeasurement, LidarParams, ImuParams):
        setattr(types, part.__name__, part)
    evalio.pipelines, evalio.types = pipelines, types
    sys.modules.update({module.__name__: module for module in (evalio, pipelines, types)})
