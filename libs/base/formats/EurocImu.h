/** IMU samples as csv in the layout of the EuRoC dataset: stamp in ns, gyro x y z in rad/s, accel x y z in m/s2. */
#pragma once
#include "base/core/ImuSample.h"

#include <filesystem>
#include <fstream>
#include <vector>

namespace scanloom
{
/**
 * Skips blank lines, lines that begin with '#', and one heading without '#'. In all other lines an integer stamp, later
 * than the one before, and six finite numbers are expected; throws std::runtime_error with file and line otherwise.
 */
std::vector<ImuSample> readEurocImu(const std::filesystem::path&);

/** Writes sample by sample, after a heading; reading the file gives the same samples to the bit. */
class EurocImuWriter
{
 public:
  /** Throws std::runtime_error if the file cannot be written, and so does close(). */
  explicit EurocImuWriter(const std::filesystem::path&);

  void add(const ImuSample&);

  /** No sample may follow. */
  void close();

 private:
  std::filesystem::path path_;
  std::ofstream file_;
};
}  // namespace scanloom
