/** Messages of ROS 2 as bytes. */
#pragma once
#include "base/core/ImuSample.h"
#include "base/core/Rigid.h"
#include "base/core/Time.h"

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace scanloom
{
/** A message of ROS 2, field after field: CDR 1, little endian. What MessageReader reads. */
class MessageWriter
{
 public:
  template <typename Number>
  void number(Number value)
  {
    static_assert(std::is_arithmetic_v<Number>);
    while ((bytes_.size() - kEncapsulation) % sizeof(Number) != 0) bytes_.push_back(0);
    const auto* begin = reinterpret_cast<const std::uint8_t*>(&value);
    bytes_.insert(bytes_.end(), begin, begin + sizeof(Number));
  }

  void string(const std::string& text)
  {
    number(static_cast<std::uint32_t>(text.size() + 1));
    bytes_.insert(bytes_.end(), text.begin(), text.end());
    bytes_.push_back(0);
  }

  void byteSequence(const std::vector<std::uint8_t>& sequence)
  {
    number(static_cast<std::uint32_t>(sequence.size()));
    bytes_.insert(bytes_.end(), sequence.begin(), sequence.end());
  }

  /** uint8[N] */
  void byteArray(const std::vector<std::uint8_t>& array) { bytes_.insert(bytes_.end(), array.begin(), array.end()); }

  void time(Timestamp stamp)
  {
    const std::int64_t ns = nanoseconds(stamp);
    number(static_cast<std::int32_t>(ns / 1'000'000'000));
    number(static_cast<std::uint32_t>(ns % 1'000'000'000));
  }

  void header(Timestamp stamp, const std::string& frame)
  {
    time(stamp);
    string(frame);
  }

  void vector(const Eigen::Vector3d& v)
  {
    for (const double value : v) number(value);
  }

  void quaternion(const Eigen::Quaterniond& q)
  {
    for (const double value : {q.x(), q.y(), q.z(), q.w()}) number(value);
  }

  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  static constexpr std::size_t kEncapsulation = 4;
  std::vector<std::uint8_t> bytes_{0, 1, 0, 0};
};

/** sensor_msgs/Imu without an orientation. */
std::vector<std::uint8_t> imuMessage(const ImuSample&, const std::string& frame);

/** tf2_msgs/TFMessage of one transform. */
std::vector<std::uint8_t> transformMessage(Timestamp, const std::string& parent, const std::string& child,
                                           const Rigid& parent_T_child);
}  // namespace scanloom
