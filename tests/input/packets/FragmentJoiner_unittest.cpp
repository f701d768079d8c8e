#include "input/packets/internal/FragmentJoiner.h"

#include "HandmadeCapture.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>
#include <set>

namespace scanloom::fragment_joiner_unittest
{
namespace
{
using testing::ElementsAre;
using testing::IsEmpty;

/** Feeds a joiner with fragments of IPv4 packets and keeps the joined datagrams. */
struct Bench
{
  FragmentJoiner joiner;
  std::vector<ByteVector> out;

  Bench& add(const ByteVector& packet, Duration at = 0s)
  {
    ByteVector datagram;
    if (joiner.add(Timestamp{at}, ipContentOf(packet), datagram)) out.push_back(datagram);
    return *this;
  }
};

const ByteVector kA = content(100, 1), kB = content(100, 2);

TEST(FragmentJoiner, neverFillsAGapWithALaterDatagramOfTheSameId)
{
  const auto a = ipv4Fragments(kA, 40, 7), b = ipv4Fragments(kB, 40, 7);
  Bench bench;
  bench.add(a[0]).add(a[1]).add(b[2], 501ms);  // a[2], b[0] and b[1] are lost
  EXPECT_THAT(bench.out, IsEmpty());

  bench.joiner.finish();
  EXPECT_EQ(bench.joiner.lost(), 2u);
}

TEST(FragmentJoiner, beginsAnewWhereAnIdIsUsedAgainAtOnce)
{
  const auto a = ipv4Fragments(kA, 40, 7), b = ipv4Fragments(kB, 40, 7);
  Bench bench;
  bench.add(a[0]).add(a[1]).add(b[0]).add(b[1]).add(b[2]);
  EXPECT_THAT(bench.out, ElementsAre(kB));
  EXPECT_EQ(bench.joiner.lost(), 1u);
}

TEST(FragmentJoiner, ignoresRepeatedFragmentsBeforeAndAfterCompletion)
{
  const auto a = ipv4Fragments(kA, 40, 7);
  Bench bench;
  bench.add(a[0]).add(a[0]).add(a[2]).add(a[1]).add(a[1], 1ms).joiner.finish();
  EXPECT_THAT(bench.out, ElementsAre(kA));
  EXPECT_EQ(bench.joiner.lost(), 0u);
}

TEST(FragmentJoiner, refusesToMixOverlappingFragments)
{
  const auto a = ipv4Fragments(kA, 40, 7), shifted = ipv4Fragments(kB, 48, 7);
  Bench bench;
  bench.add(a[0]).add(shifted[1]).add(a[1]).add(a[2]);
  EXPECT_THAT(bench.out, IsEmpty());
}

TEST(FragmentJoiner, refusesAPieceBehindTheEnd)
{
  const auto short_one = ipv4Fragments(content(48), 40, 7), long_one = ipv4Fragments(content(200), 40, 7);
  EXPECT_THAT(Bench().add(short_one[1]).add(long_one[3]).add(short_one[0]).out, IsEmpty());
  EXPECT_THAT(Bench().add(long_one[3]).add(short_one[1]).add(short_one[0]).out, ElementsAre(content(48)));
}

TEST(FragmentJoiner, throwsOnLengthsThatNoDatagramCanHave)
{
  EXPECT_THROW(Bench().add(ipv4Packet(content(39), {7, 0, true})), std::out_of_range);
  EXPECT_THROW(Bench().add(ipv4Packet({}, {7, 8, false})), std::out_of_range);
  EXPECT_THROW(Bench().add(ipv4Packet(content(16), {7, 65528, false})), std::out_of_range);
}

TEST(FragmentJoiner, givesUpTheOldestWhenTooManyAreUnderConstruction)
{
  Bench bench{FragmentJoiner({500ms, 2}), {}};
  const auto first = ipv4Fragments(kA, 80, 1), second = ipv4Fragments(kA, 80, 2), third = ipv4Fragments(kB, 80, 3);
  bench.add(first[0], 1us).add(second[0], 2us).add(third[0], 3us);
  bench.add(third[1], 4us).add(second[1], 5us).add(first[1], 6us);
  EXPECT_THAT(bench.out, ElementsAre(kB, kA));
  EXPECT_EQ(bench.joiner.lost(), 1u);
}

TEST(FragmentJoiner, forgetsWhatWasBegunBeforeTheClockWasSetBack)
{
  const auto a = ipv4Fragments(kA, 80, 7);
  Bench bench;
  bench.add(a[0], 37s).add(a[1], 0s);
  EXPECT_THAT(bench.out, IsEmpty());
}

/** Fragments are lost, repeated and reordered, and ids are reused: every joined datagram was sent, and every datagram
 * whose fragments all arrived is joined. */
TEST(FragmentJoiner, givesOnlyDatagramsThatWereSentAndEveryOneThatArrivedWhole)
{
  constexpr unsigned kDatagrams = 3000;
  std::mt19937 random(4);
  std::bernoulli_distribution lost(0.05), repeated(0.05);
  Bench bench;
  std::set<ByteVector> sent, whole;

  for (unsigned i = 0; i < kDatagrams; ++i)
  {
    const ByteVector datagram = be32(i) + content(200 + i % 97, i);
    sent.insert(datagram);
    auto fragments = ipv4Fragments(datagram, 40, i % 50);
    std::shuffle(fragments.begin(), fragments.end(), random);
    bool complete = true;
    for (const ByteVector& fragment : fragments)
    {
      const bool is_lost = lost(random);
      complete = complete && !is_lost;
      if (!is_lost) bench.add(fragment, i * 20ms);
      if (!is_lost && repeated(random)) bench.add(fragment, i * 20ms);
    }
    if (complete) whole.insert(datagram);
  }
  bench.joiner.finish();

  EXPECT_EQ(std::set<ByteVector>(bench.out.begin(), bench.out.end()), whole);
  EXPECT_EQ(bench.out.size(), whole.size());
  EXPECT_GT(whole.size(), kDatagrams / 2);
  EXPECT_EQ(bench.joiner.joined() + bench.joiner.lost(), kDatagrams);
}
}  // namespace
}  // namespace scanloom::fragment_joiner_unittest
