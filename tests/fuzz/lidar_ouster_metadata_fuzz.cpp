/** Any text as a metadata file: a decoder that works, or std::invalid_argument. */
#include <stdexcept>
#include <string>

#include "lidar/OusterDecoder.h"

using namespace scanloom;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  try
  {
    const OusterMetadata metadata = parseOusterMetadata({reinterpret_cast<const char*>(data), size}, "fuzz.json");
    const OusterDecoder decoder(metadata, Rigid::identity());
    if (toJson(decoder.metadata()) != toJson(metadata)) __builtin_trap();
  }
  catch (const std::invalid_argument&)
  {
  }
  return 0;
}
