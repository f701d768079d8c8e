#include "live_view/LiveFeed.h"

#include "live_view/ViewStatusJson.h"

#include <gmock/gmock.h>

#include <thread>

namespace scanloom
{
namespace
{
StateEstimate estimateAt(double x, Timestamp stamp)
{
  StateEstimate estimate;
  estimate.stamp = stamp;
  estimate.map_T_body.translation.x() = x;
  return estimate;
}

/** A second scan of the same lidars; `heard` of them send. */
Scan scanOf(int number, std::size_t heard)
{
  Scan scan;
  scan.start = fromNanoseconds(100000000LL * number);
  scan.period = 100ms;
  for (std::size_t lidar = 0; lidar < heard; ++lidar)
    scan.columns.push_back({scan.start, 0, 0, 0, 0, static_cast<std::uint8_t>(lidar)});
  return scan;
}

RecordingHeader twoLidars()
{
  RecordingHeader header;
  header.lidars.resize(2);
  header.lidars[0].name = "left";
  header.lidars[1].name = "right";
  return header;
}
}  // namespace

TEST(LiveFeed, neverWaitsForThoseWhoShow)
{
  LiveExchange exchange;
  LiveFeed feed(exchange, {"slam", true, true});
  const std::lock_guard held_by_a_page(exchange.mutex);
  const auto begin = LiveFeed::Clock::now();
  for (int i = 0; i < 1000; ++i)
  {
    feed.add(estimateAt(i, fromNanoseconds(i)));
    feed.offer(begin + i * 60ms);
  }
  EXPECT_LT(LiveFeed::Clock::now() - begin, 1s);
}

TEST(LiveFeed, keepsABoundedNumberOfKeyframesForAPageThatDoesNotTakeThem)
{
  LiveExchange exchange;
  LiveFeed feed(exchange, {"slam", true, true});
  for (int i = 0; i < 100; ++i)
  {
    StateEstimate estimate = estimateAt(i, fromNanoseconds(i));
    estimate.keyframe.emplace();
    feed.add(estimate);
    feed.offer(LiveFeed::Clock::now() + i * 60ms);
  }
  EXPECT_LE(exchange.news.keyframes.size(), 16U);
}

TEST(LiveFeed, countsRepeatedWarningsAndShowsTheNewestFirst)
{
  LiveExchange exchange;
  LiveFeed feed(exchange, {"slam", true, true});
  const auto now = LiveFeed::Clock::now() + 1s;
  for (const char* text : {"a", "b", "a", "a"}) feed.warn(text, now);
  feed.offer(now);
  ASSERT_EQ(exchange.status.warnings.size(), 2U);
  EXPECT_EQ(exchange.status.warnings[0].text, "a");
  EXPECT_EQ(exchange.status.warnings[0].count, 3U);
}

TEST(LiveFeed, namesALidarThatIsSilentForASecond)
{
  LiveExchange exchange;
  LiveFeed feed(exchange, {"record", true, false});
  for (int i = 0; i < 10; ++i) feed.add(scanOf(i, 2), twoLidars());
  const auto now = LiveFeed::Clock::now();
  feed.offer(now + 100ms);
  EXPECT_EQ(wordFor(exchange.status, now), "RUNNING");
  for (int i = 10; i < 20; ++i) feed.add(scanOf(i, 1), twoLidars());
  feed.offer(now + 200ms);
  EXPECT_EQ(wordFor(exchange.status, now), "SILENT");
}

TEST(LiveFeed, aMarkHasTheTimeOfTheNewestScan)
{
  LiveExchange exchange;
  LiveFeed feed(exchange, {"record", true, false});
  exchange.marks.push_back({"a deer", {}});
  feed.offer(LiveFeed::Clock::now() + 1s);
  EXPECT_TRUE(feed.takeMarks().empty()) << "there is no scan yet";
  feed.add(scanOf(7, 2), twoLidars());
  const std::vector<EventMark> marks = feed.takeMarks();
  ASSERT_EQ(marks.size(), 1U);
  EXPECT_EQ(marks[0].stamp, scanOf(7, 2).end());
  EXPECT_TRUE(feed.takeMarks().empty());
}

TEST(ViewStatusJson, takesTextThatIsNoUtf8)
{
  ViewStatus status;
  status.warnings.push_back({"bad \xff\xfe name", 1, {}});
  EXPECT_NO_THROW(toJson(status, {}, LiveFeed::Clock::now()));
}
}  // namespace scanloom
