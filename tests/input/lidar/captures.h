/** Recordings of Ouster sensors for the tests of lidar/. */
#pragma once
#include "base/core/Bytes.h"
#include "input/lidar/OusterDecoder.h"
#include "input/packets/CaptureReader.h"
#include "support/TestData.h"

#include <string>
#include <vector>

namespace scanloom
{
inline const std::string kOusterTests = "ouster/ouster-lidar+ouster-sdk/tests/";
inline const std::string kOusterCaptures = kOusterTests + "pcaps/";

/** The payloads of a capture in the file's order. */
inline std::vector<std::vector<std::uint8_t>> payloadsOf(const std::filesystem::path& capture)
{
  CaptureReader reader(capture);
  std::vector<std::vector<std::uint8_t>> payloads;
  for (Datagram datagram; reader.next(datagram);) payloads.push_back(datagram.payload);
  return payloads;
}

inline OusterDecoder decoderOf(const std::filesystem::path& metadata, const Rigid& body_T_sensor = Rigid::identity())
{
  return OusterDecoder(loadOusterMetadata(metadata.string()), body_T_sensor);
}
}  // namespace scanloom
