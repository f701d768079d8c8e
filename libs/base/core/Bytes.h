/** Bytes from outside: little-endian loads that check bounds, never a cast. */
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace scanloom
{
/** A view of bytes (std::span<const std::uint8_t> of C++20). */
class Bytes
{
 public:
  constexpr Bytes() = default;
  constexpr Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  Bytes(const std::vector<std::uint8_t>& bytes) : data_(bytes.data()), size_(bytes.size()) {}  // NOLINT: implicit

  constexpr const std::uint8_t* data() const { return data_; }
  constexpr std::size_t size() const { return size_; }
  constexpr bool empty() const { return size_ == 0; }
  constexpr std::uint8_t operator[](std::size_t i) const { return data_[i]; }
  constexpr const std::uint8_t* begin() const { return data_; }
  constexpr const std::uint8_t* end() const { return data_ + size_; }

  /** `length` bytes from `offset` on. Throws std::out_of_range past the end. */
  Bytes slice(std::size_t offset, std::size_t length) const
  {
    if (offset > size_ || length > size_ - offset) throw std::out_of_range("Bytes: slice past the end");
    return {data_ + offset, length};
  }

 private:
  const std::uint8_t* data_ = nullptr;
  std::size_t size_ = 0;
};

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "load() copies: add the swap for a big-endian machine");

/** The little-endian T at `offset`, which need not be aligned. Throws std::out_of_range past the end. */
template <typename T>
T load(Bytes bytes, std::size_t offset)
{
  static_assert(std::is_arithmetic_v<T>);
  T value;
  std::memcpy(&value, bytes.slice(offset, sizeof(T)).data(), sizeof(T));
  return value;
}

/** An unsigned little-endian integer of `count` bytes, 1 to 8, at `offset`. Throws std::out_of_range past the end. */
inline std::uint64_t loadUnsigned(Bytes bytes, std::size_t offset, std::size_t count)
{
  std::uint64_t value = 0;
  std::memcpy(&value, bytes.slice(offset, count).data(), count);
  return value;
}

/** Writes `value` little-endian at `offset`. Throws std::out_of_range past the end. */
template <typename T>
void store(std::vector<std::uint8_t>& bytes, std::size_t offset, T value)
{
  static_assert(std::is_arithmetic_v<T>);
  std::memcpy(const_cast<std::uint8_t*>(Bytes(bytes).slice(offset, sizeof(T)).data()), &value, sizeof(T));
}
}  // namespace scanloom
