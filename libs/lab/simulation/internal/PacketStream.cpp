#include "lab/simulation/internal/PacketStream.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
// Between the lidars and the recording computer (assumed).
constexpr double kDelay = 60e-6;      // s: smallest delay from a packet's last measurement to its receipt
constexpr double kJitter = 80e-6;     // s: up to this is added to the delay, uniformly distributed
constexpr double kRareJitter = 2e-3;  // s: the same when the computer is busy; packets never overtake each other
constexpr double kRareShare = 0.003;  // share of the packets that arrive when the computer is busy

constexpr Duration kBetweenTwins = 30us;

constexpr std::uint64_t kImuIndexOffset = 1ULL << 40;  // the IMU's packets have other random numbers than the lidar's
}  // namespace

PacketStream::PacketStream(const Scene& scene, const LidarStation& station) : scene_(scene), station_(station)
{
  for (const LidarRun& run : station.runs)
  {
    encoders_.emplace_back(run.lidar.metadata());
    imus_.emplace_back(scene.scenery.drive(), scene.span, run.imu, scene.seed);
  }
}

std::vector<Datagram> PacketStream::finishedBefore(Timestamp until)
{
  std::vector<Datagram> datagrams;
  finishRun(until, datagrams);
  while (run().until <= until && run_ + 1 < station_.runs.size())
  {
    ++run_;
    next_packet_ = next_imu_ = 0;
    imu_waiting_.clear();
    finishRun(until, datagrams);
  }
  return datagrams;
}

void PacketStream::finishRun(Timestamp until, std::vector<Datagram>& datagrams)
{
  const Timestamp end = std::min(until, run().until);
  std::vector<Transport> arriving;
  for (; finished(next_packet_) < end; ++next_packet_)
    if (auto arrives = transport(next_packet_)) arriving.push_back(*arrives);

  const std::size_t first = datagrams.size();
  datagrams.resize(first + arriving.size());
  std::vector<ReturnCounts> returns(arriving.size());
  tbb::parallel_for(std::size_t{0}, arriving.size(),
                    [&](std::size_t i) { datagrams[first + i] = lidarDatagram(arriving[i], returns[i]); });
  for (const ReturnCounts& of_packet : returns) counts_.returns.add(of_packet);
  for (std::size_t i = 0; i < arriving.size(); ++i)
    if (arriving[i].received_again)
    {
      Datagram twin = datagrams[first + i];
      twin.received = *arriving[i].received_again;
      datagrams.push_back(std::move(twin));
    }
  addImu(end, datagrams);
}

Timestamp PacketStream::finished(std::uint64_t packet) const
{
  const auto columns = static_cast<std::uint64_t>(station_.metadata().columns_per_packet);
  return run().lidar.instantOf(columns * (packet + 1) - 1).truth;
}

/** A sensor sends no packet whose columns all lie outside its azimuth window. */
bool PacketStream::isSent(std::uint64_t packet) const
{
  const auto columns = static_cast<std::uint64_t>(station_.metadata().columns_per_packet);
  for (std::uint64_t i = 0; i < columns; ++i)
    if (run().lidar.sends(run().lidar.instantOf(columns * packet + i).measurement_id)) return true;
  return false;
}

bool PacketStream::isLost(Timestamp sent, double luck) const
{
  const LidarFaultOptions& faults = station_.faults;
  const double t = scene_.span.secondsAt(sent);
  if (luck < faults.loss || (t >= faults.silent_from && t < faults.silent_to)) return true;
  if (faults.burst_every <= 0) return false;

  // One burst begins in each interval of burst_every, at a random time; it may reach into the next interval.
  const auto slot = static_cast<std::int64_t>(std::floor(t / faults.burst_every));
  for (const std::int64_t i : {slot - 1, slot})
  {
    Random random(scene_.seed, RandomStream::Bursts, station_.place, static_cast<std::uint64_t>(i));
    const double begin = (static_cast<double>(i) + random.uniform()) * faults.burst_every;
    if (t >= begin && t < begin + faults.burst_length) return true;
  }
  return false;
}

std::optional<PacketStream::Transport> PacketStream::transport(std::uint64_t packet)
{
  if (!isSent(packet)) return std::nullopt;
  const Timestamp sent = finished(packet);
  Random random(scene_.seed, RandomStream::Transport, run().imu.place, packet);
  const Duration packet_time = finished(packet + 1) - sent;
  Timestamp received = sent + delay(random, seconds(packet_time));
  const double loss = random.uniform(), disorder = random.uniform(), copy = random.uniform(), turns = random.uniform();
  if (isLost(sent, loss))
  {
    ++counts_.lost;
    return std::nullopt;
  }
  if (disorder < station_.faults.reordered)
  {
    received += (turns < 0.5 ? 1 : 2) * packet_time + packet_time / 2;
    ++counts_.reordered;
  }
  ++counts_.lidar;
  std::optional<Timestamp> again;
  if (copy < station_.faults.duplicated)
  {
    again = received + kBetweenTwins;
    ++counts_.duplicated;
  }
  return Transport{packet, received, again};
}

Datagram PacketStream::lidarDatagram(const Transport& on_its_way, ReturnCounts& returns) const
{
  const auto count = static_cast<std::uint64_t>(station_.metadata().columns_per_packet);
  std::vector<OusterColumn> columns;
  for (std::uint64_t i = 0; i < count; ++i)
  {
    MeasuredColumn measured = run().lidar.measure(scene_.scenery, on_its_way.packet * count + i);
    returns.add(measured.returns);
    columns.push_back(std::move(measured.column));
  }
  const std::uint16_t port = station_.metadata().lidar_port;
  return {on_its_way.received, IpAddress::parse("127.0.0.1"), port, port, encoders_[run_].lidarPacket(columns)};
}

void PacketStream::addImu(Timestamp until, std::vector<Datagram>& datagrams)
{
  const std::size_t per_packet = encoders_[run_].imuSamplesPerPacket();
  for (const ImuStream::Sample& sample : imus_[run_].before(until))
  {
    imu_waiting_.push_back(sample);
    if (imu_waiting_.size() < per_packet || per_packet == 0) continue;
    const std::uint64_t index = next_imu_++;
    Random random(scene_.seed, RandomStream::Transport, run().imu.place, kImuIndexOffset + index);
    const std::vector<ImuStream::Sample> samples = std::exchange(imu_waiting_, {});
    if (isLost(samples.back().truth, random.uniform()))
    {
      ++counts_.lost;
      continue;
    }
    datagrams.push_back(imuDatagram(samples, index));
    ++counts_.imu;
  }
  if (per_packet == 0) imu_waiting_.clear();
}

Datagram PacketStream::imuDatagram(const std::vector<ImuStream::Sample>& samples, std::uint64_t index) const
{
  Random random(scene_.seed, RandomStream::Transport, run().imu.place, kImuIndexOffset + (1ULL << 39) + index);
  std::vector<ImuSample> readings;
  for (const ImuStream::Sample& sample : samples) readings.push_back(sample.reading);
  const std::uint16_t port = station_.metadata().imu_port;
  return {samples.back().truth + delay(random, kRareJitter), IpAddress::parse("127.0.0.1"), port, port,
          encoders_[run_].imuPacket(readings)};
}

Duration PacketStream::delay(Random& random, double packet_time) const
{
  const double rare = std::min(kRareJitter, 0.8 * packet_time);  // so that packets do not overtake each other
  const double jitter = random.uniform() < kRareShare ? rare : kJitter;
  return fromSeconds(kDelay + jitter * random.uniform());
}
}  // namespace scanloom
