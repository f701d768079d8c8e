/** A rig of lidars on this computer's own network, and what they send. */
#pragma once
#include "input/rig/internal/RigLive.h"
#include "input/rig/internal/RigReplay.h"
#include "support/FakeLidar.h"
#include "support/UdpSender.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <thread>

namespace scanloom
{
/** Lidars with addresses 127.0.0.2, 127.0.0.3, ...; all on one port, or each on its own. */
struct LiveRig
{
  enum class Ports
  {
    One,
    Several
  };

  explicit LiveRig(std::size_t lidars, Ports ports = Ports::Several, const FakeLidarOptions& options = {})
    : lidar(std::make_shared<FakeLidar>(options))
  {
    rig.batcher.deadline_ms = 300;  // a busy machine may keep the sender waiting in the middle of a round
    const std::uint16_t shared = freeUdpPort();
    for (std::size_t i = 0; i < lidars; ++i)
    {
      rig.lidars.push_back({"lidar" + std::to_string(i), lidar, {}});
      rig.addresses.push_back({ports == Ports::One ? shared : freeUdpPort(), 0, addressOf(i)});
    }
  }

  static IpAddress addressOf(std::size_t lidar) { return IpAddress::parse("127.0.0." + std::to_string(2 + lidar)); }

  /** What they send in `length`, stamped from `first` on, in the order of time; received when its last block ends. */
  std::vector<Datagram> drive(Duration length, Timestamp first = Timestamp{1000s}) const
  {
    std::vector<Datagram> datagrams;
    std::size_t of = 0;
    const LidarDescription& description = lidar->description();
    const Duration packet = description.blockPeriod() * description.columns_per_packet;
    for (const LidarAddress& address : rig.addresses)
    {
      Timestamp end = first;
      for (auto& payload : lidar->drive(first, length))
        datagrams.push_back({end += packet, addressOf(of), 0, address.lidar_port, std::move(payload)});
      ++of;
    }
    std::stable_sort(datagrams.begin(), datagrams.end(),
                     [](const Datagram& a, const Datagram& b) { return a.received < b.received; });
    return datagrams;
  }

  std::shared_ptr<const FakeLidar> lidar;
  Rig rig;
};

/** All that comes until the end. */
inline std::vector<SensorEvent> eventsOf(SensorInput& input)
{
  std::vector<SensorEvent> events;
  while (auto event = input.next()) events.push_back(*std::move(event));
  return events;
}

/** All that the stream makes of the datagrams, from one to the next and at their end. */
inline std::vector<SensorEvent> eventsOf(RigStream& stream, const std::vector<Datagram>& datagrams)
{
  std::vector<SensorEvent> events;
  const auto collect = [&]
  {
    while (auto event = stream.next()) events.push_back(*std::move(event));
  };
  for (const Datagram& datagram : datagrams)
  {
    stream.take(datagram);
    collect();
  }
  stream.finish();
  collect();
  return events;
}

inline std::vector<SensorEvent> replayOf(Rig rig, const std::filesystem::path& capture)
{
  rig.captures = {capture};
  RigReplay replay(rig);
  return eventsOf(replay);
}

/** Sends all, then waits until it has been received and ends the input. */
inline std::vector<SensorEvent> sendAndRead(const std::vector<Datagram>& datagrams, RigLive& live, double speed = 1)
{
  std::thread sending(
      [&]
      {
        UdpSender().replay(datagrams, speed);
        live.stop();
      });
  std::vector<SensorEvent> events = eventsOf(live);
  sending.join();
  return events;
}

inline std::vector<Scan> scansIn(const std::vector<SensorEvent>& events)
{
  std::vector<Scan> scans;
  for (const SensorEvent& event : events)
    if (const Scan* scan = std::get_if<Scan>(&event)) scans.push_back(*scan);
  return scans;
}

inline std::size_t columnsIn(const std::vector<Scan>& scans)
{
  return std::accumulate(scans.begin(), scans.end(), std::size_t{0},
                         [](std::size_t sum, const Scan& scan) { return sum + scan.columns.size(); });
}

inline void expectTheSame(const Scan& a, const Scan& b)
{
  EXPECT_EQ(a.start, b.start);
  EXPECT_EQ(a.missing, b.missing);
  EXPECT_EQ(a.columns_of, b.columns_of);
  ASSERT_EQ(a.columns.size(), b.columns.size());
  for (std::size_t i = 0; i < a.columns.size(); ++i)
  {
    EXPECT_EQ(a.columns[i].stamp, b.columns[i].stamp);
    EXPECT_EQ(a.columns[i].first_point, b.columns[i].first_point);
    EXPECT_EQ(a.columns[i].measurement_id, b.columns[i].measurement_id);
    EXPECT_EQ(a.columns[i].frame_id, b.columns[i].frame_id);
    EXPECT_EQ(a.columns[i].sensor_id, b.columns[i].sensor_id);
  }
  std::vector<const void*> fields;
  forEachField(a.points, [&fields](const auto& values) { fields.push_back(&values); });
  std::size_t next = 0;
  forEachField(b.points,
               [&](const auto& values)
               {
                 using Values = std::remove_reference_t<decltype(values)>;
                 EXPECT_TRUE(values == *static_cast<Values*>(fields[next++])) << "field " << next;
               });
}

/** To the bit, IMU samples and their places among the scans too. */
inline void expectTheSame(const std::vector<SensorEvent>& a, const std::vector<SensorEvent>& b)
{
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    ASSERT_EQ(a[i].index(), b[i].index()) << "event " << i;
    if (const Scan* scan = std::get_if<Scan>(&a[i]))
      expectTheSame(*scan, std::get<Scan>(b[i]));
    else if (const ScanPart* part = std::get_if<ScanPart>(&a[i]))
      expectTheSame(part->scan, std::get<ScanPart>(b[i]).scan);
    else
    {
      const auto& one = std::get<SensorImu>(a[i]);
      const auto& other = std::get<SensorImu>(b[i]);
      EXPECT_EQ(one.sensor, other.sensor);
      EXPECT_EQ(one.sample.stamp, other.sample.stamp);
      EXPECT_EQ(one.sample.accel, other.sample.accel);
      EXPECT_EQ(one.sample.gyro, other.sample.gyro);
    }
  }
}
}  // namespace scanloom
