/**
 * The rig of the fault table: two OS-128 at 10 Hz, a VLP-16 (no ids, stamps only) and an OS-64 at 20 Hz, on a virtual
 * clock, with the invariants that hold in every case.
 */
#pragma once
#include "base/core/Digest.h"
#include "input/batching/TimeBatcher.h"
#include "support/FakeLidar.h"
#include "support/pushPacket.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <set>
#include <tuple>

namespace scanloom
{
constexpr Timestamp kBegin{1000s + 33ms};
constexpr Duration kPeriod = 100ms, kDeadline = 5ms, kTick = 250us;
constexpr Duration kPacketTime = 1562500ns;  // of the slowest lidar
constexpr Duration kDelay = 300us;           // of the quickest packets

struct Arrival
{
  LidarIndex lidar = 0;
  std::vector<std::uint8_t> packet;
  Timestamp received;
  Timestamp sent;  // true time of its last block
};
using Arrivals = std::vector<Arrival>;
using Rig = std::vector<FakeLidarOptions>;

inline FakeLidarOptions ouster(double frame_rate)
{
  FakeLidarOptions lidar;
  lidar.columns_per_frame = 1024;
  lidar.columns_per_packet = 16;
  lidar.last_column = 1023;
  lidar.frame_rate = frame_rate;
  lidar.has_init_id = true;
  return lidar;
}

inline FakeLidarOptions vlp16()
{
  FakeLidarOptions lidar;
  lidar.columns_per_frame = 1800;
  lidar.columns_per_packet = 24;
  lidar.last_column = 1799;
  lidar.numbering = Numbering::Stamps;
  lidar.fixed_block_period = 55296ns;
  return lidar;
}

inline Rig referenceRig() { return {ouster(10), ouster(10), vlp16(), ouster(20)}; }

inline std::size_t blocksPerPacket(const FakeLidarOptions& lidar)
{
  return static_cast<std::size_t>(lidar.columns_per_packet);
}

inline Timestamp lastStampOf(const std::vector<std::uint8_t>& packet)
{
  return fromNanoseconds(load<std::int64_t>(packet, packet.size() - FakeLidar::kBlockSize));
}

/** Rewrites every block: edit(stamp) and edit(frame id). */
inline void eachBlock(std::vector<std::uint8_t>& packet, const std::function<void(std::size_t at)>& edit)
{
  for (std::size_t at = FakeLidar::kHeaderSize; at < packet.size(); at += FakeLidar::kBlockSize) edit(at);
}

inline void shiftStamps(std::vector<std::uint8_t>& packet, Duration by)
{
  eachBlock(packet,
            [&](std::size_t at) { store<std::int64_t>(packet, at, load<std::int64_t>(packet, at) + by.count()); });
}

inline void inOrderOfArrival(Arrivals& arrivals)
{
  std::stable_sort(arrivals.begin(), arrivals.end(),
                   [](const Arrival& l, const Arrival& r) { return l.received < r.received; });
}

/** Each packet `delay` after its last block. */
inline void addPackets(Arrivals& arrivals, LidarIndex lidar, const std::vector<std::vector<std::uint8_t>>& packets,
                       Duration delay = kDelay)
{
  for (const auto& packet : packets)
    arrivals.push_back({lidar, packet, lastStampOf(packet) + delay, lastStampOf(packet)});
}

/** Each lidar in a phase of its own; packets take kDelay and up to 0.4 ms more. */
inline Arrivals drive(const Rig& rig, Duration length, Timestamp begin = kBegin, std::uint32_t first_frame = 7)
{
  std::mt19937 random(1);  // NOLINT: the same drive every time
  Arrivals arrivals;
  for (LidarIndex i = 0; i < rig.size(); ++i)
    for (auto& packet : FakeLidar(rig[i]).drive(begin + 1317us * static_cast<int>(i), length, first_frame))
    {
      const Timestamp sent = lastStampOf(packet);
      arrivals.push_back({i, std::move(packet), sent + kDelay + Duration{random() % 400000}, sent});
    }
  inOrderOfArrival(arrivals);
  return arrivals;
}

template <typename Predicate>
void removeIf(Arrivals& arrivals, Predicate predicate)
{
  arrivals.erase(std::remove_if(arrivals.begin(), arrivals.end(), predicate), arrivals.end());
}

struct Outcome
{
  std::vector<Scan> scans;
  std::vector<Timestamp> released;  // host time, per scan
  std::vector<LidarCounters> counters;
  std::vector<Notice> notices;
  std::vector<Duration> offsets;
  std::vector<std::uint64_t> most_waiting;  // blocks, per lidar

  std::uint64_t count(LidarIndex lidar, std::uint64_t LidarCounters::*count_of) const
  {
    return counters[lidar].*count_of;
  }
  std::vector<Notice> of(Notice::Kind kind) const
  {
    std::vector<Notice> some;
    std::copy_if(notices.begin(), notices.end(), std::back_inserter(some),
                 [kind](const Notice& n) { return n.kind == kind; });
    return some;
  }
};

inline TimeBatcher batcherOf(const Rig& rig, const BatcherOptions& options)
{
  std::vector<BatchedLidar> lidars;
  for (const auto& lidar : rig)
    lidars.push_back({"lidar" + std::to_string(lidars.size() + 1), std::make_shared<FakeLidar>(lidar)});
  return {lidars, options};
}

inline BatcherOptions withOtherClock(const std::string& treatment)
{
  BatcherOptions options;
  options.other_clock = treatment;
  return options;
}

/** The name of a test whose parameter is a duration: plus37000ms, minus5ms. */
inline std::string nameOfDuration(const testing::TestParamInfo<Duration>& tested)
{
  const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(tested.param).count();
  return (ms < 0 ? "minus" : "plus") + std::to_string(std::abs(ms)) + "ms";
}

/** What must hold whatever happens: I1, I2, I3, I4 and I5 of the fault table. */
inline void expectInvariants(const Outcome& outcome, const Rig& rig, const Arrivals& arrivals,
                             const BatcherOptions& options)
{
  using Order = std::tuple<Timestamp, std::uint8_t, std::uint16_t>;
  Order last{Timestamp::min(), 0, 0};
  std::set<std::tuple<std::uint8_t, Timestamp, std::uint16_t, std::uint32_t>> seen;
  std::vector<std::uint64_t> columns(rig.size(), 0), packets(rig.size(), 0);
  for (std::size_t k = 0; k < outcome.scans.size(); ++k)
  {
    const Scan& scan = outcome.scans[k];
    ASSERT_TRUE(k == 0 || scan.start == outcome.scans[k - 1].end()) << "I4, scan " << k;
    for (const Column& c : scan.columns)
    {
      ASSERT_GE(Order(c.stamp, c.sensor_id, c.measurement_id), last) << "I1, scan " << k;
      last = {c.stamp, c.sensor_id, c.measurement_id};
      ASSERT_TRUE(c.stamp >= scan.start && c.stamp < scan.end()) << "I4, scan " << k;
      ASSERT_TRUE(seen.emplace(c.sensor_id, c.stamp, c.measurement_id, c.frame_id).second) << "I2, scan " << k;
      ++columns[c.sensor_id];
    }
  }
  for (const Arrival& a : arrivals) ++packets[a.lidar];
  for (LidarIndex i = 0; i < rig.size(); ++i)
  {
    const LidarCounters& c = outcome.counters[i];
    EXPECT_EQ(c.emitted, columns[i]) << "I3, lidar " << i;
    EXPECT_EQ(blocksWaiting(c), 0u) << "I3, lidar " << i;
    EXPECT_EQ(packets[i], c.packets + c.malformed_packets + c.bad_crc_packets + c.foreign_packets + c.other_packets +
                              c.doubtful_packets)
        << "I3, lidar " << i;
    EXPECT_EQ(c.received, c.packets * blocksPerPacket(rig[i])) << "I3, lidar " << i;
    EXPECT_LE(outcome.most_waiting[i], static_cast<std::size_t>(options.queue_packets) * blocksPerPacket(rig[i]))
        << "I5, lidar " << i;
  }
}

/** A figure for the table of doc/study/faults.md: in what `--gtest_output=json` writes. */
inline void measured(const std::string& name, double value)
{
  testing::Test::RecordProperty(name, fmt::format("{:.4g}", value));
}

/** How long after its end a scan was given out, ms; the last one is cut by the end of input. */
inline double latestRelease(const Outcome& outcome)
{
  double latest = 0;
  for (std::size_t k = 0; k + 1 < outcome.scans.size(); ++k)
    latest = std::max(latest, 1e3 * seconds(outcome.released[k] - outcome.scans[k].end()));
  return latest;
}

enum class Clock
{
  Live,    // host time also passes between packets
  Replay,  // only packets tell the time
};

inline Outcome batch(const Rig& rig, const Arrivals& arrivals, const BatcherOptions& options = {},
                     Clock clock = Clock::Live)
{
  TimeBatcher batcher = batcherOf(rig, options);
  Outcome outcome;
  outcome.most_waiting.assign(rig.size(), 0);
  const auto collect = [&](std::vector<Scan> scans, Timestamp now)
  {
    for (Scan& scan : scans)
    {
      outcome.scans.push_back(std::move(scan));
      outcome.released.push_back(now);
    }
    for (const Notice& notice : batcher.takeNotices()) outcome.notices.push_back(notice);
    for (LidarIndex i = 0; i < rig.size(); ++i)
      outcome.most_waiting[i] = std::max(outcome.most_waiting[i], blocksWaiting(batcher.counters(i)));
  };
  Timestamp now = arrivals.front().received;
  for (const Arrival& a : arrivals)
  {
    for (now += kTick; clock == Clock::Live && now < a.received; now += kTick) collect(batcher.advance(now), now);
    now = a.received;
    collect(push(batcher, a.lidar, a.packet, a.received), a.received);
  }
  collect(batcher.finish(), now);
  for (LidarIndex i = 0; i < rig.size(); ++i)
  {
    outcome.counters.push_back(batcher.counters(i));
    outcome.offsets.push_back(batcher.timeOffset(i));
  }
  expectInvariants(outcome, rig, arrivals, options);
  return outcome;
}

/** Of everything that a consumer sees of the chosen lidars. */
inline std::string digestOf(const std::vector<Scan>& scans, const std::function<bool(std::uint8_t)>& chosen)
{
  std::vector<std::uint8_t> bytes;
  const auto add = [&bytes](const auto& value)
  {
    const auto* first = reinterpret_cast<const std::uint8_t*>(&value);
    bytes.insert(bytes.end(), first, first + sizeof(value));
  };
  for (const Scan& scan : scans)
  {
    add(nanoseconds(scan.start));
    for (const Column& c : scan.columns)
    {
      if (!chosen(c.sensor_id)) continue;
      add(nanoseconds(c.stamp));
      add(c.sensor_id);
      add(c.measurement_id);
      for (std::size_t p = c.first_point; p < c.first_point + c.count; ++p)
      {
        add(scan.points.x[p]);
        add(scan.points.t[p]);
        add(scan.points.ring[p]);
      }
    }
  }
  return md5(bytes);
}

inline std::string digestOf(const std::vector<Scan>& scans)
{
  return digestOf(scans, [](std::uint8_t) { return true; });
}
}  // namespace scanloom
