#include "input/bags/internal/MessageReader.h"

#include <stdexcept>

namespace scanloom
{
namespace
{
constexpr std::size_t kEncapsulation = 4;  // bytes before CDR: two that name the kind, two of options
}

MessageReader::MessageReader(Bytes message, Serialisation serialisation) : body_(message), serialisation_(serialisation)
{
  if (serialisation == Serialisation::Unknown)
    throw std::invalid_argument("a message in a serialisation other than CDR (ROS 2) and that of ROS 1");
  if (serialisation == Serialisation::Ros1) return;
  const Bytes kind = message.slice(0, kEncapsulation);
  if (kind[0] != 0 || kind[1] > 1)
    throw std::invalid_argument("a message in another form of CDR than plain CDR 1: record it with a usual ROS 2");
  big_endian_ = kind[1] == 0;
  body_ = message.slice(kEncapsulation, message.size() - kEncapsulation);
}

std::string MessageReader::string()
{
  const auto length = number<std::uint32_t>();
  const Bytes text = bytes(length);
  const bool has_zero = serialisation_ == Serialisation::Cdr && length > 0;  // it is counted in
  return {text.begin(), text.end() - (has_zero ? 1 : 0)};
}

Timestamp MessageReader::time()
{
  const auto seconds = serialisation_ == Serialisation::Cdr ? std::int64_t{number<std::int32_t>()}
                                                            : std::int64_t{number<std::uint32_t>()};
  return Timestamp{std::chrono::seconds{seconds} + Duration{number<std::uint32_t>()}};
}

MessageHeader MessageReader::header()
{
  if (serialisation_ == Serialisation::Ros1) number<std::uint32_t>();  // a running number
  const Timestamp stamp = time();
  return {stamp, string()};
}

Bytes MessageReader::bytes(std::size_t count)
{
  const Bytes found = body_.slice(at_, count);
  at_ += count;
  return found;
}

std::size_t MessageReader::count(std::size_t least_bytes)
{
  const auto count = number<std::uint32_t>();
  if (count > (body_.size() - at_) / least_bytes) throw std::out_of_range("MessageReader: sequence past the end");
  return count;
}
}  // namespace scanloom
