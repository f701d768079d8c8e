/**
 * Any text as a table of an IMU: samples in order of time, or std::runtime_error. The first byte chooses lines to begin
 * with; and whether the rest is text, or a word of a table for each byte.
 * fuzz options: -max_len=512
 */
#include <array>
#include <stdexcept>
#include <string>

#include "MemoryFile.h"
#include "base/formats/ImuCsv.h"
#include "require.h"

using namespace scanloom;

namespace
{
const std::array<std::string, 4> kBeginnings{"", "1750000000000000000,0,0,0,0,0,9.8\n",
                                             "time,gyro_x [deg/s],gyro_y,gyro_z,ax [g],ay,az\n",
                                             "%time,field.header.stamp,wx,wy,wz,acc_x,acc_y,acc_z\n1,2,0,0,0,0,0,9\n"};

const std::array<std::string, 16> kWords{",",       "\n",  "0,0,0,0,0,9.8\n", "0",  "1", "-", ".",   "#",
                                         "1750000", "000", "9999999999999",   "e9", "x", " ", "nan", "gyro_x"};
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const MemoryFile table;
  if (size == 0) return 0;
  std::string text = kBeginnings[data[0] % kBeginnings.size()];
  for (std::size_t i = 1; i < size; ++i)
    text += data[0] & 4 ? kWords[data[i] % kWords.size()] : std::string(1, static_cast<char>(data[i]));
  beginsLikeImuCsv(text);
  mayThrow<std::runtime_error>(
      [&]
      {
        const ImuOfFile imu = readImuCsv(table.holding(text));
        for (std::size_t i = 0; i < imu.readings.samples.size(); ++i)
        {
          require(imu.readings.samples[i].gyro.allFinite() && imu.readings.samples[i].accel.allFinite());
          require(i == 0 || imu.readings.samples[i - 1].stamp < imu.readings.samples[i].stamp);
        }
      });
  return 0;
}
