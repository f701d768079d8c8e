/** Checksums of small simulated recordings: any change of their bytes fails this test. */
#include "lab/simulation/internal/ScenePackets.h"
#include "support/TestData.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/config/Configuration.h"

namespace scanloom::golden_unittest
{
namespace
{
/** FNV-1a. Not a CRC: that of a packet together with its own CRC is always the same. */
class Checksum
{
 public:
  void add(const std::uint8_t* bytes, std::size_t count)
  {
    for (std::size_t i = 0; i < count; ++i) value_ = (value_ ^ bytes[i]) * 0x100000001b3;
  }
  std::string text() const { return fmt::format("{:016x}", value_); }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325;
};

/** Of all packets and their times of receipt. */
std::string checksumOf(const char* file)
{
  Configuration configuration =
      Configuration::fromFiles({std::filesystem::path(SCANLOOM_SOURCE_DIR) / "params/simulation" / file});
  configuration.set("simulated_lidars.lidar1_model=OS0-8");
  const Scene scene = makeScene(readSettings<SimulationSettings>(configuration, schemaOf<SimulationSettings>()), 1);
  ScenePackets packets(scene);
  Checksum checksum;
  for (Datagram datagram; packets.time() < scene.span.start + 1s && packets.next(datagram);)
  {
    const auto received = static_cast<std::uint64_t>(nanoseconds(datagram.received));
    checksum.add(reinterpret_cast<const std::uint8_t*>(&received), sizeof received);
    checksum.add(datagram.payload.data(), datagram.payload.size());
  }
  return checksum.text();
}
}  // namespace

/** An intended change of world, machine or sensors changes these: then enter the new values here. */
TEST(Golden, recordingsOfTheFirstSecondHaveTheirChecksums)
{
  EXPECT_EQ(checksumOf("demo.ini"), "eb501f38c9cef736");
  EXPECT_EQ(checksumOf("sparse.ini"), "4352c7a1e3cab350");
  EXPECT_EQ(checksumOf("dense.ini"), "1db6a72626d13a2e");
  EXPECT_EQ(checksumOf("hard.ini"), "6d68dadadb61dd6b");
  EXPECT_EQ(checksumOf("storm.ini"), "3b7a4c7c82550780");
  EXPECT_EQ(checksumOf("short_sight.ini"), "58206197121bdcbf");
}
}  // namespace scanloom::golden_unittest
