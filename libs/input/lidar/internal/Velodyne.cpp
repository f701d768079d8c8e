#include "input/lidar/internal/Velodyne.h"

#include <fmt/format.h>

#include <algorithm>

namespace scanloom
{
namespace
{
/** Lasers fire `together` at a time, `period` ns apart; after `before_pause` such shots comes a pause of one. */
template <std::size_t kLasers>
constexpr std::array<std::int32_t, kLasers> velodyneShots(std::int32_t period, int together = 1, int before_pause = 99)
{
  std::array<std::int32_t, kLasers> shots{};
  for (std::size_t laser = 0; laser < kLasers; ++laser)
  {
    const int number = static_cast<int>(laser) / together;
    shots[laser] = period * (number + number / before_pause);
  }
  return shots;
}
constexpr auto kShotsOfVlp16 = velodyneShots<16>(2304);
constexpr auto kShotsOfHdl32E = velodyneShots<32>(1152);
constexpr auto kShotsOfVlp32C = velodyneShots<32>(2304, 2);
constexpr auto kShotsOfVls128 = velodyneShots<128>(2665, 8, 8);

/**
 * 12 data blocks of 100 bytes: flag, azimuth, 32 readings of 3 bytes in the order of firing. Then stamp, return mode
 * and product id. A group is the data blocks that share an azimuth: several where a firing needs 128 readings or has
 * two returns; half a block has a firing of 16 lasers, so a group then has two firings.
 */
class VelodynePacket
{
 public:
  using Metadata = VelodyneMetadata;
  static constexpr Duration kStampModulus = std::chrono::hours{1};
  static constexpr const char* kClock = "TOP_OF_HOUR";

  VelodynePacket(Bytes packet, const VelodyneMetadata& metadata)
    : packet_(packet.slice(0, kVelodynePacketBytes)),
      model_(*metadata.model),
      returns_(packet_[kReturnMode] == kDual ? 2 : 1),
      nominal_rate_(metadata.rpm / 60 * kTurn * 1e-9)
  {
    const auto channels = static_cast<std::size_t>(model_.channels);
    blocks_per_group_ = std::max<std::size_t>(1, channels / kReadings) * returns_;
    firings_per_group_ = std::max<std::size_t>(1, kReadings / channels);
    groups_ = kBlocks / blocks_per_group_;
    group_period_ = model_.period * static_cast<int>(firings_per_group_);
    followTheRotor();
  }

  static PacketKind kind(Bytes packet, const VelodyneMetadata& metadata)
  {
    constexpr std::size_t kPositionBytes = 512;  // GPS sentence and housekeeping, on another port
    if (packet.size() == kPositionBytes) return PacketKind::Other;
    if (packet.size() != kVelodynePacketBytes) return PacketKind::Malformed;
    const VelodynePacket view(packet, metadata);
    const std::uint8_t id = packet[kProductId];
    const bool is_early = metadata.early_product_id != 0 && id == metadata.early_product_id && view.turnsAsSet();
    if (id != metadata.product_id && !is_early) return PacketKind::Foreign;
    const bool as_set = view.returns() == metadata.returns;
    return as_set && view.isSound() ? PacketKind::Lidar : PacketKind::Malformed;
  }

  static double encoderAngle(double azimuth) { return -azimuth * kRadiansPerCount; }

  static Eigen::Vector3d origin(const VelodyneMetadata& metadata, std::size_t laser)
  {
    return {0, 0, 1e-3 * metadata.vertical_offset_mm[laser]};
  }

  std::optional<Timestamp> stamp() const
  {
    return Timestamp{std::chrono::microseconds{load<std::uint32_t>(packet_, kStamp)} + model_.first_shot};
  }

  int returns() const { return static_cast<int>(returns_); }
  double unitMm() const { return model_.range_unit_mm; }
  std::size_t firings() const { return groups_ * firings_per_group_; }

  Firing firing(std::size_t index) const
  {
    const std::size_t group = index / firings_per_group_, within = index % firings_per_group_;
    const Duration in_group = model_.period * static_cast<int>(within);
    const std::int64_t periods = static_cast<std::int64_t>(group) + (group >= first_behind_gap_ ? gap_periods_ : 0);
    const double azimuth = this->azimuth(group) + rate_ * static_cast<double>(in_group.count());

    Firing firing;
    firing.after_stamp = group_period_ * periods + in_group;
    firing.azimuth = azimuth - kTurn * std::floor(azimuth / kTurn);
    firing.rate = rate_;
    firing.shots = model_.shots;
    firing.valid = this->azimuth(group) <= kTurn;  // sensors do send 360.00 degrees
    for (std::size_t block = 1; block < blocks_per_group_; ++block)
      if (azimuthOfBlock(group * blocks_per_group_ + block) != this->azimuth(group)) firing.valid = false;
    return firing;
  }

  Reading reading(std::size_t firing, std::size_t laser, std::size_t which) const
  {
    const std::size_t number = firing * static_cast<std::size_t>(model_.channels) + laser;
    const std::size_t block = number / kReadings * returns_ + which;
    const Bytes reading = packet_.slice(block * kBlockBytes + 4 + number % kReadings * 3, 3);
    return {load<std::uint16_t>(reading, 0), reading[2]};
  }

 private:
  static constexpr std::size_t kBlocks = 12, kBlockBytes = 100, kReadings = 32;
  static constexpr std::size_t kStamp = 1200, kReturnMode = 1204, kProductId = 1205;
  static constexpr std::uint8_t kStrongest = 0x37, kDual = 0x39;  // 0x38 is the last return

  std::uint16_t azimuthOfBlock(std::size_t block) const
  {
    return load<std::uint16_t>(packet_, block * kBlockBytes + 2);
  }
  std::uint16_t azimuth(std::size_t group) const { return azimuthOfBlock(group * blocks_per_group_); }

  /** Whether return mode and block flags are such as the model sends. */
  bool isSound() const
  {
    constexpr std::array<std::uint16_t, 4> kBankFlags{0xEEFF, 0xDDFF, 0xCCFF, 0xBBFF};  // lasers 0-31, 32-63, ...
    const std::uint8_t mode = packet_[kReturnMode];
    if (mode < kStrongest || mode > kDual || (returns_ == 2 && !model_.dual_return)) return false;
    const std::size_t banks = std::max<std::size_t>(1, static_cast<std::size_t>(model_.channels) / kReadings);
    for (std::size_t block = 0; block < kBlocks; ++block)
      if (load<std::uint16_t>(packet_, block * kBlockBytes) != kBankFlags[block % banks]) return false;
    return true;
  }

  /** With another model's timing it would not: blocks of an HDL-32E, read as a VLP-16's, turn at 0.42 times the rate.
   */
  bool turnsAsSet() const { return std::abs(rate_ - nominal_rate_) <= 0.1 * nominal_rate_; }

  /** Rotors turn at up to 20 Hz. A faster step is a gap: the jump over the part of a turn that is switched off. */
  bool isGap(int step) const
  {
    constexpr double kFastestRate = 24.0 * kTurn * 1e-9;
    return step > kFastestRate * static_cast<double>(group_period_.count());
  }

  /** Azimuth from this group to the next one; negative if the encoder went back a little. */
  int step(std::size_t group) const
  {
    const int forwards = (azimuth(group + 1) - azimuth(group) + 2 * kTurn) % kTurn;
    const bool went_back = !isGap(kTurn - forwards);
    return went_back ? forwards - kTurn : forwards;
  }

  /**
   * Finds the rotor's rate and the packet's gap. If part of the turn is switched off, a packet continues behind it, and
   * only the azimuth tells how long the gap was. It is a whole number of periods, since lasers fire at all times.
   * Rounded down: a stamp that is a little too early is better than one after the next packet's. Two gaps are damage.
   */
  void followTheRotor()
  {
    int turned = 0, periods = 0, gaps = 0, gap = 0;
    for (std::size_t group = 0; group + 1 < groups_; ++group)
    {
      const int step = this->step(group);
      if (isGap(step))
      {
        ++gaps;
        gap = step;
        first_behind_gap_ = group + 1;
        continue;
      }
      turned += step;
      ++periods;
    }
    const auto group_ns = static_cast<double>(group_period_.count());
    rate_ = periods == 0 ? nominal_rate_ : turned / (periods * group_ns);
    if (gaps != 1) return;
    // Where the rotor holds its set rate to 2 %, the set one is more exact than one measured over a packet.
    const bool governed = std::abs(rate_ - nominal_rate_) < 0.02 * nominal_rate_;
    const double rotor_rate = governed ? nominal_rate_ : std::max(rate_, nominal_rate_);
    gap_periods_ = static_cast<std::int64_t>(gap / (rotor_rate * group_ns)) - 1;
  }

  Bytes packet_;
  const VelodyneModel& model_;
  std::size_t returns_ = 1, blocks_per_group_ = 1, firings_per_group_ = 1, groups_ = kBlocks;
  Duration group_period_;
  double nominal_rate_ = 0, rate_ = 0;      // 0.01 degrees per ns
  std::size_t first_behind_gap_ = kBlocks;  // the group behind the gap
  std::int64_t gap_periods_ = 0;
};
}  // namespace

// Timing, units and product ids are those of the maker's manuals (VLP-16 63-9243, HDL-32E 63-9113, VLP-32C 63-9325);
// for the VLS-128 of the ROS driver, but with a firing every 55.277 us (driver: 53.3 us) and the product id 0xA1, as in
// the recording at hand. The first VLP-16s bear the product id of the HDL-32E.
constexpr std::array<VelodyneModel, 4> kVelodyneModels{{
    {{"VLP-16", 16, 24, 55296ns}, shotTimes(kShotsOfVlp16), 0x22, 0x21},
    {{"HDL-32E", 32, 12, 46080ns}, shotTimes(kShotsOfHdl32E), 0x21},
    {{"VLP-32C", 32, 12, 55296ns}, shotTimes(kShotsOfVlp32C), 0x28, 0, 0ns, 4},
    {{"VLS-128", 128, 3, 55277ns}, shotTimes(kShotsOfVls128), 0xA1, 0, -8700ns, 4, false},
}};

VelodyneMetadata parseVelodyneMetadata(const std::string& text, const std::string& name)
{
  const MetadataKeys keys(text, name);
  VelodyneMetadata m{readMetadata(keys, name, kVelodyneModels, 2368), 0, 0, {}};
  const auto product_id = keys.integer(kTopLevel, "product_id", 0, 255);
  m.product_id = static_cast<std::uint8_t>(product_id.value_or(m.model->product_id));
  if (!product_id) m.early_product_id = m.model->early_product_id;
  if (m.returns == 2 && !m.model->dual_return)
    keys.fail("returns",
              fmt::format("two returns of the {} are not supported: set it to strongest or last", m.model->name));
  m.vertical_offset_mm = numberPerChannel(keys, "vertical_offsets_mm", m.model->channels, 1000);
  return m;
}

std::unique_ptr<PacketDecoder> makeVelodyne(const VelodyneMetadata& metadata, const Rigid& body_T_sensor)
{
  return std::make_unique<StampedDecoder<VelodynePacket>>(metadata, body_T_sensor);
}
}  // namespace scanloom
