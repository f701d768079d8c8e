/** IMU readings as csv in the layout of the EuRoC data set: ns, gyro x y z in rad/s, accelerometer x y z in m/s2. */
#pragma once
#include "core/ImuSample.h"

#include <filesystem>
#include <fstream>
#include <vector>

namespace scanloom
{
/**
 * Lines beginning with '#' and blank ones are skipped, and so is one heading without '#'. Throws std::runtime_error
 * with file and line for anything else that is not an integer stamp later than the one before and six finite numbers.
 */
std::vector<ImuSample> readEurocImu(const std::filesystem::path&);

/** For files that grow: with heading; reading them back gives the same samples to the bit. */
class EurocImuWriter
{
 public:
  /** Throws std::runtime_error if the file cannot be written, as close() does. */
  explicit EurocImuWriter(const std::filesystem::path&);

  void add(const ImuSample&);

  /** No sample may follow. */
  void close();

 private:
  std::filesystem::path path_;
  std::ofstream file_;
};

/** With heading; reading it back gives the same samples to the bit. Throws std::runtime_error if the file cannot be
 * written. */
void writeEurocImu(const std::filesystem::path&, const std::vector<ImuSample>&);
}  // namespace scanloom
