/** What both kinds of capture files have in common for a fuzz target. */
#pragma once
#include "MemoryFile.h"
#include "input/packets/CaptureReader.h"

#include <array>
#include <stdexcept>
#include <vector>

namespace scanloom
{
constexpr std::array<std::uint16_t, 8> kLinkTypes{0, 1, 101, 108, 113, 228, 229, 276};

inline void append32(std::vector<std::uint8_t>& file, std::uint32_t value)
{
  const auto* begin = reinterpret_cast<const std::uint8_t*>(&value);
  file.insert(file.end(), begin, begin + 4);
}

/** Takes a length in one byte and as many bytes behind it from the front of `input`; all that is left if it is less. */
inline Bytes takeRecord(Bytes& input)
{
  const std::size_t length = std::min<std::size_t>(input[0], input.size() - 1);
  const Bytes record = input.slice(1, length);
  input = input.slice(1 + length, input.size() - 1 - length);
  return record;
}

/** An exception that says what is wrong with the file, or datagrams and counters that agree. */
inline void readCapture(const std::vector<std::uint8_t>& file)
{
  static const MemoryFile memory;
  mayThrow<std::runtime_error>(
      [&]
      {
        CaptureReader reader(memory.holding(file));
        std::uint64_t delivered = 0;
        for (Datagram datagram; reader.next(datagram);) ++delivered;
        const CaptureCounters c = reader.counters();
        require(c.datagrams == delivered && c.datagrams + c.not_udp + c.malformed + c.cut_short <= c.records);
        require(reader.progress() >= 0 && reader.progress() <= 1);
      });
}
}  // namespace scanloom
