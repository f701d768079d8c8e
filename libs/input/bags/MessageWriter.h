/** Messages of ROS 2 as bytes. */
#pragma once
#include "base/core/ImuSample.h"
#include "base/core/PointCloud.h"
#include "base/core/Rigid.h"
#include "base/core/Time.h"

#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
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

  /** Bytes at the end, all 0, to be written before the next call. */
  std::uint8_t* room(std::size_t count)
  {
    bytes_.resize(bytes_.size() + count);
    return bytes_.data() + bytes_.size() - count;
  }

  const std::vector<std::uint8_t>& bytes() const& { return bytes_; }
  std::vector<std::uint8_t> bytes() && { return std::move(bytes_); }

 private:
  static constexpr std::size_t kEncapsulation = 4;
  std::vector<std::uint8_t> bytes_{0, 1, 0, 0};
};

/** sensor_msgs/Imu without an orientation. */
std::vector<std::uint8_t> imuMessage(const ImuSample&, const std::string& frame);

/** A transform of tf2_msgs/TFMessage: where one frame is in another. */
struct StampedTransform
{
  Timestamp stamp;
  std::string parent, child;
  Rigid parent_T_child;
};

/** tf2_msgs/TFMessage. */
std::vector<std::uint8_t> transformsMessage(const std::vector<StampedTransform>&);

/**
 * sensor_msgs/PointCloud2 of the points in the frame of this name, into which `frame_T_points` moves them, stamped with
 * their owner's stamp: x, y, z (m), intensity, t (uint32, ns after the stamp), ring (uint16), lidar (uint8, the
 * sensor_id).
 */
std::vector<std::uint8_t> cloudMessage(const PointCloud&, Timestamp, const std::string& frame,
                                       const std::optional<Rigid>& frame_T_points = std::nullopt);

/** What nav_msgs/Odometry tells of a body. */
struct BodyMotion
{
  Timestamp stamp;
  std::string frame, body;  // names of frames
  Rigid frame_T_body;
  Matrix6d covariance = Matrix6d::Zero();               // translation, rotation; about the axes of `frame`
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();   // m/s, of the body's origin, along the body's axes
  Eigen::Vector3d turn_rate = Eigen::Vector3d::Zero();  // rad/s, about the body's axes
};

/** nav_msgs/Odometry; the covariance of its twist is 0: not known. */
std::vector<std::uint8_t> odometryMessage(const BodyMotion&);

/** diagnostic_msgs/DiagnosticStatus. */
struct DiagnosticStatus
{
  enum class Level : std::uint8_t
  {
    Ok,
    Warning,
    Error,
    Stale,
  };

  Level level = Level::Ok;
  std::string name, message, hardware;
  std::vector<std::pair<std::string, std::string>> values;
};

/** diagnostic_msgs/DiagnosticArray. */
std::vector<std::uint8_t> diagnosticsMessage(Timestamp, const std::vector<DiagnosticStatus>&);
}  // namespace scanloom
