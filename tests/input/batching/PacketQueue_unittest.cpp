#include "input/batching/internal/PacketQueue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace scanloom::packet_queue_unittest
{
namespace
{
const std::vector<std::uint8_t> kBytes{1, 2, 3};

std::vector<MeasurementBlock> blocksAt(Duration first)
{
  std::vector<MeasurementBlock> blocks(2);
  blocks[0].stamp = Timestamp{first};
  blocks[1].stamp = Timestamp{first + 1ms};
  return blocks;
}
}  // namespace

TEST(PacketQueue, dropsTheOldestPacketWhenItIsFull)
{
  PacketQueue queue(2);
  EXPECT_EQ(queue.push(kBytes, blocksAt(10ms), nullptr), 0u);
  EXPECT_EQ(queue.push(kBytes, blocksAt(20ms), nullptr), 0u);
  queue.pop();
  EXPECT_EQ(queue.push(kBytes, blocksAt(30ms), nullptr), 1u) << "the block that was not taken";
  EXPECT_EQ(queue.front().stamp, Timestamp{20ms});
  EXPECT_EQ(queue.clear(), 4u);
  EXPECT_TRUE(queue.empty());
}

TEST(PacketQueue, aReorderedPacketIsTakenInTimeOrder)
{
  PacketQueue queue(4);
  for (const Duration first : {20ms, 10ms, 30ms}) queue.push(kBytes, blocksAt(first), nullptr);
  std::vector<Timestamp> taken;
  for (; !queue.empty(); queue.pop()) taken.push_back(queue.front().stamp);
  EXPECT_TRUE(std::is_sorted(taken.begin(), taken.end()));
  EXPECT_EQ(taken.size(), 6u);
}
}  // namespace scanloom::packet_queue_unittest
