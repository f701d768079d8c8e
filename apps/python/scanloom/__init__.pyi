from os import PathLike
from typing import Any, Iterable, Iterator, Mapping, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str

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

    xyz: NDArray[np.float32]  # (N, 3) m
    x: NDArray[np.float32]  # (N,) m
    y: NDArray[np.float32]
    z: NDArray[np.float32]
    t: NDArray[np.int32]  # (N,) ns after the stamp
    ring: NDArray[np.uint8]
    lidar: NDArray[np.uint8]
    intensity: NDArray[np.uint8]
    range: NDArray[np.uint32]  # (N,) mm
    column: NDArray[np.uint16]
    signal: NDArray[np.uint16]
    near_ir: NDArray[np.uint16]
    def __len__(self) -> int: ...

class ImuSamples:
    stamp: NDArray[np.int64]  # (M,) ns
    gyro: NDArray[np.float64]  # (M, 3) rad/s
    accel: NDArray[np.float64]  # (M, 3) m/s2
    sensor: NDArray[np.int32]  # (M,) -1: the body's
    def __len__(self) -> int: ...

class Scan(Cloud):
    stamp: int  # ns
    period: int  # ns
    complete: bool
    missing: list[int]
    imu: ImuSamples

class Scans(Iterator[Scan]):
    lidars: list[str]
    notes: list[str]
    warnings: list[str]
    counts: dict[str, int]
    good: Optional[bool]
    def __iter__(self) -> "Scans": ...
    def __next__(self) -> Scan: ...

class Pose:
    stamp: int  # ns
    map_T_body: NDArray[np.float64]  # (4, 4)
    position: NDArray[np.float64]  # (3,) m
    quaternion: NDArray[np.float64]  # (4,) x y z w
    covariance: NDArray[np.float64]  # (6, 6) m, rad
    covariance_since_start: NDArray[np.float64]  # (6, 6) m, rad
    velocity: NDArray[np.float64]  # (3,) m/s
    health: str
    trusted: bool
    recovered: bool
    map_restarted: bool
    in_map: bool
    scan_complete: bool
    imu_complete: bool
    cloud: Union[Cloud, Any]  # None unless slam(clouds=True), which mypy cannot know

class Slam(Iterator[Pose]):
    lidars: list[str]
    notes: list[str]
    warnings: list[str]
    outcome: Optional[str]
    good: Optional[bool]
    counts: dict[str, int]
    def __iter__(self) -> "Slam": ...
    def __next__(self) -> Pose: ...

class Odometry:
    warnings: list[str]
    outcome: Optional[str]
    good: Optional[bool]
    counts: dict[str, int]
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
    T: NDArray[np.float64]  # (4, 4) target_T_source
    covariance: NDArray[np.float64]  # (6, 6) m, rad
    outcome: str
    degenerate_directions: NDArray[np.float64]  # (K, 6)
    overlap: float
    iterations: int
    trustworthy: bool

class Place:
    outcome: str
    map_T_body: Optional[NDArray[np.float64]]  # (4, 4)
    covariance: Optional[NDArray[np.float64]]  # (6, 6)
    agreement: float

class Site:
    lidars: list[str]
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
    drift: float  # m
    drift_percent: Optional[float]
    path_length: float  # m
    covered: float
    ape: float  # m
    rpe: float  # m
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
