#include "lab/simulation/SceneSensors.h"

#include "input/rig/Extrinsics.h"
#include "lab/simulation/internal/ScenePackets.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <thread>

namespace scanloom
{
namespace
{
using Clock = std::chrono::steady_clock;

constexpr Duration kAhead = 250ms;   // simulated in advance
constexpr Duration kReport = 100ms;  // between two calls of goOn

std::string hostOf(std::size_t lidar) { return fmt::format("127.0.0.{}", lidar + 2); }

std::vector<Datagram> nextOf(ScenePackets& packets)
{
  std::vector<Datagram> datagrams;
  for (Datagram datagram; packets.next(datagram);)
  {
    datagrams.push_back(std::move(datagram));
    if (datagrams.back().received - datagrams.front().received >= kAhead) break;
  }
  return datagrams;
}
}  // namespace

SceneSensors::SceneSensors(const Scene& scene) : scene_(scene), runs_(scene.lidars.size(), 0)
{
  for (std::size_t i = 0; i < scene.lidars.size(); ++i)
  {
    pages_.push_back(std::make_unique<SensorPage>(toJson(scene.lidars[i].metadata()), hostOf(i)));
    senders_.emplace_back(IpAddress::parse(hostOf(i)));
  }
}

std::string SceneSensors::configuration() const
{
  std::string text = "[lidars]\ndriver = CMultiLidarSensor\nprocess_rate = 100\n";
  for (std::size_t i = 0; i < scene_.lidars.size(); ++i)
    text += fmt::format("lidar{0}_name = {1}\nlidar{0}_address = {2}\nlidar{0}_pose = [{3}]\n", i + 1,
                        scene_.lidars[i].name, address(i), poseText(scene_.lidars[i].written_body_T_sensor));
  return text;
}

void SceneSensors::restartIfDue(std::size_t lidar, Timestamp received)
{
  const LidarStation& station = scene_.lidars[lidar];
  if (received < station.runs[runs_[lidar]].until || runs_[lidar] + 1 >= station.runs.size()) return;
  pages_[lidar]->restart(station.runs[++runs_[lidar]].lidar.metadata().init_id.value_or(0));
}

PlayedScene SceneSensors::play(const std::function<bool(double)>& goOn)
{
  ScenePackets packets(scene_);
  PlayedScene played;
  std::vector<Datagram> due = nextOf(packets);
  const IpAddress here = IpAddress::parse("127.0.0.1");
  const Clock::time_point start = Clock::now();
  Duration reported{0};
  while (!due.empty())
  {
    std::future<std::vector<Datagram>> coming = std::async(std::launch::async, [&] { return nextOf(packets); });
    for (const Datagram& datagram : due)
    {
      const Duration after = datagram.received - scene_.span.start;
      std::this_thread::sleep_until(start + after);
      played.latest = std::max<Duration>(played.latest, Clock::now() - start - after);
      const auto sender = std::find_if(scene_.lidars.begin(), scene_.lidars.end(),
                                       [&](const LidarStation& lidar)
                                       {
                                         return lidar.metadata().lidar_port == datagram.destination_port ||
                                                lidar.metadata().imu_port == datagram.destination_port;
                                       });
      const auto lidar = static_cast<std::size_t>(sender - scene_.lidars.begin());
      restartIfDue(lidar, datagram.received);
      ++(senders_[lidar].send(datagram, here) ? played.sent : played.refused);
      if (after - reported < kReport) continue;
      reported = after;
      if (!goOn(seconds(after) / scene_.span.duration)) return played;
    }
    due = coming.get();
  }
  return played;
}
}  // namespace scanloom
