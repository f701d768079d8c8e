#include "input/rawlogs/PacketRawlog.h"

#include "base/core/Bytes.h"
#include "base/formats/CompressedFile.h"
#include "input/rawlogs/Conversions.h"
#include "input/rawlogs/ImuObservation.h"
#include "input/rawlogs/RawlogObservations.h"

#include <mrpt/obs/CObservationVelodyneScan.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <stdexcept>
#include <utility>

namespace scanloom
{
namespace
{
using mrpt::obs::CObservationIMU;
using mrpt::obs::CObservationVelodyneScan;
using RawPacket = CObservationVelodyneScan::TVelodyneRawPacket;

constexpr std::size_t kFirstObservations = 1000;  // an IMU may send for some seconds before the lidar

/** By its name: the class is of a lib of MRPT that this room does not need. */
bool isPointCloud(const mrpt::obs::CObservation& observation)
{
  const std::string_view name = observation.GetRuntimeClass()->className;
  constexpr std::string_view kEnd = "CObservationPointCloud";
  return name.size() >= kEnd.size() && name.substr(name.size() - kEnd.size()) == kEnd;
}

/** Not by MRPT's own function: it takes a reference to a number that is not aligned. */
std::uint32_t stampIn(const RawPacket& packet)
{
  constexpr std::size_t kStampAt = 1200;
  return load<std::uint32_t>({reinterpret_cast<const std::uint8_t*>(&packet), sizeof packet}, kStampAt);
}

/** From packet to packet of a turn; stamps are microseconds after the hour. */
Duration between(const RawPacket& first, const RawPacket& later)
{
  constexpr std::uint32_t kHour = 3'600'000'000;
  const std::uint32_t from = stampIn(first), to = stampIn(later);
  const auto passed = std::chrono::microseconds(to >= from ? to - from : to + kHour - from);
  return passed < 1s ? Duration{passed} : Duration{0};  // no turn is longer: its clock was set
}

VelodyneTurn turnOf(const CObservationVelodyneScan& scan)
{
  const bool has_receive_time = scan.originalReceivedTimestamp != INVALID_TIMESTAMP;
  const Timestamp received = fromMrpt(has_receive_time ? scan.originalReceivedTimestamp : scan.timestamp);
  VelodyneTurn turn;
  for (const RawPacket& packet : scan.scan_packets)
  {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(&packet);
    turn.packets.push_back({received + between(scan.scan_packets.front(), packet), {bytes, bytes + sizeof packet}});
  }
  return turn;
}

/** Throws std::invalid_argument for a sensor's pose that is none. */
std::optional<RawlogMeasurement> measurementOf(const mrpt::obs::CObservation& observation)
{
  if (const auto* scan = dynamic_cast<const CObservationVelodyneScan*>(&observation))
  {
    if (scan->scan_packets.empty()) return std::nullopt;
    return RawlogMeasurement{scan->sensorLabel, fromMrpt(scan->sensorPose), turnOf(*scan)};
  }
  const auto* imu = dynamic_cast<const CObservationIMU*>(&observation);
  const auto recorded = imu ? fromObservation(*imu) : std::nullopt;
  if (!recorded) return std::nullopt;
  return RawlogMeasurement{recorded->label, recorded->body_T_imu, recorded->sample};
}
}  // namespace

class PacketRawlog::Impl : public RawlogObservations
{
 public:
  using RawlogObservations::RawlogObservations;
};

PacketRawlog::PacketRawlog(const std::filesystem::path& path) : impl_(std::make_unique<Impl>(path)) {}
PacketRawlog::~PacketRawlog() = default;

bool PacketRawlog::next(RawlogMeasurement& measurement)
try
{
  while (const auto observation = impl_->next())
    if (auto measured = measurementOf(*observation))
    {
      measurement = std::move(*measured);
      return true;
    }
  return false;
}
catch (const std::invalid_argument& no_pose)
{
  impl_->endBecause(no_pose.what());
  return false;
}

const std::string& PacketRawlog::damage() const { return impl_->damage(); }
std::uint64_t PacketRawlog::bytesRead() const { return impl_->bytesRead(); }

/** MRPT writes the length of a class's name with its highest bit set, then the name. */
bool beginsLikeRawlog(std::string_view bytes)
{
  if (bytes.size() < 3 || (static_cast<unsigned char>(bytes[0]) & 0x80U) == 0) return false;
  const std::size_t length = static_cast<unsigned char>(bytes[0]) & 0x7FU;
  const std::string_view name = bytes.substr(1, length);
  const auto inName = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == ':' || c == '<' || c == '>'; };
  return name.size() == length && length > 1 && std::all_of(name.begin(), name.end(), inName);
}

bool isRawlogOfPackets(const std::filesystem::path& path)
try
{
  std::string beginning(256, '\0');
  CompressedFile file(path);
  beginning.resize(file.readUpTo(beginning.data(), beginning.size()));
  if (!beginsLikeRawlog(beginning)) return false;
  RawlogObservations observations(path);
  for (std::size_t i = 0; i < kFirstObservations; ++i)
  {
    const auto observation = observations.next();
    if (dynamic_cast<const CObservationVelodyneScan*>(observation.get())) return true;
    if (!observation || isPointCloud(*observation)) return false;
  }
  return false;
}
catch (const std::exception&)  // what can't be read holds nothing
{
  return false;
}
}  // namespace scanloom
