#include "mrpt/sensors/internal/ObservationFeed.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationComment.h>

#include <atomic>
#include <chrono>
#include <stdexcept>

namespace scanloom::observation_feed_unittest
{
namespace
{
using namespace std::chrono_literals;

mrpt::obs::CObservation::Ptr numbered(int i)
{
  auto comment = mrpt::obs::CObservationComment::Create();
  comment->text = std::to_string(i);
  return comment;
}

std::string textOf(const mrpt::obs::CObservation::Ptr& observation)
{
  return std::dynamic_pointer_cast<mrpt::obs::CObservationComment>(observation)->text;
}

/** As doProcess does: asks again and again. */
mrpt::obs::CObservation::Ptr takeSoon(ObservationFeed& feed)
{
  for (int i = 0; i < 5000; i++)
  {
    if (auto observation = feed.take()) return observation;
    if (feed.ended()) return nullptr;
    std::this_thread::sleep_for(1ms);
  }
  return nullptr;
}
}  // namespace

TEST(ObservationFeed, givesEverythingInOrderThenEnds)
{
  int made = 0;
  ObservationFeed feed([&]() -> mrpt::obs::CObservation::Ptr { return made < 100 ? numbered(made++) : nullptr; }, 8);

  for (int i = 0; i < 100; i++)
  {
    const auto observation = takeSoon(feed);
    ASSERT_TRUE(observation);
    EXPECT_EQ(textOf(observation), std::to_string(i));
  }
  EXPECT_FALSE(takeSoon(feed));
  EXPECT_TRUE(feed.ended());
}

TEST(ObservationFeed, restsWhenNobodyTakes)
{
  std::atomic<int> made = 0;
  ObservationFeed feed([&] { return numbered(made++); }, 8);

  std::this_thread::sleep_for(50ms);

  EXPECT_LE(made, 9) << "the queue, and the one in hand";
  EXPECT_EQ(textOf(takeSoon(feed)), "0") << "and nothing is dropped";
}

TEST(ObservationFeed, throwsWhatTheSourceThrewOnceTheRestIsTaken)
{
  int made = 0;
  ObservationFeed feed(
      [&]
      {
        if (made == 2) throw std::runtime_error("cable pulled");
        return numbered(made++);
      },
      8);

  EXPECT_EQ(textOf(takeSoon(feed)), "0");
  EXPECT_EQ(textOf(takeSoon(feed)), "1");
  EXPECT_THROW(takeSoon(feed), std::runtime_error);
}

TEST(ObservationFeed, stopsWithInputLeft)
{
  ObservationFeed feed([] { return numbered(0); }, 2);
  SUCCEED() << "the destructor returns";
}
}  // namespace scanloom::observation_feed_unittest
