/**
 * Any bytes as a pcapng file. The first byte chooses between the rest as the whole file, the rest as blocks (type,
 * length, bytes) whose lengths are sound, and the rest as packets of a sound section of some link type.
 * fuzz options: -max_len=512
 */
#include "readCapture.h"

using namespace scanloom;

namespace
{
constexpr std::uint32_t kSection = 0x0A0D0D0A, kInterface = 1, kSimplePacket = 3, kEnhancedPacket = 6;
constexpr std::uint8_t kBlocks = 0x40;
constexpr std::array<std::uint32_t, 8> kTypes{kSection, kInterface, 2, kSimplePacket, 4, 5, kEnhancedPacket, 0xBAD};

void appendBlock(std::vector<std::uint8_t>& file, std::uint32_t type, std::vector<std::uint8_t> body)
{
  body.resize((body.size() + 3) / 4 * 4);
  const auto length = static_cast<std::uint32_t>(body.size() + 12);
  append32(file, type);
  append32(file, length);
  file.insert(file.end(), body.begin(), body.end());
  append32(file, length);
}

std::vector<std::uint8_t> words(std::initializer_list<std::uint32_t> values)
{
  std::vector<std::uint8_t> bytes;
  for (const std::uint32_t value : values) append32(bytes, value);
  return bytes;
}

/** Blocks of any content, after the header of a section. */
std::vector<std::uint8_t> soundBlocks(Bytes input)
{
  std::vector<std::uint8_t> file;
  appendBlock(file, kSection, words({0x1A2B3C4D, 1, 0xFFFFFFFF, 0xFFFFFFFF}));
  while (input.size() > 1)
  {
    const std::uint32_t type = kTypes[input[0] % kTypes.size()];
    input = input.slice(1, input.size() - 1);
    const Bytes body = takeRecord(input);
    appendBlock(file, type, {body.begin(), body.end()});
  }
  return file;
}

std::vector<std::uint8_t> soundSection(std::uint16_t link_type, Bytes records)
{
  std::vector<std::uint8_t> file;
  appendBlock(file, kSection, words({0x1A2B3C4D, 1, 0xFFFFFFFF, 0xFFFFFFFF}));
  appendBlock(file, kInterface, words({link_type, 4096, 0x00010009, 9, 0}));  // if_tsresol: nanoseconds
  for (std::uint32_t number = 0; !records.empty(); ++number)
  {
    const Bytes record = takeRecord(records);
    const auto length = static_cast<std::uint32_t>(record.size());
    std::vector<std::uint8_t> body =
        number % 8 == 7 ? words({length}) : words({0, number / 4, number * 1'000'000, length, length});
    body.insert(body.end(), record.begin(), record.end());
    appendBlock(file, number % 8 == 7 ? kSimplePacket : kEnhancedPacket, body);
  }
  return file;
}
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  if (size == 0) return 0;
  const Bytes rest(data + 1, size - 1);
  if (data[0] < kLinkTypes.size())
    readCapture(soundSection(kLinkTypes[data[0]], rest));
  else if (data[0] < kBlocks)
    readCapture(soundBlocks(rest));
  else
    readCapture({rest.begin(), rest.end()});
  return 0;
}
