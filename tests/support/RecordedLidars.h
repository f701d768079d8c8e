/** Two recorded lidars as live ones: what they sent, from 127.0.0.2 and 127.0.0.3 to free ports of this computer. */
#pragma once
#include "support/UdpSender.h"
#include "support/mergedCaptures.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace scanloom
{
class RecordedLidars
{
 public:
  enum class Ports
  {
    Several,
    One,  // for both lidars and their IMUs; then the section names no addresses: serial numbers must tell
  };

  /** The folder of a recording (recordings/sparse of the test data), of which the first datagrams are taken. */
  RecordedLidars(std::filesystem::path recording, std::size_t datagrams, Ports ports = Ports::Several)
    : recording_(std::move(recording)), addresses_named_(ports == Ports::Several)
  {
    const std::uint16_t shared = freeUdpPort();
    for (std::uint16_t port : {7502, 7503, 7504, 7505}) ports_[port] = ports == Ports::One ? shared : freeUdpPort();
    MergedCaptures captures = mergedCaptures({recording_ / "recording.pcap"});
    for (Datagram datagram; datagrams_.size() < datagrams && captures.next(datagram);)
    {
      datagram.source = IpAddress::parse(datagram.destination_port < 7504 ? "127.0.0.2" : "127.0.0.3");
      datagram.destination_port = ports_.at(datagram.destination_port);
      datagrams_.push_back(datagram);
    }
  }

  const std::vector<Datagram>& datagrams() const { return datagrams_; }
  Duration length() const { return datagrams_.back().received - datagrams_.front().received; }

  /** A section [lidars] that receives them. */
  std::string section() const
  {
    return "[lidars]\ndriver = CMultiLidarSensor\nprocess_rate = 100\nextrinsics = " + file("extrinsics.txt") +
           "\nlidar1_name = left\nlidar1_metadata = " + file("left.json") + portKeys(1, 7502) +
           "\nlidar2_name = right\nlidar2_metadata = " + file("right.json") + portKeys(2, 7504) +
           (addresses_named_ ? "\nlidar1_address = 127.0.0.2\nlidar2_address = 127.0.0.3\n" : "\n");
  }

  /** Waits until somebody receives. */
  void waitForReceiver() const
  {
    for (int i = 0; i < 1000 && !isReceivedOn(ports_.at(7505)); ++i) std::this_thread::sleep_for(10ms);
  }

  void send() const { UdpSender().replay(datagrams_); }

 private:
  std::string file(const char* name) const { return (recording_ / name).string(); }
  std::string portKeys(int lidar, std::uint16_t port) const
  {
    const std::string prefix = "\nlidar" + std::to_string(lidar);
    return prefix + "_port = " + std::to_string(ports_.at(port)) + prefix +
           "_imu_port = " + std::to_string(ports_.at(static_cast<std::uint16_t>(port + 1)));
  }

  std::filesystem::path recording_;
  std::map<std::uint16_t, std::uint16_t> ports_;  // of the recording: of this computer
  std::vector<Datagram> datagrams_;
  bool addresses_named_;
};
}  // namespace scanloom
