/** What a rig yields, wherever its packets come from: captures (RigReplay) or sockets (RigLive). */
#pragma once
#include "batching/ImuOrder.h"
#include "batching/TimeBatcher.h"
#include "source/PacketRouter.h"
#include "source/Rig.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace scanloom
{
/** What one slice adds to its scan, with `slices` above 1: given out before the scan, which holds it again. */
struct ScanPart
{
  Scan scan;
};

/**
 * IMU samples and scans; both in time order. A sample comes before a scan if it is older than the scan's end by one
 * deadline or more: nobody waits for IMU packets, and they may be as late as lidar packets.
 */
using SensorEvent = std::variant<Scan, SensorImu, ScanPart>;

struct LidarAccount
{
  std::string name;
  LidarCounters counters;
};

/** What became of all that was received so far. */
struct RigAccount
{
  std::vector<LidarAccount> lidars;
  std::map<Origin, std::uint64_t> unmatched;  // datagrams that no lidar sent
  std::uint64_t late_imu_samples = 0;
  std::map<std::string, std::uint64_t> input;  // what the captures or the sockets counted, by the names of reports
  std::size_t scans_waiting = 0;               // live: for whoever calls next()
};

/** From one thread, but for stop(); account() and takeWarnings() of a live one from any. */
class RigInput
{
 public:
  virtual ~RigInput() = default;

  /** Nothing if nothing came within `patience` (a capture lets nobody wait), and nothing once ended(). */
  virtual std::optional<SensorEvent> next(Duration patience) = 0;

  /** Nothing more will come. */
  virtual bool ended() const = 0;

  /** No more is received; what has been is still given out. May be called from any thread. */
  virtual void stop() = 0;

  /** Share of the captures that was read, 0 to 1; 0 live. */
  virtual double progress() const = 0;

  virtual RigAccount account() const = 0;

  /** Live, lidars may become known or other ones on the way: their decoders in use are put into `rig`. */
  virtual void refresh(Rig&) const {}

  /** What a person should hear of, since the last call: of the lidars, the sockets, the disk. */
  virtual std::vector<std::string> takeWarnings() = 0;

  /** Waits as long as it takes; nothing at the end. */
  std::optional<SensorEvent> next();
};

/** The rig's captures, or its sockets if it has none. Throws what RigReplay and RigLive throw. */
std::unique_ptr<RigInput> openRig(const Rig&);
}  // namespace scanloom
