/**
 * Packets of three lidars that are lost, repeated, held back or damaged on their way to the batcher, or of a clock
 * that steps, of a sensor that starts again. Whatever happens, the invariants of the fault table hold, and the
 * output does not run ahead of the input.
 * fuzz options: -max_len=128
 */
#include <array>
#include <memory>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "../support/FakeLidar.h"
#include "../support/pushPacket.h"
#include "input/batching/TimeBatcher.h"
#include "require.h"

using namespace scanloom;

namespace
{
constexpr Timestamp kBegin{7199s + 700ms};  // a little before the top of an hour
constexpr Duration kLength = 2s;
constexpr std::size_t kLidars = 3;
constexpr std::size_t kMostScans = 2000;  // the longest input tells of less time
constexpr std::array<Duration, 16> kSteps{1ms, -1ms, 4ms, -4ms, 20ms,  -20ms,  150ms,       -150ms,
                                          1s,  -1s,  37s, -37s, 3600s, -3600s, 3153600000s, -3153600000s};

std::array<FakeLidarOptions, kLidars> rig()
{
  std::array<FakeLidarOptions, kLidars> lidars;
  lidars[0].has_init_id = true;
  lidars[1].frame_rate = 20;
  lidars[1].first_column = 50;  // a window around column 0
  lidars[1].last_column = 20;
  lidars[1].frame_id_modulus = 32;
  lidars[2].numbering = Numbering::Stamps;
  lidars[2].fixed_block_period = 1500us;
  lidars[2].stamp_modulus = 3600s;
  return lidars;
}

/** The fuzzer's bytes, zeros behind their end. */
class Script
{
 public:
  explicit Script(Bytes bytes) : bytes_(bytes) {}
  bool ended() const { return at_ >= bytes_.size(); }
  std::uint8_t next() { return ended() ? std::uint8_t{0} : bytes_[at_++]; }

 private:
  Bytes bytes_;
  std::size_t at_ = 0;
};

/** What one lidar sends, and what became of its clock and counters. */
struct Sender
{
  const std::vector<std::vector<std::uint8_t>>* drive = nullptr;
  std::size_t next = 0;
  bool next_is_invalid = false;  // its first block
  Duration clock{0};
  std::uint32_t frames = 0, runs = 0;
  std::vector<std::uint8_t> held, latest;

  bool ended() const { return next >= drive->size(); }
  std::vector<std::uint8_t> take()
  {
    std::vector<std::uint8_t> packet = (*drive)[next++];
    if (std::exchange(next_is_invalid, false)) packet[FakeLidar::kHeaderSize + 14] = 0;
    return packet;
  }
};

/** Checks everything that comes out against I1, I2 and I4, and counts it. */
class Checker
{
 public:
  explicit Checker(const BatcherOptions& options) : options_(options) {}

  void take(const std::vector<Scan>& scans)
  {
    for (const Scan& scan : scans) take(scan);
  }

  void take(const ScanSlice& slice)
  {
    require(slice.count == options_.slices && slice.index == slices_ && slice.first_column == columns_of_slices_);
    for (std::size_t i = slice.first_column; i < slice.end_column; ++i)
      require(slice.scan.columns[i].stamp >= slice.begin() && slice.scan.columns[i].stamp < slice.end());
    require(slice.index + 1 < slice.count || slice.end_column == slice.scan.columns.size());
    slices_ = (slice.index + 1) % slice.count;
    columns_of_slices_ = slices_ == 0 ? 0 : slice.end_column;
  }

  std::array<std::uint64_t, kLidars> emitted{};

 private:
  void take(const Scan& scan)
  {
    require(++scans_ < kMostScans);
    require(!end_ || scan.start == *end_);
    end_ = scan.end();
    std::array<std::uint32_t, kLidars> columns{};
    std::size_t points = 0;
    for (const Column& c : scan.columns)
    {
      require(c.stamp >= scan.start && c.stamp < scan.end() && c.sensor_id < kLidars && c.first_point == points);
      const Order order(c.stamp, c.sensor_id, c.measurement_id);
      require(!last_ || order > *last_ || (order == *last_ && c.frame_id != last_frame_));
      last_ = order;
      last_frame_ = c.frame_id;
      for (std::size_t i = points; i < points + c.count; ++i)
        require(scan.points.sensor_id[i] == c.sensor_id && scan.points.t[i] == (c.stamp - scan.start).count());
      points += c.count;
      ++columns[c.sensor_id];
      ++emitted[c.sensor_id];
    }
    require(points == scan.points.size());
    for (std::size_t i = 0; i < kLidars; ++i) require(columns[i] == scan.columns_of[i]);
  }

  using Order = std::tuple<Timestamp, std::uint8_t, std::uint16_t>;
  BatcherOptions options_;
  std::size_t scans_ = 0;
  std::optional<Timestamp> end_;
  std::optional<Order> last_;
  std::uint32_t last_frame_ = 0;
  int slices_ = 0;
  std::size_t columns_of_slices_ = 0;
};

class Session
{
 public:
  explicit Session(Script& script)
    : script_(script), options_(optionsFrom(script)), checker_(options_), batcher_(make())
  {
    for (LidarIndex i = 0; i < kLidars; ++i) senders_[i].drive = &drives()[i];
    batcher_.onSlice([this](const ScanSlice& slice) { checker_.take(slice); });
  }

  void run()
  {
    while (!script_.ended()) step();
    checker_.take(batcher_.finish());
    for (LidarIndex i = 0; i < kLidars; ++i) checkAccounts(i);
  }

 private:
  static BatcherOptions optionsFrom(Script& script)
  {
    const std::uint8_t choice = script.next();
    BatcherOptions options;
    options.slices = 1 + choice % 4;
    options.queue_packets = choice & 4 ? 3 : 64;
    options.other_clock = choice & 8 ? (choice & 16 ? "refuse" : "quarantine") : "align";
    options.scan_rate = choice & 32 ? 33.3 : 10;
    options.deadline_ms = choice & 64 ? 30 : 5;
    options.scan_phase_ms = choice & 128 ? 7 : 0;
    return options;
  }

  static const std::vector<std::shared_ptr<const FakeLidar>>& decoders()
  {
    static const auto all = []
    {
      std::vector<std::shared_ptr<const FakeLidar>> lidars;
      for (const FakeLidarOptions& lidar : rig()) lidars.push_back(std::make_shared<FakeLidar>(lidar));
      return lidars;
    }();
    return all;
  }

  static const std::array<std::vector<std::vector<std::uint8_t>>, kLidars>& drives()
  {
    static const auto all = []
    {
      std::array<std::vector<std::vector<std::uint8_t>>, kLidars> drives;
      for (LidarIndex i = 0; i < kLidars; ++i)
        drives[i] = decoders()[i]->drive(kBegin + 1317us * static_cast<int>(i), kLength, 30);
      return drives;
    }();
    return all;
  }

  TimeBatcher make() const
  {
    std::vector<BatchedLidar> lidars;
    for (const auto& decoder : decoders()) lidars.push_back({"fuzz", decoder, Duration{0}});
    return {lidars, options_};
  }

  static Timestamp sentAt(const std::vector<std::uint8_t>& packet)
  {
    return fromNanoseconds(load<std::int64_t>(packet, packet.size() - FakeLidar::kBlockSize));
  }

  /** The low bits say what happens, the high ones to whom or how often. */
  void step()
  {
    const std::uint8_t code = script_.next();
    const LidarIndex lidar = (code >> 4) % kLidars;
    Sender& sender = senders_[lidar];
    switch (code & 15)
    {
      case 0:
      case 1:
      case 2:
      case 3:
        for (int i = 0; i <= code >> 4; ++i) sendEarliest();
        break;
      case 4:
        sender.next += 1 + script_.next() % 8;  // lost
        break;
      case 5:
        push(lidar, sender.latest);
        break;
      case 6:
        if (!sender.ended()) sender.held = sender.take();
        break;
      case 7:
        push(lidar, asSent(sender, sender.held));
        break;
      case 8:
        damage(lidar);
        break;
      case 9:
        sender.clock = stepped(sender.clock, kSteps[script_.next() % kSteps.size()]);
        break;
      case 10:
        ++sender.runs;
        sender.frames = script_.next();
        if (code & 16) sender.clock = kSteps[script_.next() % kSteps.size()] - (kBegin - Timestamp{});
        break;
      case 11:
        now_ += std::chrono::milliseconds{script_.next()};
        checker_.take(batcher_.advance(now_));
        break;
      case 12:
        push(lidar, std::vector<std::uint8_t>(script_.next(), 1));
        break;
      case 13:
        batcher_.replace(lidar, decoders()[lidar]);
        break;
      case 14:
        sender.next_is_invalid = true;
        break;
      default:
        batcher_.takeNotices();
        sender.next += 40;  // silent for long
    }
  }

  /** Two centuries off at most: stamps of an Ouster have 64 bits, and further off this program's own sums overflow. */
  static Duration stepped(Duration clock, Duration step)
  {
    constexpr Duration kMost{std::chrono::hours{24 * 365 * 200}};
    return std::clamp(clock, -kMost + std::chrono::abs(step), kMost - std::chrono::abs(step)) + step;
  }

  void sendEarliest()
  {
    Sender* earliest = nullptr;
    for (Sender& sender : senders_)
      if (!sender.ended() &&
          (!earliest || sentAt((*sender.drive)[sender.next]) < sentAt((*earliest->drive)[earliest->next])))
        earliest = &sender;
    if (!earliest) return;
    const std::vector<std::uint8_t> packet = earliest->take();
    now_ = std::max(now_, sentAt(packet) + 300us);
    push(static_cast<LidarIndex>(earliest - senders_.data()), asSent(*earliest, packet));
  }

  /** A packet of the drive as the sensor's present clock and run have it. */
  static std::vector<std::uint8_t> asSent(const Sender& sender, std::vector<std::uint8_t> packet)
  {
    if (packet.size() < FakeLidar::kHeaderSize) return packet;
    store(packet, 0, sender.runs);
    for (std::size_t at = FakeLidar::kHeaderSize; at < packet.size(); at += FakeLidar::kBlockSize)
    {
      store(packet, at, load<std::int64_t>(packet, at) + sender.clock.count());
      store(packet, at + 8, (load<std::uint32_t>(packet, at + 8) + sender.frames) % 32);
    }
    return packet;
  }

  void damage(LidarIndex lidar)
  {
    Sender& sender = senders_[lidar];
    if (sender.ended()) return;
    std::vector<std::uint8_t> packet = asSent(sender, sender.take());
    const std::size_t place = script_.next() * 256u + script_.next();
    packet[place % packet.size()] ^= script_.next();
    push(lidar, packet);
  }

  void push(LidarIndex lidar, const std::vector<std::uint8_t>& packet)
  {
    ++pushed_[lidar];
    checker_.take(scanloom::push(batcher_, lidar, packet, now_));
    senders_[lidar].latest = packet;
    require(blocksWaiting(batcher_.counters(lidar)) <=
            blocksOf(lidar, static_cast<std::uint64_t>(options_.queue_packets)));
  }

  static std::uint64_t blocksOf(LidarIndex lidar, std::uint64_t packets)
  {
    return packets * static_cast<std::uint64_t>(decoders()[lidar]->description().columns_per_packet);
  }

  void checkAccounts(LidarIndex lidar) const
  {
    const LidarCounters& c = batcher_.counters(lidar);
    require(c.emitted == checker_.emitted[lidar]);
    require(blocksWaiting(c) == 0);
    require(pushed_[lidar] == c.packets + c.malformed_packets + c.bad_crc_packets + c.foreign_packets +
                                  c.other_packets + c.doubtful_packets);
    require(c.received == blocksOf(lidar, c.packets));
  }

  Script& script_;
  BatcherOptions options_;
  Checker checker_;
  TimeBatcher batcher_;
  std::array<Sender, kLidars> senders_;
  std::array<std::uint64_t, kLidars> pushed_{};
  Timestamp now_ = kBegin;
};
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  Script script(Bytes(data, size));
  Session session(script);
  mayThrow<std::runtime_error>([&] { session.run(); });  // other_clock = refuse, at the start
  return 0;
}
