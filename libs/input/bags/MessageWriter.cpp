#include "input/bags/MessageWriter.h"

#include <algorithm>
#include <cstring>
#include <iterator>

namespace scanloom
{
std::vector<std::uint8_t> imuMessage(const ImuSample& sample, const std::string& frame)
{
  const auto covariance = [](MessageWriter& message, double first)
  {
    for (int i = 0; i < 9; ++i) message.number(i == 0 ? first : 0.0);
  };
  constexpr double kNoOrientation = -1, kUnknown = 0;
  MessageWriter message;
  message.header(sample.stamp, frame);
  message.quaternion(Eigen::Quaterniond::Identity());
  covariance(message, kNoOrientation);
  message.vector(sample.gyro);
  covariance(message, kUnknown);
  message.vector(sample.accel);
  covariance(message, kUnknown);
  return std::move(message).bytes();
}

std::vector<std::uint8_t> transformsMessage(const std::vector<StampedTransform>& transforms)
{
  MessageWriter message;
  message.number(static_cast<std::uint32_t>(transforms.size()));
  for (const StampedTransform& transform : transforms)
  {
    message.header(transform.stamp, transform.parent);
    message.string(transform.child);
    message.vector(transform.parent_T_child.translation);
    message.quaternion(transform.parent_T_child.rotation);
  }
  return std::move(message).bytes();
}

std::vector<std::uint8_t> cloudMessage(const PointCloud& points, Timestamp stamp, const std::string& frame,
                                       const std::optional<Rigid>& frame_T_points)
{
  struct Field
  {
    const char* name;
    std::uint32_t offset;
    std::uint8_t type;  // of sensor_msgs/PointField
  };
  constexpr Field kFields[] = {{"x", 0, 7},  {"y", 4, 7},     {"z", 8, 7},     {"intensity", 12, 7},
                               {"t", 16, 6}, {"ring", 20, 4}, {"lidar", 22, 2}};
  constexpr std::uint32_t kStep = 24;
  MessageWriter message;
  message.header(stamp, frame);
  message.number(std::uint32_t{1});
  message.number(static_cast<std::uint32_t>(points.size()));
  message.number(static_cast<std::uint32_t>(std::size(kFields)));
  for (const Field& field : kFields)
  {
    message.string(field.name);
    message.number(field.offset);
    message.number(field.type);
    message.number(std::uint32_t{1});
  }
  message.number(std::uint8_t{0});  // little endian
  message.number(kStep);
  message.number(static_cast<std::uint32_t>(points.size() * kStep));
  message.number(static_cast<std::uint32_t>(points.size() * kStep));  // length of the sequence
  std::uint8_t* point = message.room(points.size() * kStep);
  for (std::size_t i = 0; i < points.size(); ++i, point += kStep)
  {
    Eigen::Vector3f position = points.position(i);
    if (frame_T_points) position = (*frame_T_points * position.cast<double>()).cast<float>();
    const auto intensity = static_cast<float>(points.intensity[i]);
    const auto t = static_cast<std::uint32_t>(std::max(points.t[i], 0));
    const std::uint16_t ring = points.ring[i];
    std::memcpy(point, position.data(), 12);
    std::memcpy(point + 12, &intensity, 4);
    std::memcpy(point + 16, &t, 4);
    std::memcpy(point + 20, &ring, 2);
    point[22] = points.sensor_id[i];
  }
  message.number(std::uint8_t{1});  // no point without coordinates
  return std::move(message).bytes();
}

std::vector<std::uint8_t> odometryMessage(const BodyMotion& motion)
{
  MessageWriter message;
  message.header(motion.stamp, motion.frame);
  message.string(motion.body);
  message.vector(motion.frame_T_body.translation);
  message.quaternion(motion.frame_T_body.rotation);
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 6; ++column) message.number(motion.covariance(row, column));
  message.vector(motion.velocity);
  message.vector(motion.turn_rate);
  for (int i = 0; i < 36; ++i) message.number(0.0);
  return std::move(message).bytes();
}

std::vector<std::uint8_t> diagnosticsMessage(Timestamp stamp, const std::vector<DiagnosticStatus>& all)
{
  MessageWriter message;
  message.header(stamp, "");
  message.number(static_cast<std::uint32_t>(all.size()));
  for (const DiagnosticStatus& status : all)
  {
    message.number(static_cast<std::uint8_t>(status.level));
    for (const std::string& text : {status.name, status.message, status.hardware}) message.string(text);
    message.number(static_cast<std::uint32_t>(status.values.size()));
    for (const auto& [key, value] : status.values)
    {
      message.string(key);
      message.string(value);
    }
  }
  return std::move(message).bytes();
}
}  // namespace scanloom
