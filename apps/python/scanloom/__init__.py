"""Several lidars on one machine used as one: scans merged by measurement time, localisation, registration.

Frames are right-handed: body x forward, y left, z up; a_T_b is the (4, 4) pose of b in a. Lengths are in m, angles in
rad, times in ns of the recording's clock. Arrays of clouds are views of the memory of C++ and may be written.

What the program `scanloom` prints as a warning is a ScanloomWarning here; its errors of usage are UsageError. Ctrl-C
ends a loop over scans or poses.
"""

import os

from . import _scanloom
from ._scanloom import (Cloud, Evaluation, ImuSamples, Place, Pose, Registration, Scan, Scans, ScanloomWarning, Slam,
                        UsageError, __version__)

__all__ = ["Cloud", "Configuration", "Evaluation", "ImuSamples", "Odometry", "Place", "Pose", "Registration", "Scan",
           "Scans", "ScanloomWarning", "Site", "Slam", "UsageError", "evaluate", "register", "scans", "slam", "write_trajectory"]


class Configuration:
    """Configuration files (INI), read together as with several -c of the program, and settings on top of them."""

    def __init__(self, *files, settings=None):
        self.files = list(files)
        self.settings = dict(settings or {})


def _text(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, tuple)):
        return "[" + " ".join(map(_text, value)) + "]"
    return str(value)


def _is_configuration(path):
    return os.fspath(path).lower().endswith(".ini")


def _arguments(input, settings, configuration=None, lidars=(), metadata=()):
    """What the program takes as RECORDING, -c and --set."""
    given = [] if input is None else [input] if isinstance(input, (str, os.PathLike, Configuration)) else list(input)
    configurations = [part for part in (*given, configuration) if isinstance(part, Configuration)]
    paths = [part for part in given if not isinstance(part, Configuration)]
    if configuration is not None and not isinstance(configuration, Configuration):
        files = [configuration] if isinstance(configuration, (str, os.PathLike)) else list(configuration)
        configurations.append(Configuration(*files))

    arguments = _scanloom.InputArguments()
    arguments.recording = [path for path in paths if not _is_configuration(path)]
    arguments.configurations = [file for part in configurations for file in part.files]
    arguments.configurations += [path for path in paths if _is_configuration(path)]
    settings = [item for part in configurations for item in part.settings.items()] + list((settings or {}).items())
    arguments.assignments = [f"{key}={_text(value)}" for key, value in settings]
    arguments.lidars = [lidars] if isinstance(lidars, str) else list(lidars)
    arguments.metadata = [metadata] if isinstance(metadata, (str, os.PathLike)) else list(metadata)
    return arguments


def scans(input, *, configuration=None, settings=None, lidars=(), metadata=()):
    """Iterates over the scans of a recording, or of live lidars.

    input: a path, or several, of what `scanloom slam` takes as RECORDING (captures, bags of ROS, rawlogs, clouds, or a
      folder of these), a configuration file (.ini), or a Configuration.
    configuration: file, files or Configuration beside a recording, as -c.
    settings: {"section.key": value}, as --set.
    lidars: names of those to use; default: all.
    metadata: of lidars, instead of those beside the captures.
    """
    return Scans(_arguments(input, settings, configuration, lidars, metadata))


def slam(input, *, every_nth=None, map=None, at=None, configuration=None, settings=None, lidars=(), metadata=(),
         clouds=False):
    """Iterates over the poses of a machine; the same bits as `scanloom slam` writes.

    every_nth: use every N-th scan only; the IMU is used in full.
    map: result folder of an earlier slam, in whose map the drive is searched until it is found, as --map. From there on
      poses are in the frame of that map, and `in_map`.
    at: where in the map the body starts, within 6 m and 30 deg: (4, 4) map_T_body, a .tum file, whose last pose counts,
      or "x y z yaw pitch roll" (m, deg); default: anywhere.
    clouds: keep the deskewed cloud of each pose; the memory of a long list of such poses is large.
    The other arguments are those of scans(). At the end `good` and `outcome` tell how the run went; a result that may
    be wrong is a ScanloomWarning, too.
    """
    settings = dict(settings or {})
    if every_nth is not None:
        settings["slam.every_nth"] = every_nth
    return Slam(_arguments(input, settings, configuration, lidars, metadata), map, at, clouds)


def register(target, source, guess=None, *, guess_sigma=None):
    """Finds the pose of one point cloud in another.

    target, source: arrays (N, 3) in m, Scans, Clouds, or files (PLY, PCD, KITTI).
    guess: (4, 4) target_T_source; default: the identity.
    guess_sigma: (m, deg), standard deviations of the guess.
    A result that may be wrong is a ScanloomWarning, and not `trustworthy`.
    """
    return _scanloom.register(target, source, guess, guess_sigma)


def evaluate(trajectory, reference, *, align="yaw", lever_arm=(0, 0, 0), reference_topic=""):
    """Compares a trajectory with a reference, as `scanloom evaluate` does.

    trajectory: a file (TUM, EuRoC, KITTI), or poses of slam().
    reference: a file of poses, of a total station or a bag of ROS, or poses.
    align: "yaw" or "se3", on the first 10 % of the path.
    lever_arm: (3,) m, the point of the body that is compared, e.g. a prism.
    """
    return _scanloom.evaluate(_file_or_poses(trajectory), _file_or_poses(reference), align, lever_arm, reference_topic)


def _file_or_poses(given):
    return given if isinstance(given, (str, os.PathLike)) else list(given)


def write_trajectory(file, poses):
    """Writes poses as TUM (.tum), EuRoC (.csv) or KITTI (.txt), by the file's ending.

    Of a drive that was found in a map, those from there on, as `scanloom slam` does.
    """
    _scanloom.write_trajectory(file, list(poses))


class Site(_scanloom.Site):
    """The map of an earlier drive: a result folder of `scanloom slam`.

    configuration, settings: as for scans(); the cells are those of [map_cells] and [fine_cells].
    """

    def __init__(self, folder, *, configuration=None, settings=None):
        super().__init__(folder, _arguments(None, settings, configuration))

    def locate(self, cloud, *, level_T_body=None, about=None):
        """Where in the map a cloud was seen.

        cloud: that of a pose, by slam(clouds=True), or a Scan, which holds the machine's own points; `lidar` counts as
          in `lidars`.
        level_T_body: (4, 4), a pose of the body in a frame whose z is up, as of slam(); default: the body stands level.
        about: (4, 4) map_T_body within 6 m and 30 deg of heading; default: anywhere in the map.
        One cloud alone is `found` only with `about`; else it is `unconfirmed`, and a second one some metres on proves it
        if it is at the same place by the odometry in between. Whatever is not found is a ScanloomWarning.
        """
        return super().locate(cloud, level_T_body, about)


class Odometry(_scanloom.Odometry):
    """Localisation with clouds and IMU samples that are given one by one, in the order of time.

    body_T_lidar: {name: (4, 4)}, by which clouds name their lidar as 0, 1, ...; default: one, at the body's origin.
    body_T_imu: (4, 4), or None where there is no IMU.
    settings, configuration: as for scans().
    Each of add_imu(), add_cloud(), add_scan() and finish() returns the list of poses that became possible: a scan waits
    for the IMU samples up to its end, and the first scans for the start.
    """

    def __init__(self, *, body_T_lidar=None, body_T_imu=None, configuration=None, settings=None):
        if body_T_lidar is None:
            body_T_lidar = {"lidar": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}
        super().__init__(body_T_lidar, body_T_imu, _arguments(None, settings, configuration))

    def add_cloud(self, stamp, xyz, t=None, *, lidar=None, ring=None, intensity=None, period=None):
        """A cloud as one scan.

        stamp: ns, start of the scan; of a cloud without t the instant of all its points.
        xyz: (N, 3) m, in the body frame at each point's own time.
        t: (N,) ns after the stamp.
        lidar, ring, intensity: (N,) from 0 to 255.
        period: ns, of the scan; default: up to the last t, or 0.1 s.
        """
        return super().add_cloud(stamp, xyz, t, lidar, ring, intensity, period)
