#include "lab/simulation/internal/SimulatedClock.h"

namespace scanloom
{
ColumnInstant columnInstant(const LidarTiming& timing, const OusterMetadata& metadata, std::uint64_t column)
{
  const auto columns_per_frame = static_cast<std::uint64_t>(metadata.columns_per_frame);
  const double nominal = 1 / (metadata.frame_rate * metadata.columns_per_frame);
  const double since_first = static_cast<double>(column) * nominal * (1 + 1e-6 * timing.rate_error_ppm);
  const Timestamp truth = timing.start + timing.first_column + fromSeconds(since_first);
  const std::uint64_t since_frame = timing.first_measurement_id + column;
  return {truth, timing.clock.stamp(truth, timing.start),
          timing.first_frame_id + static_cast<std::uint32_t>(since_frame / columns_per_frame),
          static_cast<std::uint16_t>(since_frame % columns_per_frame)};
}
}  // namespace scanloom
