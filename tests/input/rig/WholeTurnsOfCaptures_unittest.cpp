// Turns of recorded packets against what another program made of the same files.
#include <gtest/gtest.h>

#include "input/lidar/velodynePackets.h"
#include "input/packets/CaptureReader.h"
#include "input/whole_turns/WholeTurns.h"
#include "support/TestData.h"
#include "support/pushPacket.h"

namespace scanloom::whole_turns_of_captures_unittest
{
namespace
{
std::vector<Scan> turnsOf(const std::filesystem::path& capture, std::shared_ptr<const PacketDecoder> decoder,
                          LidarCounters& counters)
{
  WholeTurns batcher({{"lidar", std::move(decoder)}});
  std::vector<Scan> turns;
  CaptureReader reader(capture);
  for (Datagram datagram; reader.next(datagram);)
    for (Scan& turn : push(batcher, 0, datagram.payload, datagram.received)) turns.push_back(std::move(turn));
  for (Scan& turn : batcher.finish()) turns.push_back(std::move(turn));
  counters = batcher.counters(0);
  return turns;
}

struct VeloViewFile
{
  const char* name;
  const char* model;
  std::size_t turns;
  std::vector<std::pair<std::size_t, std::size_t>> points_of;  // turn, points
};

/** Of Kitware/VeloView, Testing. */
const VeloViewFile kVeloViewFiles[] = {
    {"monterey-first-100-packets.pcap", "hdl32e", 19, {{0, 27649}, {2, 49485}, {8, 49737}, {11, 49778}, {18, 396}}},
    {"vlp-16-test-90deg-1-50-frames.pcap", "vlp16", 52, {{0, 5736}, {2, 13898}, {16, 13860}, {51, 274}}}};
}  // namespace

TEST(WholeTurnsOfCaptures, velodyneTurnsAreThoseOfVeloView)
{
  for (const VeloViewFile& file : kVeloViewFiles)
  {
    SCANLOOM_NEEDS_DATA(capture, std::string("other-lidars/Kitware+VeloView/Testing/Data/") + file.name);
    VelodyneMetadata metadata = velodyneMetadata(file.model);
    metadata.product_id = 0x21;  // the VLP-16 is an early one that says HDL-32E
    LidarCounters counters;
    const auto turns = turnsOf(capture, std::make_shared<VelodyneDecoder>(metadata, Rigid::identity()), counters);

    EXPECT_EQ(turns.size(), file.turns) << file.name;
    for (const auto& [turn, points] : file.points_of)
    {
      // VeloView cuts between data blocks, which hold two firing sequences of a VLP-16.
      const double cut = metadata.model->channels == 16 ? 16 : 0;
      EXPECT_NEAR(static_cast<double>(turns.at(turn).points.size()), static_cast<double>(points), cut)
          << file.name << " turn " << turn;
    }
    EXPECT_EQ(counters.received, counters.emitted + counters.invalid + counters.late + counters.dropped);
    EXPECT_EQ(counters.lost, 0u) << file.name;
  }
}
}  // namespace scanloom::whole_turns_of_captures_unittest
