#include "input/lidar/internal/Robosense.h"

#include "input/lidar/internal/calendarTime.h"

namespace scanloom
{
namespace
{
// When channels fire after the first one, in ns: the tables of drivers.

/** Beams 18 and 22 (counted from 0) fire before 17 and 21. */
constexpr std::array<std::int32_t, 32> kShotsOfHelios{
    0,     1570,  3150,  4720,  6300,  7870,  9450,  11360, 13260, 15170, 17080, 18990, 20560, 22140, 23710, 25290,
    26530, 29010, 27770, 30250, 31490, 33980, 32730, 35220, 36460, 37700, 38940, 40180, 41420, 42670, 43910, 45150};

/** The first of each two channels of a Helios. */
constexpr std::array<std::int32_t, 16> kShotsOfHelios16P{0,     3150,  6300,  9450,  13260, 17080, 20560, 23710,
                                                         26530, 27770, 31490, 32730, 36460, 38940, 41420, 43910};

/** Two halves of sixteen channels fire in turn. */
constexpr std::array<std::int32_t, 32> kShotsOfBpearl3{
    0,    2560, 5120, 7680, 10240, 12800, 15360, 17920, 25680, 28240, 30800, 33360, 35920, 38480, 41040, 43600,
    1280, 3840, 6400, 8960, 11520, 14080, 16640, 19200, 26960, 29520, 32080, 34640, 37200, 39760, 42320, 44880};

constexpr std::array<std::int32_t, 32> kShotsOfBpearl4{
    0,     1670,  3340,  5000,  6670,  8340,  10010, 11680, 13340, 15010, 16680, 18350, 20020, 21680, 23350, 25020,
    26690, 28360, 30020, 31690, 33360, 35030, 36700, 38360, 40030, 41700, 43370, 45040, 46700, 48370, 50040, 51710};

std::uint64_t loadBigEndian(Bytes bytes, std::size_t offset, std::size_t count)
{
  std::uint64_t value = 0;
  for (const std::uint8_t byte : bytes.slice(offset, count)) value = value << 8 | byte;
  return value;
}

/** An MSOP packet: header, 12 blocks of a marker, an azimuth and 32 readings, big-endian; read by firing. */
class RobosensePacket
{
 public:
  using Metadata = RobosenseMetadata;
  static constexpr Duration kStampModulus{0};
  static constexpr const char* kClock = "UTC";

  RobosensePacket(Bytes packet, const RobosenseMetadata& metadata)
    : packet_(packet.slice(0, kRobosensePacketBytes)),
      model_(*metadata.model),
      channels_(static_cast<std::size_t>(model_.channels)),
      returns_(static_cast<std::size_t>(metadata.returns)),
      rate_(measuredRate(metadata.rpm / 60 * kTurn * 1e-9))
  {
  }

  static PacketKind kind(Bytes packet, const RobosenseMetadata& metadata)
  {
    constexpr std::uint64_t kDeviceInfo = 0xA5FF005A11115555;  // begins a DIFOP packet
    if (packet.size() != kRobosensePacketBytes) return PacketKind::Malformed;
    if (loadBigEndian(packet, 0, 8) == kDeviceInfo) return PacketKind::Other;
    const RobosensePacket view(packet, metadata);
    if (!view.isSound()) return PacketKind::Malformed;
    return view.isOfModel() ? PacketKind::Lidar : PacketKind::Foreign;
  }

  static double encoderAngle(double azimuth) { return -azimuth * kRadiansPerCount; }

  static Eigen::Vector3d origin(const RobosenseMetadata& metadata, std::size_t)
  {
    return {metadata.model->lens_m, 0, metadata.model->lens_z_m};
  }

  std::optional<Timestamp> stamp() const
  {
    return model_.clock == RobosenseClock::Calendar ? calendarStamp() : secondsStamp();
  }

  int returns() const { return static_cast<int>(returns_); }

  double unitMm() const
  {
    if (model_.unit_mm > 0) return model_.unit_mm;
    return packet_[kUnit] == 1 ? 2.5 : 5;
  }

  std::size_t firings() const { return kBlocks * kReadings / (channels_ * returns_); }

  Firing firing(std::size_t index) const
  {
    const std::size_t slot = index * channels_ * returns_, block = slot / kReadings;
    const auto period_ns = static_cast<double>(model_.period.count());
    Firing firing;
    firing.after_stamp = model_.period * static_cast<std::int64_t>(index);
    // Lasers fire at all times: a gap in the field of view lasts a whole number of firings.
    for (std::size_t i = 0; i < block; i += blocksPerAzimuth())
      if (step(i) > kLargestStep)
        firing.after_stamp += model_.period * std::lround(step(i) / (rate_ * period_ns)) - periodOfAzimuth();
    // A Helios-16P with one return gives the azimuth of every other firing.
    const double since_azimuth = slot % kReadings == 0 ? 0 : period_ns;
    firing.azimuth = std::fmod(azimuth(block) + rate_ * since_azimuth, kTurn);
    firing.rate = rate_;
    firing.shots = model_.shots;
    firing.valid = azimuth(block) < kTurn;
    return firing;
  }

  Reading reading(std::size_t firing, std::size_t channel, std::size_t which) const
  {
    const std::size_t slot = (firing * returns_ + which) * channels_ + channel;
    const Bytes reading = block(slot / kReadings).slice(4 + 3 * (slot % kReadings), 3);
    return {static_cast<std::uint16_t>(loadBigEndian(reading, 0, 2)), reading[2]};
  }

 private:
  static constexpr std::size_t kHeaderBytes = 42, kBlocks = 12, kBlockBytes = 100, kReadings = 32;
  static constexpr std::size_t kUnit = 17, kStamp = 20;
  static constexpr int kLargestStep = 100;  // of azimuths, 0.01 degrees; more is a gap in the field of view

  Bytes block(std::size_t index) const { return packet_.slice(kHeaderBytes + index * kBlockBytes, kBlockBytes); }
  int azimuth(std::size_t block) const { return static_cast<int>(loadBigEndian(this->block(block), 2, 2)); }
  std::size_t blocksPerAzimuth() const { return channels_ == kReadings ? returns_ : 1; }

  Duration periodOfAzimuth() const
  {
    return model_.period * static_cast<std::int64_t>(kReadings * blocksPerAzimuth() / (channels_ * returns_));
  }

  /** Azimuth from this block's to the next one's. */
  int step(std::size_t block) const
  {
    const int step = (azimuth(block + blocksPerAzimuth()) - azimuth(block)) % kTurn;
    return step < 0 ? step + kTurn : step;
  }

  double measuredRate(double nominal) const
  {
    int turned = 0, steps = 0;
    for (std::size_t i = 0; i + blocksPerAzimuth() < kBlocks; i += blocksPerAzimuth())
      if (const int step = this->step(i); step <= kLargestStep)
      {
        turned += step;
        ++steps;
      }
    return turned == 0 ? nominal : turned / (static_cast<double>(periodOfAzimuth().count()) * steps);
  }

  bool isOfModel() const
  {
    // Manuals put the type into byte 31, the sensor at hand into byte 30.
    const std::size_t at = packet_[30] != 0 ? 30 : 31;
    const std::uint8_t type = packet_[at], version = packet_[at + 1];
    return version == 0 ? type == model_.old_type : type == model_.type && version == model_.version;
  }

  /** Whether markers and unit are such as the model sends, and azimuths such as so many returns have. */
  bool isSound() const
  {
    if (loadBigEndian(packet_, 0, 4) != model_.marker || (model_.unit_mm == 0 && packet_[kUnit] > 1)) return false;
    std::size_t pairs = 0;
    for (std::size_t i = 0; i < kBlocks; ++i)
    {
      if (loadBigEndian(block(i), 0, 2) != 0xFFEE) return false;
      if (i % 2 == 1 && azimuth(i) == azimuth(i - 1)) ++pairs;
    }
    return (pairs == kBlocks / 2) == (blocksPerAzimuth() == 2);
  }

  std::optional<Timestamp> calendarStamp() const
  {
    const Bytes date = packet_.slice(kStamp, 6);  // years count from 2000
    const auto milliseconds = loadBigEndian(packet_, kStamp + 6, 2),
               microseconds = loadBigEndian(packet_, kStamp + 8, 2);
    const auto second = timestampOf({2000 + date[0], date[1], date[2], date[3], date[4], date[5]});
    if (!second || milliseconds >= 1000 || microseconds >= 1000) return std::nullopt;
    return *second + std::chrono::milliseconds{milliseconds} + std::chrono::microseconds{microseconds};
  }

  std::optional<Timestamp> secondsStamp() const
  {
    constexpr std::uint64_t kSecondsOf62Bits = 4611686018;  // stamps have 62 bits of ns
    const auto seconds = loadBigEndian(packet_, kStamp, 6), microseconds = loadBigEndian(packet_, kStamp + 6, 4);
    if (seconds >= kSecondsOf62Bits || microseconds >= 1'000'000) return std::nullopt;
    return Timestamp{std::chrono::seconds{seconds} + std::chrono::microseconds{microseconds}};
  }

  Bytes packet_;
  const RobosenseModel& model_;
  std::size_t channels_, returns_;
  double rate_ = 0;  // of the rotor within this packet, 0.01 degrees per ns
};

constexpr std::uint32_t kBpearl = 0x55AA050A;  // begins its packets
}  // namespace

// Types, versions and layout are those of the user manuals (of the Bpearl those of drivers); shots and lens are those
// of drivers. Of the old types, 6 is the Helios-5515's alone.
constexpr std::array<RobosenseModel, 6> kRobosenseModels{{
    {{"Helios-5515", 32, 12, 55560ns}, 6, 1, 6, shotTimes(kShotsOfHelios)},
    {{"Helios-1610", 32, 12, 55560ns}, 6, 2, 7, shotTimes(kShotsOfHelios)},
    {{"Helios-1615", 32, 12, 55560ns}, 6, 4, 7, shotTimes(kShotsOfHelios)},
    {{"Helios-16P", 16, 24, 55560ns}, 6, 3, 7, shotTimes(kShotsOfHelios16P)},
    {{"Bpearl-V3", 32, 12, 55520ns},
     3,
     0,
     3,
     shotTimes(kShotsOfBpearl3),
     0.01473,
     0.09427,
     kBpearl,
     5,
     RobosenseClock::Calendar},
    {{"Bpearl-V4", 32, 12, 55560ns}, 3, 4, 0, shotTimes(kShotsOfBpearl4), 0.01619, 0.09571, kBpearl, 2.5},
}};

RobosenseMetadata parseRobosenseMetadata(const std::string& text, const std::string& name)
{
  return readMetadata(MetadataKeys(text, name), name, kRobosenseModels, 6699);
}

std::unique_ptr<PacketDecoder> makeRobosense(const RobosenseMetadata& metadata, const Rigid& body_T_sensor)
{
  return std::make_unique<StampedDecoder<RobosensePacket>>(metadata, body_T_sensor);
}
}  // namespace scanloom
