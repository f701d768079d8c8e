#include "base/core/BoundedQueue.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>

namespace scanloom::bounded_queue_unittest
{
namespace
{
TEST(BoundedQueue, givesEverythingInOrderFromOneThreadToAnother)
{
  BoundedQueue<int> queue(3);
  std::thread maker(
      [&]
      {
        for (int i = 0; i < 1000; ++i) queue.push(i);
        queue.end();
      });
  int expected = 0;
  while (const auto value = queue.pop()) ASSERT_EQ(*value, expected++);
  maker.join();

  EXPECT_EQ(expected, 1000);
  EXPECT_TRUE(queue.ended());
}

TEST(BoundedQueue, letsWhoeverPushesWaitUntilThereIsRoomForTheNext)
{
  BoundedQueue<int> queue(2);
  std::atomic<int> pushed = 0;
  std::thread maker(
      [&]
      {
        for (int i = 0; i < 4; ++i, ++pushed) queue.push(i);
      });
  std::this_thread::sleep_for(50ms);
  EXPECT_EQ(pushed, 1) << "the second one is in the queue and waits";
  EXPECT_EQ(queue.waiting(), 2u);

  for (int i = 0; i < 4; ++i) EXPECT_EQ(queue.pop(), i);
  maker.join();
  EXPECT_EQ(queue.dropped(), 0u);
}

TEST(BoundedQueue, dropsTheOldestOfAKindThatIsFullAndNoOther)
{
  BoundedQueue<std::string> queue({2, 100}, [](const std::string& s) { return s[0] == 'a' ? 0 : 1; });
  for (const char* value : {"a0", "b0", "a1", "b1", "a2", "b2", "a3", "b3"}) queue.pushDroppingOldest(value);
  EXPECT_EQ(queue.waiting(0), 2u);
  EXPECT_EQ(queue.waiting(1), 4u);
  EXPECT_EQ(queue.dropped(0), 2u);
  EXPECT_EQ(queue.dropped(1), 0u);
  queue.end();

  for (const char* value : {"b0", "b1", "a2", "b2", "a3", "b3"}) EXPECT_EQ(queue.pop(), value);
  EXPECT_FALSE(queue.pop());
}

TEST(BoundedQueue, wakesWhoeverWaitsForAValue)
{
  BoundedQueue<int> queue(3);
  std::thread maker([&] { queue.pushDroppingOldest(1); });
  EXPECT_EQ(queue.pop(10s), 1);
  maker.join();
}

TEST(BoundedQueue, givesNothingWhereNothingComesInTime)
{
  BoundedQueue<int> queue(3);
  EXPECT_FALSE(queue.pop(1ms));
  EXPECT_FALSE(queue.ended());
}

TEST(BoundedQueue, throwsWhatEndedItOnceAndAfterAllElse)
{
  BoundedQueue<int> queue(3);
  queue.push(1);
  queue.end(std::make_exception_ptr(std::runtime_error("clocks")));
  EXPECT_TRUE(queue.pop(0s));
  EXPECT_FALSE(queue.ended());
  EXPECT_THROW(queue.pop(0s), std::runtime_error);
  EXPECT_TRUE(queue.ended());
  EXPECT_FALSE(queue.pop(0s));
}

TEST(BoundedQueue, letsWhoeverPushesGoOnWhenNobodyPopsAnyMore)
{
  BoundedQueue<int> queue(1);
  std::atomic<bool> wanted = true;
  std::thread maker([&] { wanted = queue.push(1); });
  queue.close();
  maker.join();
  EXPECT_FALSE(wanted);
  EXPECT_FALSE(queue.push(2));
}
}  // namespace
}  // namespace scanloom::bounded_queue_unittest
