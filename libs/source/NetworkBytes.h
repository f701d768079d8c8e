/** Bytes as network protocols write them: header after header, numbers with the most significant byte first. */
#pragma once
#include "core/Bytes.h"

#include <algorithm>
#include <type_traits>

namespace scanloom
{
/** The big-endian T at `offset`; throws std::out_of_range past the end. */
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

/** What follows the first `count` bytes; throws std::out_of_range if there are fewer. */
inline Bytes dropFront(Bytes bytes, std::size_t count)
{
  return bytes.slice(count, bytes.size() - std::min(count, bytes.size()));
}
}  // namespace scanloom
