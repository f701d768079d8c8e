/**
 * Any bytes as a capture: an exception that says so, or datagrams and counters that agree. The first byte chooses
 * between the whole rest as the file, and the rest as records (length, bytes) of a sound file of some link type, so
 * that the layers behind libpcap are reached without a corpus.
 */
#include "source/CaptureReader.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <stdexcept>

namespace
{
constexpr std::array<std::uint32_t, 8> kLinkTypes{0, 1, 101, 108, 113, 228, 229, 276};

void append32(std::vector<std::uint8_t>& file, std::uint32_t value)
{
  const auto* begin = reinterpret_cast<const std::uint8_t*>(&value);
  file.insert(file.end(), begin, begin + 4);
}

std::vector<std::uint8_t> soundFile(std::uint32_t link_type, scanloom::Bytes records)
{
  std::vector<std::uint8_t> file;
  for (const std::uint32_t word : {0xa1b23c4du, 0x00040002u, 0u, 0u, 262144u, link_type}) append32(file, word);
  for (std::uint32_t number = 0; records.size() > 1; ++number)
  {
    const std::size_t length = std::min<std::size_t>(records[0], records.size() - 1);
    append32(file, number / 16);  // some of the fragments expire
    append32(file, number % 16);
    append32(file, static_cast<std::uint32_t>(length));
    append32(file, static_cast<std::uint32_t>(length));
    file.insert(file.end(), records.begin() + 1, records.begin() + 1 + length);
    records = records.slice(1 + length, records.size() - 1 - length);
  }
  return file;
}

void read(const std::string& path)
{
  scanloom::CaptureReader reader(path);
  std::uint64_t delivered = 0;
  for (scanloom::Datagram datagram; reader.next(datagram);) ++delivered;
  const scanloom::CaptureCounters c = reader.counters();
  if (c.datagrams != delivered || c.datagrams + c.not_udp + c.malformed + c.cut_short > c.records) std::abort();
}
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  if (size == 0) return 0;
  const scanloom::Bytes rest(data + 1, size - 1);
  const std::vector<std::uint8_t> bytes = data[0] < kLinkTypes.size()
                                              ? soundFile(kLinkTypes[data[0]], rest)
                                              : std::vector<std::uint8_t>(rest.begin(), rest.end());

  const int file = memfd_create("capture", 0);  // a file without a disk
  if (file < 0 || write(file, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) std::abort();
  try
  {
    read("/proc/self/fd/" + std::to_string(file));
  }
  catch (const std::runtime_error&)
  {
  }
  close(file);
  return 0;
}
