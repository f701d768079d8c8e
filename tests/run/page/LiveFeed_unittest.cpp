#include "run/page/internal/LiveFeed.h"

#include "run/page/internal/ViewStatusJson.h"

#include <gtest/gtest.h>

namespace scanloom::live_feed_unittest
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

TEST(LiveFeed, forgetsWhatWasDrawnInAnotherFrameWhereTheDriveEntersAMap)
{
  LiveExchange exchange;
  LiveFeed feed(exchange, {"slam", true, true});
  StateEstimate before = estimateAt(0, fromNanoseconds(1)), entered = estimateAt(300, fromNanoseconds(2));
  before.keyframe.emplace();
  entered.in_map = entered.entered_map = true;
  feed.add(before);
  feed.add(entered);
  feed.addMap(Keyframe{});
  feed.offer(LiveFeed::Clock::now() + 1s);
  EXPECT_TRUE(exchange.news.restarted);
  EXPECT_EQ(exchange.news.keyframes.size(), 1U) << "the map's";
  EXPECT_EQ(exchange.status.distance, 0) << "the body did not move from frame to frame";
}

TEST(LiveFeed, countsRepeatedWarningsAndShowsTheNewestFirst)
{
  LiveExchange exchange;
  LiveFeed feed(exchange, {"slam", true, true});
  const auto now = LiveFeed::Clock::now() + 1s;
  for (const char* text : {"back after 1 s", "b", "back after 2 s", "back after 3 s"}) feed.warn(text, now);
  feed.offer(now);
  ASSERT_EQ(exchange.status.warnings.size(), 2U);
  EXPECT_EQ(exchange.status.warnings[0].text, "back after 3 s") << "the same but for a number";
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

TEST(LiveFeed, tellsARestOfAnImuOnlyWhenItIsOne)
{
  LiveExchange exchange;
  LiveFeed feed(exchange, {"record", true, false});
  for (int i = 0; i < 35; ++i)
  {
    feed.add(scanOf(i, 2), twoLidars());
    for (int k = 0; k < 10; ++k)
      feed.add(SensorImu{1, {scanOf(i, 2).start + k * 10ms, {0, 0, 0}, {0, 0, 9.8}}}, twoLidars());
  }
  feed.offer(LiveFeed::Clock::now() + 1s);
  ASSERT_EQ(exchange.status.imus.size(), 1U);
  EXPECT_EQ(exchange.status.imus[0].name, "right");
  EXPECT_NEAR(exchange.status.imus[0].rate, 100, 2);
  EXPECT_LT(seconds(*exchange.status.newest - exchange.status.imus[0].seen), 0.02);
}

TEST(LiveFeed, keepsTheScanForPagesThatComeLater)
{
  LiveExchange exchange;
  LiveFeed feed(exchange, {"view", false, false});
  feed.add(scanOf(1, 2), twoLidars());
  feed.offer(LiveFeed::Clock::now() + 1s);
  EXPECT_EQ(exchange.news.scans.size(), 1U);
}

TEST(LiveFeed, namesALidarWhoseWindowGivesFewReturns)
{
  LiveExchange exchange;
  LiveFeed feed(exchange, {"record", true, false});
  RecordingHeader header = twoLidars();
  header.lidars[0].beams = header.lidars[1].beams = 10;
  auto now = LiveFeed::Clock::now();
  for (int i = 0; i < 200; ++i, now += 100ms)
  {
    Scan scan = scanOf(i, 2);
    scan.columns[0].count = 8;
    scan.columns[1].count = i < 150 ? 8 : 2;  // mud on the right one's window
    feed.add(scan, header);
    feed.update({}, {}, now);
    feed.offer(now);
  }
  const auto& lidars = exchange.status.lidars;
  EXPECT_NEAR(lidars[0].returns / lidars[0].usual_returns, 1, 0.01);
  EXPECT_LT(lidars[1].returns / lidars[1].usual_returns, 0.6);
}

TEST(LiveFeed, aMarkHasTheTimeOfTheNewestScan)
{
  LiveExchange exchange;
  LiveFeed feed(exchange, {"record", true, false});
  exchange.marks.push_back("a deer");
  feed.offer(LiveFeed::Clock::now() + 1s);
  EXPECT_FALSE(feed.takeMark()) << "there is no scan yet";
  feed.add(scanOf(7, 2), twoLidars());
  const std::optional<EventMark> mark = feed.takeMark();
  ASSERT_TRUE(mark);
  EXPECT_EQ(mark->stamp, scanOf(7, 2).end());
  EXPECT_EQ(mark->text, "a deer");
  EXPECT_FALSE(feed.takeMark());
}

TEST(ViewStatusJson, takesTextThatIsNoUtf8)
{
  ViewStatus status;
  status.warnings.push_back({"bad \xff\xfe name", 1, {}});
  EXPECT_NO_THROW(toJson(status, {}, LiveFeed::Clock::now()));
}
}  // namespace scanloom::live_feed_unittest
