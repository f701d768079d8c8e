/** Big-endian numbers of network protocols. */
#pragma once
#include "base/core/Bytes.h"

#include <algorithm>
#include <type_traits>

namespace scanloom
{
/** The big-endian T at `offset`. Throws std::out_of_range past the end. */
template <typename T>
T loadBigEndian(Bytes bytes, std::size_t offset)
{
  static_assert(std::is_unsigned_v<T>);
  const Bytes digits = bytes.slice(offset, sizeof(T));
  T value = 0;
  for (const std::uint8_t digit : digits) value = static_cast<T>(value << 8 | digit);
  return value;
}

/** Appends `value`, most significant byte first. */
template <typename T>
void appendBigEndian(std::vector<std::uint8_t>& bytes, T value)
{
  static_assert(std::is_unsigned_v<T>);
  for (std::size_t i = sizeof(T); i-- > 0;) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

/** The bytes after the first `count`. Throws std::out_of_range if there are fewer. */
inline Bytes dropFront(Bytes bytes, std::size_t count)
{
  return bytes.slice(count, bytes.size() - std::min(count, bytes.size()));
}
}  // namespace scanloom
