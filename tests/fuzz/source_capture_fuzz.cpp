/** Any bytes as a capture file: an exception that says so, or datagrams and a sum of counters that fits. */
#include "source/CaptureReader.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <stdexcept>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const int file = memfd_create("capture", 0);  // a file without a disk
  if (file < 0 || write(file, data, size) != static_cast<ssize_t>(size)) std::abort();
  try
  {
    scanloom::CaptureReader reader("/proc/self/fd/" + std::to_string(file));
    std::uint64_t delivered = 0;
    for (scanloom::Datagram datagram; reader.next(datagram);) ++delivered;
    const scanloom::CaptureCounters c = reader.counters();
    if (c.datagrams != delivered || c.fragments_joined > c.records || c.not_udp + c.malformed + c.cut_short > c.records)
      std::abort();
  }
  catch (const std::runtime_error&)
  {
  }
  close(file);
  return 0;
}
