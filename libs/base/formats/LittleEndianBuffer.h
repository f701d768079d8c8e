#pragma once
#include "base/core/Bytes.h"

#include <cstdint>
#include <ostream>
#include <vector>

namespace scanloom
{
/** Numbers one after another in little-endian order, on their way into a binary file. */
class LittleEndianBuffer
{
 public:
  template <typename T>
  void put(T value)
  {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof value);
    store(bytes_, at, value);
  }

  /** Writes what was put since the last call. */
  void writeTo(std::ostream& file)
  {
    file.write(reinterpret_cast<const char*>(bytes_.data()), static_cast<std::streamsize>(bytes_.size()));
    bytes_.clear();
  }

 private:
  std::vector<std::uint8_t> bytes_;
};
}  // namespace scanloom
