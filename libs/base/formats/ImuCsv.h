/** IMU samples as tables of comma-separated values: EuRoC's, those of `rostopic echo -p`, and others by their headings.
 */
#pragma once
#include "base/core/oneOfEachStamp.h"

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace scanloom
{
struct ImuOfFile
{
  ImuOfEachStamp readings;
  std::vector<std::string> notes;  // what was concluded about columns and units
};

/** Whether the first lines of a text are those of a table that readImuCsv() reads. */
bool beginsLikeImuCsv(std::string_view text);

/**
 * Columns are named by a heading ("angular_velocity.x", "w_RS_S_x", "gyro_x", "ax", "stamp"; deg/s or g where it says
 * so), or are EuRoC's: stamp, gyro x y z in rad/s, accel x y z in m/s2. Stamps are in seconds if they have a decimal
 * point, else in that of ns, us and ms in which samples are 0.2 to 100 ms apart. Blank lines and those that begin with
 * '#' are skipped. Throws std::runtime_error with file and line for others.
 */
ImuOfFile readImuCsv(const std::filesystem::path&);

/** Writes EuRoC's table sample by sample, after a heading; reading the file gives the same samples to the bit. */
class ImuCsvWriter
{
 public:
  /** Throws std::runtime_error if the file cannot be written, and so does close(). */
  explicit ImuCsvWriter(const std::filesystem::path&);

  void add(const ImuSample&);

  /** No sample may follow. */
  void close();

 private:
  std::filesystem::path path_;
  std::ofstream file_;
};
}  // namespace scanloom
