/** The fields of a serialised ROS message, one after another. */
#pragma once
#include "base/core/Bytes.h"
#include "base/core/Time.h"

#include <string>
#include <type_traits>

namespace scanloom
{
enum class Serialisation
{
  Cdr,      // ROS 2: OMG CDR 1, either byte order; numbers are aligned to their size
  Ros1,     // little endian, without alignment
  Unknown,  // JSON, Protobuf, ...: can't be read
};

/** std_msgs/Header. */
struct MessageHeader
{
  Timestamp stamp;
  std::string frame;
};

/**
 * Each call reads the next field. Throws std::out_of_range past the message's end, and std::invalid_argument for a
 * serialisation that can't be read.
 */
class MessageReader
{
 public:
  /** The bytes must outlive the reader. */
  MessageReader(Bytes message, Serialisation);

  template <typename Number>
  Number number();

  bool boolean() { return number<std::uint8_t>() != 0; }
  std::string string();
  Timestamp time();
  MessageHeader header();

  /** uint8[count], as a view of the message. */
  Bytes bytes(std::size_t count);

  /** All that is left. */
  Bytes rest() { return bytes(body_.size() - at_); }

  /** uint8[], as a view of the message. */
  Bytes byteSequence() { return bytes(number<std::uint32_t>()); }

  /** The length of a sequence whose elements take `least_bytes` or more: none that the message cannot hold. */
  std::size_t count(std::size_t least_bytes);

  Serialisation serialisation() const { return serialisation_; }
  bool atEnd() const { return at_ >= body_.size(); }

 private:
  Bytes body_;  // alignment counts from its beginning
  Serialisation serialisation_;
  bool big_endian_ = false;
  std::size_t at_ = 0;
};

template <typename Number>
Number MessageReader::number()
{
  static_assert(std::is_arithmetic_v<Number>);
  if (serialisation_ == Serialisation::Cdr) at_ = (at_ + sizeof(Number) - 1) / sizeof(Number) * sizeof(Number);
  std::uint8_t bytes[sizeof(Number)];
  const Bytes found = body_.slice(at_, sizeof(Number));
  for (std::size_t i = 0; i < sizeof(Number); ++i) bytes[i] = found[big_endian_ ? sizeof(Number) - 1 - i : i];
  at_ += sizeof(Number);
  return load<Number>({bytes, sizeof(Number)}, 0);
}
}  // namespace scanloom
