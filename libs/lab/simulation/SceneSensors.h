/** The lidars of a scene as sensors on this computer: a web interface each, and packets in real time. */
#pragma once
#include "lab/simulation/internal/DatagramSender.h"
#include "lab/simulation/internal/Scene.h"
#include "lab/simulation/internal/SensorPage.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace scanloom
{
struct PlayedScene
{
  std::uint64_t sent = 0, refused = 0;  // datagrams
  Duration latest{0};  // the largest delay of a datagram: more than a few ms if the simulation is too slow
};

class SceneSensors
{
 public:
  /** The first at 127.0.0.2, the next at 127.0.0.3, ... The scene must outlive them. Throws as SensorPage does. */
  explicit SceneSensors(const Scene&);

  /** The section of a configuration for `record`: addresses and poses of these lidars. */
  std::string configuration() const;

  std::string address(std::size_t lidar) const { return pages_[lidar]->address(); }

  /**
   * Sends all packets to 127.0.0.1, each at its time of receipt in the scene. Calls `goOn` ten times a second with the
   * share that was sent; stops when it returns false.
   */
  PlayedScene play(const std::function<bool(double)>& goOn);

 private:
  void restartIfDue(std::size_t lidar, Timestamp received);

  const Scene& scene_;
  std::vector<std::unique_ptr<SensorPage>> pages_;
  std::vector<DatagramSender> senders_;
  std::vector<std::size_t> runs_;  // of each lidar, the one that its web interface tells about
};
}  // namespace scanloom
