/** Scans and IMU samples of several lidars: the one interface for sockets, captures, rawlogs and simulated scenes. */
#pragma once
#include "base/core/StageTimes.h"
#include "input/batching/Counters.h"
#include "input/batching/ImuOrder.h"
#include "input/batching/Scan.h"
#include "input/rig/PacketRouter.h"
#include "input/rig/RecordingHeader.h"

#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace scanloom
{
struct Rig;

/** One slice of a scan, where [batcher] slices is above 1. It comes before the scan, which contains it again. */
struct ScanPart
{
  Scan scan;
};

/** A person has seen something. */
struct EventMark
{
  Timestamp stamp;  // end of the newest scan then
  std::string text;
};

/**
 * IMU samples and scans, both in time order. A sample comes before a scan if its stamp is [batcher] deadline_ms or more
 * before the scan's end: a scan is not held back for IMU packets, which may be as late as lidar packets.
 */
using SensorEvent = std::variant<Scan, SensorImu, ScanPart, EventMark>;

struct LidarAccount
{
  std::string name;
  LidarCounters counters;
  std::uint64_t of_other_senders = 0;  // packets like the lidar's, from another address
  Duration clock_offset{0};            // what is added to the lidar's stamps at present
};

/** Among the counts of an input: its files that were read only up to a damage. */
inline constexpr const char* kDamagedInputs = "damaged_files";

/** What became of everything that was received so far. */
struct RigAccount
{
  std::vector<LidarAccount> lidars;           // none if the input reads no packets
  std::map<Origin, std::uint64_t> unmatched;  // datagrams that no lidar sent
  std::uint64_t late_imu_samples = 0;
  std::uint64_t implausible_imu_samples = 0;   // stamps that the lidar's clock can't have shown
  std::map<std::string, std::uint64_t> input;  // what the captures, the sockets or the rawlog counted, by name
  std::size_t scans_waiting = 0;               // live: for whoever calls next()
};

/** By name: `<lidar>.<counter>` of the batcher, datagrams of no lidar, and what the input counted. */
std::map<std::string, std::uint64_t> countsOf(const RigAccount&);

/** Whether counts of an input, or of a run that has them, know of no damaged file. */
bool wasReadWhole(const std::map<std::string, std::uint64_t>& counts);

/** What is known of the sensors; live, and in a rawlog, it may become more with each event. */
struct SensorSetup
{
  RecordingHeader header;
  std::map<int, Rigid> body_T_imu;  // of the IMUs there are, by SensorImu::sensor
};

SensorSetup setupOf(const Rig&);

/** Used from one thread, except stop(). A live input allows account(), setup() and takeWarnings() from any thread. */
class SensorInput
{
 public:
  virtual ~SensorInput() = default;

  /**
   * Nothing if no event came within `patience`, and nothing once ended(). Files do not wait. Throws what reading
   * throws.
   */
  virtual std::optional<SensorEvent> next(Duration patience) = 0;

  /** The next event however long it takes; nothing at the end. */
  std::optional<SensorEvent> next();

  /** No more events will come. */
  virtual bool ended() const = 0;

  /** Ends the input. What was received is still given out. May be called from any thread. */
  virtual void stop() = 0;

  /** As of the event that next() gave last, or later. */
  virtual SensorSetup setup() const = 0;

  /** Share of the input that was read, 0 to 1; 0 if it is not known. */
  virtual double progress() const { return 0; }

  virtual RigAccount account() const { return {}; }

  /** Processing time of the input's own threads, by stage. */
  virtual std::map<std::string, StageTime> stages() const { return {}; }

  /** Messages for the user since the last call: about lidars, sockets, the disk, damaged files. */
  virtual std::vector<std::string> takeWarnings() { return {}; }
};
}  // namespace scanloom
