/**
 * Any bytes as a pcap file. The first byte chooses between the rest as the whole file, and the rest as records (length,
 * bytes) of a sound file of some link type, so that the layers behind libpcap are reached without a corpus.
 * fuzz options: -max_len=512
 */
#include "readCapture.h"

using namespace scanloom;

namespace
{
std::vector<std::uint8_t> soundFile(std::uint32_t link_type, Bytes records)
{
  std::vector<std::uint8_t> file;
  for (const std::uint32_t word : {0xa1b23c4du, 0x00040002u, 0u, 0u, 4096u, link_type}) append32(file, word);
  for (std::uint32_t number = 0; !records.empty(); ++number)
  {
    const Bytes record = takeRecord(records);
    append32(file, number / 16);  // some of the fragments expire
    append32(file, number % 16);
    append32(file, static_cast<std::uint32_t>(record.size()));
    append32(file, static_cast<std::uint32_t>(record.size()));
    file.insert(file.end(), record.begin(), record.end());
  }
  return file;
}
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  if (size == 0) return 0;
  const Bytes rest(data + 1, size - 1);
  readCapture(data[0] < kLinkTypes.size() ? soundFile(kLinkTypes[data[0]], rest)
                                          : std::vector<std::uint8_t>(rest.begin(), rest.end()));
  return 0;
}
