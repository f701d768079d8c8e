#include "input/bags/MessageWriter.h"

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
  return message.bytes();
}

std::vector<std::uint8_t> transformMessage(Timestamp stamp, const std::string& parent, const std::string& child,
                                           const Rigid& parent_T_child)
{
  MessageWriter message;
  message.number(std::uint32_t{1});
  message.header(stamp, parent);
  message.string(child);
  message.vector(parent_T_child.translation);
  message.quaternion(parent_T_child.rotation);
  return message.bytes();
}
}  // namespace scanloom
