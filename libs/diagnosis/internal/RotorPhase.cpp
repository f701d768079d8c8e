#include "diagnosis/internal/RotorPhase.h"

#include "base/core/Statistics.h"
#include "diagnosis/internal/ClockSteps.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
constexpr std::size_t kMostTurns = 300;  // more turns do not improve the line
constexpr double kStampResolution = 1e-8;

/** One packet of each turn, or of every n-th turn if there are many, and one of the last turn. */
std::vector<NumberedPacket> oncePerTurn(const PacketRun& run, const LidarDescription& lidar, Timestamp from)
{
  std::vector<NumberedPacket> packets;
  std::int64_t turn = -1;
  for (const NumberedPacket& packet : run)
  {
    if (!packet.trace->stamp || *packet.trace->stamp <= from || packet.block / lidar.columns_per_frame <= turn)
      continue;
    turn = packet.block / lidar.columns_per_frame;
    packets.push_back(packet);
  }
  const std::size_t every = packets.size() / kMostTurns + 1;
  std::vector<NumberedPacket> kept;
  for (std::size_t i = 0; i < packets.size(); i += every) kept.push_back(packets[i]);
  if (!kept.empty() && kept.back().block != packets.back().block) kept.push_back(packets.back());
  return kept;
}

double modulo(double value, double modulus) { return value - modulus * std::floor(value / modulus); }
}  // namespace

bool RotorPhase::steady() const { return std::abs(std::remainder(at_end - at_start, turn)) < 0.01 * turn; }

std::optional<RotorPhase> rotorPhase(const std::vector<PacketRun>& runs, const LidarDescription& lidar,
                                     Duration least_step)
{
  if (runs.empty()) return std::nullopt;
  const std::vector<ClockStep> steps = clockSteps({runs.back()}, lidar, least_step);
  const std::vector<NumberedPacket> packets =
      oncePerTurn(runs.back(), lidar, steps.empty() ? Timestamp::min() : steps.back().at);
  if (packets.size() < 3) return std::nullopt;

  RotorPhase phase;
  phase.turn = 1 / lidar.frame_rate;
  const NumberedPacket& first = packets.front();
  const double period = phase.turn / lidar.columns_per_frame;  // blockPeriod() is rounded: off by up to 2.6 ppm
  std::vector<Sample2d> late;  // y: delay in s against a rotor that turns at the nominal rate; x: blocks
  std::vector<double> residuals;
  for (const NumberedPacket& packet : packets)
  {
    const auto blocks = static_cast<double>(packet.block - first.block);
    late.push_back({blocks, seconds(*packet.trace->stamp - *first.trace->stamp) - blocks * period});
  }
  const RobustLine line = theilSen(late, kStampResolution);
  for (const Sample2d& s : late) residuals.push_back(s.y - line.slope * s.x - line.intercept);
  phase.scatter = robustDeviation(residuals);
  phase.rate_error_ppm = 1e6 * (1 / (1 + line.slope / period) - 1);

  const Duration turn = fromSeconds(phase.turn);
  const double passed = static_cast<double>(first.trace->measurement_id) * period;
  const double stamp_in_turn = seconds(Duration{nanoseconds(*first.trace->stamp) % turn.count()});
  phase.at_start = modulo(stamp_in_turn - passed + line.intercept, phase.turn);
  phase.at_end = modulo(phase.at_start + line.slope * late.back().x, phase.turn);
  return phase;
}
}  // namespace scanloom
