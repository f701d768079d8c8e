/** Poses of sensors on the body: as text, and from the calibration file of a recording's folder. */
#pragma once
#include "base/core/Rigid.h"

#include <filesystem>
#include <map>
#include <string>

namespace scanloom
{
/**
 * `[x y z yaw pitch roll]` in metres and degrees, as MRPT's CPose3D::fromString reads it (brackets may be missing).
 * Throws std::invalid_argument saying what is wrong with the text.
 */
Rigid parsePose(const std::string& text);

/** "x y z yaw pitch roll" with nine decimals, as in extrinsics files. */
std::string poseText(const Rigid&);

/**
 * A file of lines `T_a_b x y z yaw pitch roll` (m, deg), by name. The rows of 4x4 matrices that follow a line, comments
 * (#) and blank lines are skipped, but a matrix that contradicts its line by more than 1e-6 is an error.
 * Throws std::runtime_error with file and line.
 */
std::map<std::string, Rigid> readExtrinsics(const std::filesystem::path&);
}  // namespace scanloom
