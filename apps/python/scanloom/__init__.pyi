from os import PathLike
from typing import Any, Final, Iterable, Iterator, Mapping, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str

# Attributes are Final: they have no setter. What they refer to, such as the values of an array, may be written.

Path = Union[str, "PathLike[str]"]
Settings = Mapping[str, Any]
Input = Union[Path, "Configuration", Sequence[Union[Path, "Configuration"]]]
Configurations = Union[Path, "Configuration", Sequence[Path], None]
Paths = Union[Path, Sequence[Path]]
Names = Union[str, Sequence[str]]

class UsageError(ValueError): ...
class ScanloomWarning(UserWarning): ...

class Configuration:
    files: list[Path]
    settings: dict[str, Any]
    def __init__(self, *files: Path, settings: Optional[Settings] = None) -> None: ...

class Cloud:
    """N points. Its arrays are views of one memory, which they keep alive, and may be written."""

    xyz: Final[NDArray[np.float32]]  # (N, 3) m
    x: Final[NDArray[np.float32]]  # (N,) m
    y: Final[NDArray[np.float32]]
    z: Final[NDArray[np.float32]]
    t: Final[NDArray[np.int32]]  # (N,) ns after the stamp
    ring: Final[NDArray[np.uint8]]
    lidar: Final[NDArray[np.uint8]]
    intensity: Final[NDArray[np.uint8]]
    range: Final[NDArray[np.uint32]]  # (N,) mm
    column: Final[NDArray[np.uint16]]
    signal: Final[NDArray[np.uint16]]
    near_ir: Final[NDArray[np.uint16]]
    def __len__(self) -> int: ...

class ImuSamples:
    stamp: Final[NDArray[np.int64]]  # (M,) ns
    gyro: Final[NDArray[np.float64]]  # (M, 3) rad/s
    accel: Final[NDArray[np.float64]]  # (M, 3) m/s2
    sensor: Final[NDArray[np.int32]]  # (M,) -1: the body's
    def __len__(self) -> int: ...

class Scan(Cloud):
    stamp: Final[int]  # ns
    period: Final[int]  # ns
    complete: Final[bool]
    missing: Final[list[int]]
    imu: Final[ImuSamples]

class Scans(Iterator[Scan]):
    lidars: Final[list[str]]
    notes: Final[list[str]]
    warnings: Final[list[str]]
    counts: Final[dict[str, int]]
    good: Final[Optional[bool]]
    def __iter__(self) -> "Scans": ...
    def __next__(self) -> Scan: ...

class Pose:
    stamp: Final[int]  # ns
    map_T_body: Final[NDArray[np.float64]]  # (4, 4)
    position: Final[NDArray[np.float64]]  # (3,) m
    quaternion: Final[NDArray[np.float64]]  # (4,) x y z w
    covariance: Final[NDArray[np.float64]]  # (6, 6) m, rad
    covariance_since_start: Final[NDArray[np.float64]]  # (6, 6) m, rad
    velocity: Final[NDArray[np.float64]]  # (3,) m/s
    health: Final[str]
    trusted: Final[bool]
    recovered: Final[bool]
    map_restarted: Final[bool]
    in_map: Final[bool]
    scan_complete: Final[bool]
    imu_complete: Final[bool]
    cloud: Final[Union[Cloud, Any]]  # None unless slam(clouds=True), which mypy cannot know

class Slam(Iterator[Pose]):
    lidars: Final[list[str]]
    notes: Final[list[str]]
    warnings: Final[list[str]]
    outcome: Final[Optional[str]]
    good: Final[Optional[bool]]
    counts: Final[dict[str, int]]
    def __iter__(self) -> "Slam": ...
    def __next__(self) -> Pose: ...

class Odometry:
    warnings: Final[list[str]]
    outcome: Final[Optional[str]]
    good: Final[Optional[bool]]
    counts: Final[dict[str, int]]
    def __init__(
        self,
        *,
        body_T_lidar: Optional[Mapping[str, ArrayLike]] = None,
        body_T_imu: Optional[ArrayLike] = None,
        configuration: Configurations = None,
        settings: Optional[Settings] = None,
    ) -> None: ...
    def add_imu(self, stamp: int, gyro: ArrayLike, accel: ArrayLike) -> list[Pose]: ...
    def add_cloud(
        self,
        stamp: int,
        xyz: ArrayLike,
        t: Optional[ArrayLike] = None,
        *,
        lidar: Optional[ArrayLike] = None,
        ring: Optional[ArrayLike] = None,
        intensity: Optional[ArrayLike] = None,
        period: Optional[int] = None,
    ) -> list[Pose]: ...
    def add_scan(self, scan: Scan) -> list[Pose]: ...
    def finish(self) -> list[Pose]: ...

class Registration:
    T: Final[NDArray[np.float64]]  # (4, 4) target_T_source
    covariance: Final[NDArray[np.float64]]  # (6, 6) m, rad
    outcome: Final[str]
    degenerate_directions: Final[NDArray[np.float64]]  # (K, 6)
    overlap: Final[float]
    iterations: Final[int]
    trustworthy: Final[bool]

class Place:
    outcome: Final[str]
    map_T_body: Final[Optional[NDArray[np.float64]]]  # (4, 4)
    covariance: Final[Optional[NDArray[np.float64]]]  # (6, 6)
    agreement: Final[float]

class Site:
    lidars: Final[list[str]]
    def __init__(
        self, folder: Path, *, configuration: Configurations = None, settings: Optional[Settings] = None
    ) -> None: ...
    def __len__(self) -> int: ...
    def locate(
        self,
        cloud: Cloud,
        *,
        level_T_body: Optional[ArrayLike] = None,
        about: Optional[ArrayLike] = None,
    ) -> Place: ...

class Evaluation:
    drift: Final[float]  # m
    drift_percent: Final[Optional[float]]
    path_length: Final[float]  # m
    covered: Final[float]
    ape: Final[float]  # m
    rpe: Final[float]  # m
    def as_dict(self) -> dict[str, Any]: ...

def scans(
    input: Input,
    *,
    configuration: Configurations = None,
    settings: Optional[Settings] = None,
    lidars: Names = (),
    metadata: Paths = (),
) -> Scans: ...
def slam(
    input: Input,
    *,
    every_nth: Optional[int] = None,
    map: Optional[Path] = None,
    at: Union[Path, ArrayLike, None] = None,
    configuration: Configurations = None,
    settings: Optional[Settings] = None,
    lidars: Names = (),
    metadata: Paths = (),
    clouds: bool = False,
) -> Slam: ...
def register(
    target: Union[Path, Cloud, ArrayLike],
    source: Union[Path, Cloud, ArrayLike],
    guess: Optional[ArrayLike] = None,
    *,
    guess_sigma: Optional[tuple[float, float]] = None,
) -> Registration: ...
def evaluate(
    trajectory: Union[Path, Iterable[Pose]],
    reference: Union[Path, Iterable[Pose]],
    *,
    align: str = "yaw",
    lever_arm: ArrayLike = (0, 0, 0),
    reference_topic: str = "",
) -> Evaluation: ...
def write_trajectory(file: Path, poses: Iterable[Pose]) -> None: ...
