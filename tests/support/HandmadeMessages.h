/** Messages in the serialisation of ROS 1. */
#pragma once
#include "support/HandmadeBag.h"

namespace scanloom
{
struct HandmadePoint
{
  float x = 0, y = 0, z = 0;
  std::uint32_t t = 0;  // ns after the header's stamp
  std::uint8_t ring = 0;
};

inline std::string headerOf(std::uint64_t stamp, const std::string& frame)
{
  return littleEndian(std::uint32_t{0}) + littleEndian(static_cast<std::uint32_t>(stamp / 1'000'000'000)) +
         littleEndian(static_cast<std::uint32_t>(stamp % 1'000'000'000)) + withLength(frame);
}

inline std::string cloudField(const std::string& name, std::uint32_t offset, std::uint8_t type)
{
  return withLength(name) + littleEndian(offset) + littleEndian(type) + littleEndian(std::uint32_t{1});
}

/** sensor_msgs/PointCloud2 as drivers of Ouster write it. */
inline std::string cloudMessage(std::uint64_t stamp, const std::string& frame, const std::vector<HandmadePoint>& points)
{
  std::string data;
  for (const HandmadePoint& p : points)
    data += littleEndian(p.x) + littleEndian(p.y) + littleEndian(p.z) + littleEndian(p.t) + littleEndian(p.ring);
  const auto count = static_cast<std::uint32_t>(points.size());
  constexpr std::uint32_t kStep = 17;
  return headerOf(stamp, frame) + littleEndian(std::uint32_t{1}) + littleEndian(count) +
         littleEndian(std::uint32_t{5}) + cloudField("x", 0, 7) + cloudField("y", 4, 7) + cloudField("z", 8, 7) +
         cloudField("t", 12, 6) + cloudField("ring", 16, 2) + std::string(1, '\0') + littleEndian(kStep) +
         littleEndian(kStep * count) + withLength(data) + std::string(1, '\1');
}

/** tf2_msgs/TFMessage: the child `x` metres ahead of its parent. */
inline std::string transformMessage(const std::string& parent, const std::string& child, double x)
{
  std::string transform;
  for (const double value : {x, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0}) transform += littleEndian(value);
  return littleEndian(std::uint32_t{1}) + headerOf(0, parent) + withLength(child) + transform;
}

/** sensor_msgs/Imu at rest. */
inline std::string imuMessage(std::uint64_t stamp, const std::string& frame)
{
  std::string numbers(36 * sizeof(double), '\0');
  const std::string g = littleEndian(9.81);
  numbers.replace((4 + 9 + 3 + 9 + 2) * sizeof(double), g.size(), g);
  numbers.resize((4 + 9 + 3 + 9 + 3 + 9) * sizeof(double), '\0');
  return headerOf(stamp, frame) + numbers;
}
}  // namespace scanloom
