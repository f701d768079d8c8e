#include "mrpt/edit/internal/GyroBias.h"

#include "base/config/Names.h"
#include "base/core/ConfigError.h"
#include "estimation/imu/ImuBuffer.h"
#include "estimation/imu/ImuInitialisation.h"
#include "mrpt/observations/ObservationReader.h"
#include "mrpt/observations/Observations.h"

#include <fmt/format.h>

#include <set>

namespace scanloom
{
namespace
{
constexpr Duration kBetweenTrials = 250ms;

/** Tests the latest samples every kBetweenTrials. */
class StandstillSearch
{
 public:
  std::optional<GyroBias> add(const RecordedImu& imu)
  {
    const Duration duration = fromSeconds(options_.duration);
    if (!samples_.add(imu.sample) || imu.sample.stamp < next_trial_) return std::nullopt;
    next_trial_ = imu.sample.stamp + kBetweenTrials;
    const Timestamp from = imu.sample.stamp - duration;
    samples_.forgetBefore(from);
    if (!samples_.coversDensely(from, imu.sample.stamp, kWidestImuGap)) return std::nullopt;
    const auto rest =
        initialiseAtRest({samples_.samples().begin(), samples_.samples().end()}, imu.body_T_imu, options_);
    if (!rest) return std::nullopt;
    return GyroBias{imu.sample.stamp, rest->state.bias.gyro};
  }

 private:
  StandstillOptions options_;
  ImuBuffer samples_;
  Timestamp next_trial_ = Timestamp::min();
};
}  // namespace

std::optional<GyroBias> gyroBiasIn(const std::filesystem::path& rawlog, const std::string& label)
{
  ObservationReader reader(rawlog);
  StandstillSearch search;
  std::set<std::string> imus;
  while (const auto observation = reader.next())
  {
    const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(observation.get());
    const auto recorded = imu ? fromObservation(*imu) : std::nullopt;
    if (!recorded) continue;
    imus.insert(recorded->label);
    if (recorded->label != label) continue;
    if (const auto bias = search.add(*recorded)) return bias;
  }
  if (imus.count(label) == 0)
    throw UsageError(fmt::format("the rawlog has no IMU with the label '{}': {}", label,
                                 imus.empty() ? "it has no IMU" : suggestion(label, {imus.begin(), imus.end()})));
  return std::nullopt;
}
}  // namespace scanloom
