#include "input/packets/internal/DatagramRing.h"

#include <gtest/gtest.h>

#include <cstring>
#include <thread>

namespace scanloom::datagram_ring_unittest
{
TEST(DatagramRing, givesInTheOrderOfPushAndHasNoMoreSlotsThanWereAskedFor)
{
  DatagramRing ring(3, 16);
  for (std::uint16_t i = 0; i < 3; ++i)
  {
    DatagramRing::Slot* slot = ring.takeEmpty();
    ASSERT_NE(slot, nullptr);
    slot->source_port = i;
    ring.push(slot);
  }
  EXPECT_EQ(ring.takeEmpty(), nullptr);
  EXPECT_EQ(ring.waiting(), 3u);

  for (std::uint16_t i = 0; i < 3; ++i)
  {
    ASSERT_NE(ring.front(), nullptr);
    EXPECT_EQ(ring.front()->source_port, i);
    ring.pop();
  }
  EXPECT_EQ(ring.front(), nullptr);
  EXPECT_NE(ring.takeEmpty(), nullptr);
}

TEST(DatagramRing, fillsTheSlotAgainThatWasFreedLast)
{
  DatagramRing ring(1000, 16);
  const DatagramRing::Slot* first = nullptr;
  for (int i = 0; i < 5000; ++i)
  {
    DatagramRing::Slot* slot = ring.takeEmpty();
    if (!first) first = slot;
    EXPECT_EQ(slot, first) << "one that waits at a time needs the memory of one";
    ring.push(slot);
    ring.pop();
  }
}

TEST(DatagramRing, passesEveryDatagramFromThreadToThread)
{
  constexpr std::uint32_t kCount = 200'000;
  DatagramRing ring(64, sizeof(std::uint32_t));
  std::thread receiver(
      [&ring]
      {
        for (std::uint32_t i = 0; i < kCount;)
        {
          DatagramRing::Slot* slot = ring.takeEmpty();
          if (!slot)
          {
            std::this_thread::yield();
            continue;
          }
          std::memcpy(slot->bytes, &i, sizeof i);
          slot->size = i++;
          ring.push(slot);
        }
      });
  std::uint32_t wrong = 0;
  for (std::uint32_t expected = 0; expected < kCount;)
  {
    const DatagramRing::Slot* slot = ring.front();
    if (!slot)
    {
      std::this_thread::yield();
      continue;
    }
    std::uint32_t written = 0;
    std::memcpy(&written, slot->bytes, sizeof written);
    wrong += written != expected || slot->size != expected;
    ++expected;
    ring.pop();
  }
  receiver.join();
  EXPECT_EQ(wrong, 0u);
}

TEST(DatagramRing, refusesToHaveNoRoom)
{
  EXPECT_THROW(DatagramRing(0, 16), std::invalid_argument);
  EXPECT_THROW(DatagramRing(16, 0), std::invalid_argument);
}
}  // namespace scanloom::datagram_ring_unittest
