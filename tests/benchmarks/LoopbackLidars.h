/** Simulated OS-128 lidars that send over the loopback interface from a process of their own, as fast as wanted. */
#pragma once
#include "RigOfPackets.h"
#include "input/rig/Rig.h"
#include "support/UdpSender.h"

#include <sys/mman.h>
#include <sys/wait.h>

#include <atomic>
#include <new>

namespace scanloom::bench
{
struct LoopbackOptions
{
  int sensors = 2;
  double seconds = 10;  // of the host
  double speed = 1;     // seconds of the lidars per second of the host
  int spoofed = 0;      // packets per second that copy the first lidar's half a turn ahead, from another address
  int flood = 0;        // IMU packets per second with stamps of any time, from the first lidar's own address

  bool hasStrangers() const { return spoofed > 0 || flood > 0; }
};

class LoopbackLidars
{
 public:
  explicit LoopbackLidars(const LoopbackOptions& options)
    : options_(options), metadata_(sensor(*findOusterProfile("RNG19_RFL8_SIG16_NIR16"), 128))
  {
    for (int i = 0; i < options.sensors; ++i)
    {
      ports_.push_back(freeUdpPort());
      addresses_.push_back(IpAddress::parse("127.0.0." + std::to_string(2 + i)));
    }
    void* shared = mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (shared == MAP_FAILED) throw std::bad_alloc();
    shared_ = new (shared) Shared;
  }
  LoopbackLidars(const LoopbackLidars&) = delete;
  LoopbackLidars& operator=(const LoopbackLidars&) = delete;
  ~LoopbackLidars() { munmap(shared_, sizeof(Shared)); }

  scanloom::Rig rig() const
  {
    scanloom::Rig rig;
    for (std::size_t i = 0; i < ports_.size(); ++i)
    {
      const double n = static_cast<double>(i);
      const Rigid body_T_sensor = Rigid::fromXyzYawPitchRoll(0.5 * n, 1, 2, 0.7 * n, 0.1, -0.05);
      rig.lidars.push_back(
          {"lidar" + std::to_string(i), std::make_shared<OusterDecoder>(metadata_, body_T_sensor), Duration{0}});
      // Where addresses are configured strangers do not even get in.
      rig.addresses.push_back(
          {ports_[i], ports_[i], options_.hasStrangers() ? std::nullopt : std::optional(addresses_[i])});
    }
    return rig;
  }

  /** Begins to send, in a process of its own: call it before any thread is started. */
  void start()
  {
    process_ = fork();
    if (process_ != 0) return;
    send();
    _exit(0);
  }

  void wait()
  {
    if (process_ > 0) waitpid(process_, nullptr, 0);
    process_ = 0;
  }

  /** Lets the process send that start() has begun. */
  void go() { shared_->go = true; }
  bool finished() const { return shared_->finished; }
  std::uint64_t sent() const { return shared_->sent; }
  std::uint64_t sentByStrangers() const { return shared_->by_strangers; }
  std::size_t packetBytes() const { return shared_->packet_bytes; }

  /** When, by CLOCK_MONOTONIC, the lidars' clocks show `stamp`. */
  Duration hostTimeOf(Timestamp stamp) const
  {
    return Duration{shared_->begin} + fromSeconds(seconds(stamp - kBegin) / options_.speed);
  }

 private:
  struct Shared
  {
    std::atomic<bool> go{false}, finished{false};
    std::atomic<std::int64_t> begin{0};  // CLOCK_MONOTONIC at kBegin, ns
    std::atomic<std::uint64_t> sent{0}, by_strangers{0};
    std::atomic<std::size_t> packet_bytes{0};
  };

  void send()
  {
    std::vector<Turn> turns;
    for (int i = 0; i < options_.sensors; ++i) turns.emplace_back(metadata_, i * kBlock / options_.sensors, Crc::None);
    shared_->packet_bytes = turns.front().packets().front().size();
    UdpSender sender;
    while (!shared_->go) std::this_thread::sleep_for(1ms);

    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now() + 10ms;
    shared_->begin = begin.time_since_epoch().count();
    for (Duration turn{0}; seconds(turn) < options_.seconds * options_.speed; turn += kTurn)
    {
      for (std::size_t p = 0; p < kPacketsPerTurn; ++p)
      {
        const Duration measured = turn + static_cast<int>(p + 1) * kColumnsPerPacket * kBlock;
        std::this_thread::sleep_until(begin + fromSeconds(seconds(measured) / options_.speed));
        for (std::size_t i = 0; i < turns.size(); ++i)
          sender.send(datagram(static_cast<int>(i), turns[i].packets()[p]));
        shared_->sent += turns.size();
        sendStrangers(sender, turns.front().packets()[(p + kPacketsPerTurn / 2) % kPacketsPerTurn],
                      (Clock::now() - begin).count() * 1e-9);
      }
      for (Turn& t : turns) t.advance();
    }
    shared_->finished = true;
  }

  /** Those that are due `after` so many seconds. */
  void sendStrangers(UdpSender& sender, const Packet& copied, double after)
  {
    DatagramView copy = datagram(0, copied), imu = datagram(0, imu_);
    copy.source = IpAddress::parse("127.0.0.99");
    for (; spoofed_ < after * options_.spoofed; ++spoofed_, ++shared_->by_strangers) sender.send(copy);
    for (; flooded_ < after * options_.flood; ++flooded_, ++shared_->by_strangers)
    {
      store(imu_, 0, std::uint64_t{flooded_} * 1'000'000'007'000'001 % 4'000'000'000'000'000'000);
      store(imu_, ouster_legacy_imu::kGyroStamp, load<std::uint64_t>(imu_, 0));
      sender.send(imu);
    }
  }

  DatagramView datagram(int lidar, const Packet& packet) const
  {
    DatagramView view;
    view.source = addresses_[static_cast<std::size_t>(lidar)];
    view.destination_port = ports_[static_cast<std::size_t>(lidar)];
    view.payload = packet;
    return view;
  }

  LoopbackOptions options_;
  OusterMetadata metadata_;
  std::vector<std::uint16_t> ports_;
  std::vector<IpAddress> addresses_;
  Packet imu_ = Packet(48, 0);  // LEGACY
  std::uint64_t spoofed_ = 0, flooded_ = 0;
  Shared* shared_ = nullptr;
  pid_t process_ = 0;
};
}  // namespace scanloom::bench
