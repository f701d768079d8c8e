#include "mrpt/observations/RigObservations.h"

#include "input/rig/openRig.h"

#include <utility>

namespace scanloom
{
namespace
{
/** The first event may be an IMU sample of the first scan's period, which comes before that scan. */
Timestamp beforeEverything(const std::optional<SensorEvent>& first, Duration period)
{
  if (!first) return {};
  if (const auto* scan = std::get_if<Scan>(&*first)) return scan->start;
  if (const auto* part = std::get_if<ScanPart>(&*first)) return part->scan.start;
  if (const auto* mark = std::get_if<EventMark>(&*first)) return mark->stamp;
  return std::get<SensorImu>(*first).sample.stamp - period;
}
}  // namespace

mrpt::obs::CObservation::Ptr toObservation(const SensorEvent& event, const SensorSetup& setup,
                                           const DriverOptions& options)
{
  if (const auto* scan = std::get_if<Scan>(&event))
    return toObservation(*scan, cloudClassFromName(options.cloud_class), options.sensorLabel);
  if (const auto* part = std::get_if<ScanPart>(&event))
    return toObservation(part->scan, cloudClassFromName(options.cloud_class), options.sensorLabel + kSliceSuffix);
  if (const auto* mark = std::get_if<EventMark>(&event)) return toObservation(*mark);

  const auto& [sensor, sample] = std::get<SensorImu>(event);
  std::string label = "imu";
  if (sensor != SensorImu::kBody) label += "_" + setup.header.lidars.at(static_cast<std::size_t>(sensor)).name;
  return toObservation(sample, setup.body_T_imu.at(sensor), label);
}

RigObservations::RigObservations(const Rig& rig, const DriverOptions& options) : options_(options)
{
  cloudClassFromName(options_.cloud_class);
  input_ = openRig(rig);
}

mrpt::obs::CObservation::Ptr RigObservations::next()
{
  if (!header_given_)
  {
    header_given_ = true;
    first_ = input_->next();
    const RecordingHeader header = input_->setup().header;
    return toObservation(header, beforeEverything(first_, header.period()));
  }
  const std::optional<SensorEvent> event = first_ ? std::exchange(first_, std::nullopt) : input_->next();
  return event ? toObservation(*event, input_->setup(), options_) : nullptr;
}
}  // namespace scanloom
