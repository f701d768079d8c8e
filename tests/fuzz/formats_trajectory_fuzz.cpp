/**
 * Any text as a trajectory of TUM, EuRoC or KITTI: poses in order of time that can be interpolated and written, or
 * std::invalid_argument. The first byte chooses lines to begin with; and whether the rest is text, or a word of a
 * trajectory for each byte. Text behind a zero byte is KITTI's file of stamps; without one there is a stamp per line.
 * fuzz options: -max_len=512
 */
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "MemoryFile.h"
#include "base/formats/SecondsText.h"
#include "base/formats/TrajectoryReader.h"
#include "wordsOf.h"

using namespace scanloom;
using namespace std::chrono_literals;

namespace
{
const std::array<std::string, 4> kBeginnings{"", "1750000000.5 1 2 3 0 0 0 1\n",
                                             "1403636579763555584,1,2,3,0.70710678,0,0,0.70710678,0.5\n",
                                             "1 0 0 1 0 1 0 2 0 0 1 3\n"};

const std::array<std::string, 33> kWords{std::string(1, '\0'),
                                         " ",
                                         ",",
                                         "\n",
                                         "\r\n",
                                         "#",
                                         "-",
                                         ".",
                                         "0",
                                         "1",
                                         "2",
                                         "9",
                                         "1 0 0 0",
                                         "0 0 0 1",
                                         "1,0,0,0",
                                         "1 2 3",
                                         "1,2,3",
                                         "0.70710678",
                                         "e",
                                         "e9",
                                         "nan",
                                         "inf",
                                         "1e308",
                                         "-8999999999",
                                         "8999999999",
                                         "1750000000",
                                         "1750000000.000000001",
                                         "1403636579763555584",
                                         "9223372036854775807",
                                         "-9223372036854775808",
                                         "1 0 0 1 0 1 0 2 0 0 1 3",
                                         "0 1 0 1 1 0 0 2 0 0 1 3",
                                         "\t"};

std::string aStampPerLine(const std::string& poses)
{
  std::string text;
  for (std::ptrdiff_t i = 0; i <= std::count(poses.begin(), poses.end(), '\n'); ++i) text += std::to_string(i) + "\n";
  return text;
}

void use(const Trajectory& trajectory)
{
  for (std::size_t i = 0; i < trajectory.size(); ++i)
  {
    const StampedPose& pose = trajectory[i];
    require(pose.map_T_body.translation.allFinite());
    require(std::abs(pose.map_T_body.rotation.norm() - 1) < 1e-9);
    require(parseSeconds(secondsText(pose.stamp)) == pose.stamp);
    if (i == 0) continue;
    require(trajectory[i - 1].stamp < pose.stamp);
    const auto between = poseAt(trajectory, pose.stamp - 1ns, pose.stamp - trajectory[i - 1].stamp);
    require(between && std::abs(between->rotation.norm() - 1) < 1e-6);
  }
}
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const FuzzFolder folder;
  static const MemoryFile poses(folder, "poses.txt"), times(folder, "poses_times.txt");
  if (size == 0) return 0;
  const std::string rest(data + 1, data + size);
  const std::string text = kBeginnings[data[0] % kBeginnings.size()] + (data[0] & 4 ? wordsOf(rest, kWords) : rest);
  const std::size_t end = std::min(text.find('\0'), text.size());
  const std::string text_of_poses = text.substr(0, end);
  times.holding(end < text.size() ? text.substr(end + 1) : aStampPerLine(text_of_poses));
  mayThrow<std::invalid_argument>([&] { use(readTrajectory(poses.holding(text_of_poses))); });
  return 0;
}
