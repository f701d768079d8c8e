/** Trajectories in the text formats that evo, rpg_trajectory_evaluation and KITTI's tools read. */
#pragma once
#include "base/core/OutputFile.h"
#include "base/core/StampedPose.h"

#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/** "t x y z qx qy qz qw": one pose a line, seconds and metres with 9 decimals, qw >= 0. */
class TumWriter
{
 public:
  explicit TumWriter(const std::filesystem::path& path) : file_(path) {}

  void add(const StampedPose&);
  void flush() { file_.flush(); }
  void close() { file_.commit(); }
  void closeAfterFailure() { file_.commitLines(); }

 private:
  OutputFile file_;
};

void writeTum(const std::filesystem::path&, const Trajectory&);

/** A line of such a file; nothing if it is none, or its quaternion no rotation. */
std::optional<StampedPose> parseTum(const std::string& line);

/** Skips comments (#) and empty lines. Throws std::invalid_argument with file and line if another line is no pose or
 * not later than the one before. */
Trajectory readTum(const std::filesystem::path&);

/** KITTI odometry: the upper 3x4 of each pose in row-major order; stamps in s, one a line, go to `times`. */
void writeKitti(const std::filesystem::path& poses, const std::filesystem::path& times, const Trajectory&);

/** EuRoC (ASL) csv with a header line: integer ns, position, quaternion with w first. */
void writeEuroc(const std::filesystem::path&, const Trajectory&);
}  // namespace scanloom
