#include "input/packets/MergedCaptures.h"

#include <gmock/gmock.h>

#include "HandmadeCapture.h"
#include "support/mergedCaptures.h"

namespace scanloom::merged_captures_unittest
{
namespace
{
using testing::ElementsAre;

std::filesystem::path capture(HandmadeCapture& file, const std::vector<std::pair<Duration, std::uint8_t>>& records)
{
  for (const auto& [time, mark] : records) file.add(ethernet(ipv4Packet(udp(7502, {mark}))), time);
  return file.file();
}

std::string marksOf(MergedCaptures& merged)
{
  std::string marks;
  for (Datagram datagram; merged.next(datagram);) marks += static_cast<char>(datagram.payload.at(0));
  return marks;
}

TEST(MergedCaptures, comeInTheOrderOfTimeAndOfFilesAtEqualTime)
{
  HandmadeCapture a, b, empty;
  const auto first = capture(a, {{1s, 'a'}, {3s, 'd'}, {5s, 'f'}});
  const auto second = capture(b, {{1s, 'b'}, {2s, 'c'}, {3s, 'e'}});
  MergedCaptures merged = mergedCaptures({first, empty.file(), second});
  EXPECT_EQ(marksOf(merged), "abcdef");
  EXPECT_EQ(merged.counters().datagrams, 6u);
  EXPECT_DOUBLE_EQ(merged.progress(), 1.0);
}

TEST(MergedCaptures, keepTheOrderWithinAFileEvenWhereItsTimeGoesBack)
{
  HandmadeCapture a;
  MergedCaptures merged = mergedCaptures({capture(a, {{2s, 'a'}, {1s, 'b'}, {3s, 'c'}})});
  EXPECT_EQ(marksOf(merged), "abc");
}

TEST(MergedCaptures, endTheDamagedFileOnly)
{
  HandmadeCapture a, b;
  const auto damaged = capture(a, {{1s, 'a'}});
  std::ofstream(damaged, std::ios::binary | std::ios::app) << std::string(16, '\xff') << std::string(100, 'x');
  MergedCaptures merged = mergedCaptures({damaged, capture(b, {{2s, 'b'}, {3s, 'c'}})});
  EXPECT_EQ(marksOf(merged), "abc");
  ASSERT_EQ(merged.counters().damages.size(), 1u);
  EXPECT_EQ(merged.counters().damages[0].rfind(damaged.string() + ": damaged after record 1", 0), 0u);
}

TEST(MergedCaptures, needAFile) { EXPECT_THROW(mergedCaptures({}), std::invalid_argument); }
}  // namespace
}  // namespace scanloom::merged_captures_unittest
