#include "input/lidar/internal/Hesai.h"

#include "input/lidar/internal/calendarTime.h"

namespace scanloom
{
namespace
{
// When channels fire, in ns after their block's time: tables of the user manuals.

/** Channels that fire at regular intervals, in `groups` that fire together. */
template <std::size_t kChannels>
constexpr std::array<std::int32_t, kChannels> regularHesaiShots(std::int32_t first, std::int32_t step, int groups = 1)
{
  std::array<std::int32_t, kChannels> shots{};
  for (std::size_t i = 0; i < kChannels; ++i)
    shots[i] = first + step * static_cast<std::int32_t>(i % (kChannels / static_cast<std::size_t>(groups)));
  return shots;
}

constexpr auto kShotsOfXt16 = regularHesaiShots<16>(368, 3024);
constexpr auto kShotsOfXt32 = regularHesaiShots<32>(368, 1512);
constexpr auto kShotsOfXt32M = regularHesaiShots<32>(368, 2888, 2);

constexpr std::array<std::int32_t, 40> kShotsOf40P{
    -42220, -28470, -16040, -3620,  -45490, -31740, -47460, -54670, -20620, -33710, -40910, -8190,  -20620, -27160,
    -50730, -8190,  -14740, -36980, -45490, -52700, -23890, -31740, -38950, -11470, -18650, -25190, -48760, -6230,
    -12770, -35010, -21920, -9500,  -43520, -29770, -17350, -4920,  -42220, -28470, -16040, -3620};

constexpr std::array<std::int32_t, 64> kShotsOf64{
    -23180, -21876, -20572, -19268, -17964, -16660, -11444, -46796, -7532,  -36956, -50732, -54668, -40892,
    -44828, -31052, -34988, -48764, -52700, -38924, -42860, -29084, -33020, -46796, -25148, -36956, -50732,
    -27116, -40892, -44828, -31052, -34988, -48764, -25148, -38924, -42860, -29084, -33020, -52700, -6228,
    -54668, -15356, -27116, -10140, -23180, -4924,  -21876, -14052, -17964, -8836,  -19268, -3620,  -20572,
    -12748, -16660, -7532,  -11444, -6228,  -15356, -10140, -4924,  -3620,  -14052, -8836,  -12748};

constexpr std::array<std::int32_t, 64> kShotsOfQt64{
    12310,  14370,  16430,  18490,  20540,  22600,  24660,  26710,  29160,  31220,  33280,  35340,  37390,
    39450,  41500,  43560,  46610,  48670,  50730,  52780,  54840,  56900,  58950,  61010,  63450,  65520,
    67580,  69630,  71690,  73740,  75800,  77860,  80900,  82970,  85020,  87080,  89140,  91190,  93250,
    95300,  97750,  99820,  101870, 103930, 105980, 108040, 110100, 112150, 115200, 117260, 119320, 121380,
    123430, 125490, 127540, 129600, 132050, 134110, 136170, 138220, 140280, 142340, 144390, 146450};

/** Even blocks leave channels 1 to 32 out, odd blocks 33 to 64: these do not fire, and have the time of the first one.
 */
constexpr std::array<std::array<std::int32_t, 128>, 2> kShotsOfQt128{{
    {600,   600,   600,   600,   600,   600,   600,   600,   600,   600,   600,   600,   600,    600,   600,   600,
     600,   600,   600,   600,   600,   600,   600,   600,   600,   600,   600,   600,   600,    600,   600,   600,
     27656, 53000, 2312,  78344, 81512, 5480,  56168, 30824, 33992, 59336, 8648,  84680, 87848,  11816, 62504, 37160,
     40328, 65672, 14984, 91016, 94184, 18152, 68840, 43496, 46664, 72008, 21320, 97352, 100520, 24488, 75176, 49832,
     1456,  77488, 26800, 52144, 55312, 29968, 80656, 4624,  7792,  83824, 33136, 58480, 61648,  36304, 86992, 10960,
     14128, 90160, 39472, 64816, 67984, 42640, 93328, 17296, 20464, 96496, 45808, 71152, 74320,  48976, 99664, 23632,
     25944, 51288, 600,   76632, 79800, 3768,  54456, 29112, 32280, 57624, 6936,  82968, 86136,  10104, 60792, 35448,
     38616, 63960, 13272, 89304, 92472, 16440, 67128, 41784, 44952, 70296, 19608, 95640, 98808,  22776, 73464, 48120},
    {2312,  78344, 27656, 53000, 56168, 30824, 81512, 5480,  8648,  84680, 33992, 59336, 62504, 37160, 87848,  11816,
     14984, 91016, 40328, 65672, 68840, 43496, 94184, 18152, 21320, 97352, 46664, 72008, 75176, 49832, 100520, 24488,
     600,   600,   600,   600,   600,   600,   600,   600,   600,   600,   600,   600,   600,   600,   600,    600,
     600,   600,   600,   600,   600,   600,   600,   600,   600,   600,   600,   600,   600,   600,   600,    600,
     600,   76632, 25944, 51288, 54456, 29112, 79800, 3768,  6936,  82968, 32280, 57624, 60792, 35448, 86136,  10104,
     13272, 89304, 38616, 63960, 67128, 41784, 92472, 16440, 19608, 95640, 44952, 70296, 73464, 48120, 98808,  22776,
     26800, 52144, 1456,  77488, 80656, 4624,  55312, 29968, 33136, 58480, 7792,  83824, 86992, 10960, 61648,  36304,
     39472, 64816, 14128, 90160, 93328, 17296, 67984, 42640, 45808, 71152, 20464, 96496, 99664, 23632, 74320,  48976},
}};

constexpr HesaiTail kTailOf40P{22, 14, 16, 10, 0}, kTailOfXt{28, 10, 13, 19, 0}, kTailOfQt64{28, 16, 18, 12, 0},
    kTailOfQt128{34, 12, 15, 21, 5};

/** A Hesai data packet, read by firing: a block, or two with two returns. */
class HesaiPacket
{
 public:
  using Metadata = HesaiMetadata;
  static constexpr Duration kStampModulus{0};
  static constexpr const char* kClock = "UTC";

  HesaiPacket(Bytes packet, const HesaiMetadata& metadata)
    : packet_(packet.slice(0, metadata.model->packetBytes())),
      model_(*metadata.model),
      known_returns_(returnsOf(tail()[model_.tail.return_mode]))
  {
    if (model_.header_bytes != 0) unit_mm_ = packet_[model_.header_bytes == kShortHeader ? 5 : 9];
  }

  static PacketKind kind(Bytes packet, const HesaiMetadata& metadata)
  {
    constexpr std::size_t kPositionBytes = 512;  // GPS sentence and housekeeping, on another port
    const HesaiModel& model = *metadata.model;
    if (packet.size() == kPositionBytes) return PacketKind::Other;
    if (packet.size() != model.packetBytes() && packet.size() != model.packetBytes() + model.optional_bytes)
      return PacketKind::Malformed;
    const HesaiPacket view(packet, metadata);
    if (!view.isSound()) return PacketKind::Malformed;
    if (!view.isOfModel()) return PacketKind::Foreign;
    return view.known_returns_ == metadata.returns ? PacketKind::Lidar : PacketKind::Malformed;
  }

  /** Azimuths count clockwise from y. */
  static double encoderAngle(double azimuth) { return M_PI / 2 - azimuth * 2 * M_PI / kTurn; }

  static Eigen::Vector3d origin(const HesaiMetadata&, std::size_t) { return Eigen::Vector3d::Zero(); }

  std::optional<Timestamp> stamp() const
  {
    const Bytes tail = this->tail(), date = tail.slice(model_.tail.date, 6);
    const auto microseconds = load<std::uint32_t>(tail, model_.tail.microseconds);
    const std::optional<Timestamp> second = timestampOf({yearOf(date[0]), date[1], date[2], date[3], date[4], date[5]});
    if (!second || microseconds > 1'000'000) return std::nullopt;
    return *second + std::chrono::microseconds{microseconds};
  }

  int returns() const { return known_returns_ == 2 ? 2 : 1; }
  double unitMm() const { return unit_mm_; }
  std::size_t firings() const { return static_cast<std::size_t>(model_.firings / returns()); }

  Firing firing(std::size_t index) const
  {
    const std::size_t first_block = index * static_cast<std::size_t>(returns());
    const auto azimuth = load<std::uint16_t>(block(first_block), model_.azimuth_at);
    const auto from_stamp =
        static_cast<std::int64_t>(index) - (model_.stamp_begins ? 0 : static_cast<std::int64_t>(firings()) - 1);
    Firing firing;
    firing.shots = model_.shots[loopOf(index)];
    firing.after_stamp = model_.block_after_stamp + model_.period * from_stamp + Duration{firing.shots.first};
    firing.azimuth = azimuth % kTurn;
    firing.valid = azimuth <= kTurn;
    if (returns() == 2 && load<std::uint16_t>(block(first_block + 1), model_.azimuth_at) != azimuth)
      firing.valid = false;
    return firing;
  }

  Reading reading(std::size_t firing, std::size_t channel, std::size_t which) const
  {
    const Bytes reading = block(firing * static_cast<std::size_t>(returns()) + which)
                              .slice(model_.azimuth_at + 2 + channel * model_.reading_bytes, model_.reading_bytes);
    return {load<std::uint16_t>(reading, 0), reading[2]};
  }

 private:
  static constexpr std::size_t kShortHeader = 8;

  /** 0: unknown, or three of an XT32M. */
  static int returnsOf(std::uint8_t mode)
  {
    switch (mode)
    {
      case 0x33:  // first
      case 0x34:  // second
      case 0x37:  // strongest
      case 0x38:  // last
        return 1;
      case 0x39:  // last and strongest
      case 0x3A:  // first and second
      case 0x3B:  // first and last
      case 0x3C:  // first and strongest
      case 0x3E:  // strongest and second strongest
        return 2;
      default:
        return 0;
    }
  }

  /** Sensors count years from 1900 or, some firmware of the 40P, from 2000. */
  static int yearOf(std::uint8_t byte) { return byte + (byte < 100 ? 2000 : 1900); }

  Bytes tail() const { return packet_.slice(model_.tailAt(), model_.tail.bytes); }
  Bytes block(std::size_t index) const
  {
    return packet_.slice(model_.header_bytes + index * model_.blockBytes(), model_.blockBytes());
  }

  /** Even and odd blocks of a QT128 fire in different orders; a packet with one firing has a flag for it. */
  std::size_t loopOf(std::size_t firing) const
  {
    if (model_.shots[1].of_channel == nullptr) return 0;
    return firings() > 1 ? firing % 2 : static_cast<std::size_t>(1 - (tail()[model_.tail.loop] & 1));
  }

  /** By channels, blocks and version of the protocol in the header. True for packets without a header. */
  bool isOfModel() const
  {
    if (model_.header_bytes == 0) return true;
    const std::size_t counts = model_.header_bytes == kShortHeader ? 2 : 6;
    if (packet_[counts] != model_.channels || packet_[counts + 1] != model_.firings) return false;
    const bool any = model_.protocol_major == 0 && model_.protocol_minor == 0;
    return any || (packet_[2] == model_.protocol_major && packet_[3] == model_.protocol_minor);
  }

  /** Whether markers, unit and return mode are such that the rest can be read. */
  bool isSound() const
  {
    constexpr std::uint16_t kBlockMarker = 0xEEFF, kPacketMarker = 0xFFEE;  // FF EE and EE FF on the wire
    if (known_returns_ == 0 || unit_mm_ == 0) return false;
    if (model_.header_bytes != 0 && load<std::uint16_t>(packet_, 0) != kPacketMarker) return false;
    if (model_.azimuth_at == 0) return true;
    for (std::size_t i = 0; i < static_cast<std::size_t>(model_.firings); ++i)
      if (load<std::uint16_t>(block(i), 0) != kBlockMarker) return false;
    return true;
  }

  Bytes packet_;
  const HesaiModel& model_;
  int known_returns_ = 0;  // by the return mode
  int unit_mm_ = 4;
};
}  // namespace

// Layouts and times are those of the user manuals (for the QT64 and QT128 as drivers have them). Blocks of the XT32M
// count from the sixth like the blocks of its packets; drivers count from an eighth, which there is not. The QT128's
// first block is before its second one, as azimuths show; a driver has them reversed.
constexpr std::array<HesaiModel, 7> kHesaiModels{{
    {{"40P", 40, 10, 55560ns}, 0, 0, 0, 2, 3, 0, kTailOf40P, 4, false, -28580ns, {shotTimes(kShotsOf40P)}},
    {{"64", 64, 6, 55560ns}, 8, 0, 0, 0, 3, 0, kTailOf40P, 4, false, -42580ns, {shotTimes(kShotsOf64)}},
    {{"XT16", 16, 8, 50000ns}, 12, 6, 1, 0, 4, 0, kTailOfXt, 0, false, 5632ns, {shotTimes(kShotsOfXt16)}},
    {{"XT32", 32, 8, 50000ns}, 12, 6, 1, 0, 4, 0, kTailOfXt, 0, false, 5632ns, {shotTimes(kShotsOfXt32)}},
    {{"XT32M", 32, 6, 50000ns}, 12, 6, 1, 0, 4, 0, kTailOfXt, 0, false, 5632ns, {shotTimes(kShotsOfXt32M)}},
    {{"QT64", 64, 4, 166667ns}, 12, 0, 0, 0, 4, 0, kTailOfQt64, 0, true, 25710ns, {shotTimes(kShotsOfQt64)}},
    {{"QT128", 128, 2, 111110ns},
     12,
     3,
     2,
     0,
     4,
     21,
     kTailOfQt128,
     32,
     false,
     9000ns,
     {shotTimes(kShotsOfQt128[0]), shotTimes(kShotsOfQt128[1])}},
}};

HesaiMetadata parseHesaiMetadata(const std::string& text, const std::string& name)
{
  return readMetadata(MetadataKeys(text, name), name, kHesaiModels, 2368);
}

std::unique_ptr<PacketDecoder> makeHesai(const HesaiMetadata& metadata, const Rigid& body_T_sensor)
{
  return std::make_unique<StampedDecoder<HesaiPacket>>(metadata, body_T_sensor);
}
}  // namespace scanloom
