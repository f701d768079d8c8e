/** The lidars of a scene as sensors of this computer: a web page each, and packets in real time. */
#pragma once
#include "simulation/DatagramSender.h"
#include "simulation/FakeSensor.h"
#include "simulation/Scene.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace scanloom
{
struct PlayedScene
{
  std::uint64_t sent = 0, refused = 0;  // datagrams
  Duration latest{0};                   // after it was due: how far the simulation fell behind
};

class SceneSensors
{
 public:
  /** The first at 127.0.0.2, the next at 127.0.0.3, ... The scene must outlive them. Throws as FakeSensor does. */
  explicit SceneSensors(const Scene&);

  /** A section of a configuration that knows of these lidars their addresses and poses only. */
  std::string configuration() const;

  std::string address(std::size_t lidar) const { return pages_[lidar]->address(); }

  /**
   * Sends all packets to 127.0.0.1, each when it is received in the scene; the next quarter of a second is simulated
   * meanwhile. Calls `goOn` with the share that was sent, ten times a second, until it says false.
   */
  PlayedScene play(const std::function<bool(double)>& goOn);

 private:
  void restartIfDue(std::size_t lidar, Timestamp received);

  const Scene& scene_;
  std::vector<std::unique_ptr<FakeSensor>> pages_;
  std::vector<DatagramSender> senders_;
  std::vector<std::size_t> runs_;  // of each lidar, as its page tells it
};
}  // namespace scanloom
