#include "cloud/Lzf.h"

#include <stdexcept>

namespace scanloom
{
namespace
{
constexpr std::size_t kLongestCopy = 264;  // by three bytes

struct Reader
{
  Bytes bytes;
  std::size_t at = 0;

  bool atEnd() const { return at == bytes.size(); }
  std::size_t next() { return load<std::uint8_t>(bytes, at++); }
  Bytes next(std::size_t count)
  {
    at += count;
    return bytes.slice(at - count, count);
  }
};

void copyBack(std::vector<std::uint8_t>& unpacked, std::size_t distance, std::size_t count)
{
  if (distance > unpacked.size()) throw std::invalid_argument("its compressed data is damaged");
  // Byte by byte: the copy may overlap what it writes, so that it repeats itself.
  for (; count > 0; --count) unpacked.push_back(unpacked[unpacked.size() - distance]);
}

void unpackNext(Reader& packed, std::vector<std::uint8_t>& unpacked)
{
  const std::size_t control = packed.next();
  if (control < 32)
  {
    const Bytes literal = packed.next(control + 1);
    unpacked.insert(unpacked.end(), literal.begin(), literal.end());
    return;
  }
  std::size_t count = control >> 5;
  if (count == 7) count += packed.next();
  copyBack(unpacked, ((control & 31) << 8) + packed.next() + 1, count + 2);
}
}  // namespace

std::vector<std::uint8_t> unpackLzf(Bytes packed, std::size_t size)
{
  if (size / kLongestCopy > packed.size()) throw std::invalid_argument("its compressed data cannot hold all points");
  std::vector<std::uint8_t> unpacked;
  unpacked.reserve(size);
  try
  {
    for (Reader reader{packed}; !reader.atEnd() && unpacked.size() <= size;) unpackNext(reader, unpacked);
  }
  catch (const std::out_of_range&)
  {
    throw std::invalid_argument("its compressed data is cut short");
  }
  if (unpacked.size() != size) throw std::invalid_argument("its compressed data has another size than its points");
  return unpacked;
}
}  // namespace scanloom
