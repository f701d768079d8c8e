// Turns of recorded packets against what another program made of the same files.
#include <gtest/gtest.h>

#include "../../input/lidar/velodynePackets.h"
#include "input/batching/TimeBatcher.h"
#include "input/packets/CaptureReader.h"
#include "lab/whole_turns/WholeTurns.h"
#include "support/TestData.h"
#include "support/pushPacket.h"

namespace scanloom::turns_of_captures_unittest
{
namespace
{
std::vector<Scan> turnsOf(const std::filesystem::path& capture, std::shared_ptr<const PacketDecoder> decoder)
{
  TimeBatcher batcher({{"lidar", std::move(decoder)}}, {});
  WholeTurns turns(1, TurnGrouping::Nearest);
  std::vector<Scan> scans;
  const auto take = [&](const std::vector<Scan>& by_time)
  {
    for (const Scan& scan : by_time)
      for (Scan& turn : turns.push(scan)) scans.push_back(std::move(turn));
  };
  CaptureReader reader(capture);
  for (Datagram datagram; reader.next(datagram);) take(push(batcher, 0, datagram.payload, datagram.received));
  take(batcher.finish());
  return scans;
}

struct VeloViewFile
{
  const char* name;
  const char* model;
  std::vector<std::size_t> points_of;  // some turns, in their order; the first and the last one are cut
};

/** Of Kitware/VeloView, Testing. */
const VeloViewFile kVeloViewFiles[] = {{"monterey-first-100-packets.pcap", "hdl32e", {49485, 49737, 49778}},
                                       {"vlp-16-test-90deg-1-50-frames.pcap", "vlp16", {13898, 13860}}};
}  // namespace

TEST(TurnsOfCaptures, velodyneTurnsAreThoseOfVeloView)
{
  for (const VeloViewFile& file : kVeloViewFiles)
  {
    SCANLOOM_NEEDS_DATA(capture, std::string("other-lidars/Kitware+VeloView/Testing/Data/") + file.name);
    VelodyneMetadata metadata = velodyneMetadata(file.model);
    metadata.product_id = 0x21;  // the VLP-16 is an early one that says HDL-32E
    const auto turns = turnsOf(capture, makeVelodyne(metadata, Rigid::identity()));

    // VeloView cuts between data blocks, which hold two firing sequences of a VLP-16.
    const std::size_t cut = metadata.model->channels == 16 ? 16 : 0;
    auto turn = turns.begin();
    for (const std::size_t points : file.points_of)
    {
      turn = std::find_if(turn, turns.end(),
                          [&](const Scan& scan)
                          { return scan.points.size() + cut >= points && scan.points.size() <= points + cut; });
      ASSERT_NE(turn, turns.end()) << file.name << ": no turn of " << points << " points";
      ++turn;
    }
  }
}
}  // namespace scanloom::turns_of_captures_unittest
