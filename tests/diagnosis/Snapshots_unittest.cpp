#include "diagnosis/internal/RigExamination.h"

#include <gtest/gtest.h>

#include "diagnosis/internal/RigEvidence.h"
#include "support/FakeLidar.h"

namespace scanloom::snapshots_unittest
{
namespace
{
std::vector<RigSnapshot> taken(Duration length)
{
  const FakeLidar lidar;  // 640 blocks a second
  SnapshotTaker taker(1, 100ms);
  std::vector<MeasurementBlock> blocks;
  for (const auto& packet : lidar.drive(Timestamp{0s}, length))
  {
    lidar.readBlocks(packet, blocks);
    taker.add(0, lidar, packet, blocks, blocks.back().stamp);
  }
  return taker.finish();
}
}  // namespace

TEST(SnapshotTaker, takesATurnPerSecondAtFirst)
{
  const auto snapshots = taken(5s);
  ASSERT_EQ(snapshots.size(), 5u);
  for (const RigSnapshot& snapshot : snapshots)
  {
    EXPECT_NEAR(static_cast<double>(snapshot[0].readings), 64 * 3, 8 * 3);  // to the packet
    EXPECT_EQ(snapshot[0].returns, snapshot[0].readings);
  }
}

TEST(SnapshotTaker, keepsAFewHoweverLongItTakes)
{
  for (const Duration length : {13s, 60s, 1000s})
  {
    const std::size_t snapshots = taken(length).size();
    EXPECT_LE(snapshots, 12u);
    EXPECT_GE(snapshots, 6u);
  }
}

TEST(EvenSelection, keepsAFewAlsoWhereNumbersJump)
{
  EvenSelection<int> selection;
  for (std::int64_t number = 0; number < 1000; ++number) selection.at(1024 * number);
  EXPECT_LE(std::move(selection).taken().size(), 12u);
}

TEST(RigExamination, tellsHowFarAwayIsWhatComesBack)
{
  Snapshot snapshot;
  snapshot.readings = 200;
  snapshot.returns = 101;
  snapshot.points.resize(101);
  for (std::uint32_t i = 0; i < 101; ++i) snapshot.points.range[i] = 10'000 - 100 * i;
  RigEvidence evidence;
  evidence.packets_known = false;
  evidence.lidars.resize(1);
  evidence.snapshots = {{snapshot}};

  const auto returns = examine(evidence).lidars[0].returns;
  ASSERT_TRUE(returns);
  EXPECT_NEAR(returns->share, 0.505, 1e-12);
  EXPECT_NEAR(returns->range_p05, 0.5, 1e-9);
  EXPECT_NEAR(returns->range_p50, 5, 1e-9);
  EXPECT_NEAR(returns->range_p95, 9.5, 1e-9);
}
}  // namespace scanloom::snapshots_unittest
