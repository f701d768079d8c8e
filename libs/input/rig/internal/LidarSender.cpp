#include "input/rig/internal/LidarSender.h"

#include "input/batching/Continuity.h"
#include "input/batching/PacketNumbering.h"

#include <algorithm>

namespace scanloom
{
namespace
{
// A lidar sends all packets of a turn in this many turns at least: others are lost, or it has fallen silent.
constexpr int kTurns = 4;
}  // namespace

LidarSender::LidarSender(const LidarDescription& lidar)
{
  const PacketNumbering numbering(numberedTurn(lidar));
  const int packets = numbering.packetsPerTurn();
  window_ = kTurns * packets * lidar.columns_per_packet * lidar.blockPeriod();
  of_a_lidar_ = std::max<std::int64_t>(numbering.sentBefore(packets), 1);
}

LidarSender::Verdict LidarSender::judge(const IpAddress& source, Timestamp received)
{
  const std::int64_t window = received.time_since_epoch() / window_;
  if (!sender_) sender_ = Tally{source, window, 0, 0};
  if (sender_->source == source)
  {
    count(*sender_, window);
    return Verdict::Kept;
  }
  // One rival is remembered: there may be more senders than memory should be spent on.
  if (!rival_ || (rival_->source != source && recent(*rival_, window) == 0)) rival_ = Tally{source, window, 0, 0};
  if (rival_->source != source) return Verdict::Refused;
  count(*rival_, window);
  const std::int64_t kept = recent(*sender_, window);
  if (kept >= of_a_lidar_ || recent(*rival_, window) <= kept) return Verdict::Refused;
  std::swap(sender_, rival_);
  return Verdict::TakesOver;
}

void LidarSender::count(Tally& tally, std::int64_t window)
{
  if (tally.window != window)
  {
    tally.before = window == tally.window + 1 ? tally.now : 0;
    tally.now = 0;
    tally.window = window;
  }
  ++tally.now;
}

std::int64_t LidarSender::recent(const Tally& tally, std::int64_t window)
{
  if (window == tally.window) return std::max(tally.before, tally.now);
  return window == tally.window + 1 ? tally.now : 0;
}
}  // namespace scanloom
