#include "input/rig/internal/LiveSensors.h"

#include "base/core/OutputFile.h"
#include "base/core/fileNameOf.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <ostream>
#include <utility>

namespace scanloom
{
namespace
{
/** Whether they differ at most by the init id: a restart alone changes neither packets nor geometry. */
bool sameButForInitId(const std::string& a, const std::string& b)
{
  const auto withoutInitId = [](const std::string& text)
  {
    nlohmann::json metadata = nlohmann::json::parse(text, nullptr, false);
    if (metadata.is_object() && metadata.contains("sensor_info")) metadata["sensor_info"].erase("initialization_id");
    return metadata;
  };
  return withoutInitId(a) == withoutInitId(b);
}
}  // namespace

LiveSensors::LiveSensors(const Rig& rig) : capture_(rig.live.capture)
{
  for (const RigSensor& sensor : rig.sensors) lidars_.push_back({sensor, sensor.options.name, 0, false, std::nullopt});
  for (LidarIndex i = 0; i < lidars_.size(); ++i)
  {
    RigSensor& lidar = lidars_[i].sensor;
    if (!lidar.sensor) continue;
    if (!lidar.metadata || lidar.sensor->configure) inquiries_.ask(i, *lidar.sensor, lidar.failure);
    lidar.sensor->configure = false;  // from here on it is only asked
    if (lidar.metadata) saveMetadata(lidars_[i]);
  }
}

void LiveSensors::saveMetadata(Lidar& lidar)
{
  if (capture_.empty()) return;
  const std::string number = ++lidar.saved > 1 ? fmt::format(".{}", lidar.saved) : "";
  std::filesystem::path file = capture_;
  file.replace_extension(fmt::format(".{}{}.json", fileNameOf(lidar.name), number));
  try
  {
    writeAtomically(file, [&](std::ostream& out) { out << lidar.sensor.metadata->text << '\n'; });
  }
  catch (const std::exception& problem)
  {
    problems_.push_back(fmt::format("lidar '{}': its metadata could not be written beside the capture: {}", lidar.name,
                                    problem.what()));
  }
}

void LiveSensors::recheck(LidarIndex lidar)
{
  if (lidar >= lidars_.size() || !lidars_[lidar].sensor.sensor) return;
  lidars_[lidar].suspect = true;
  askSuspects();
}

void LiveSensors::askSuspects()
{
  const Clock::time_point now = Clock::now();
  for (LidarIndex i = 0; i < lidars_.size(); ++i)
  {
    Lidar& lidar = lidars_[i];
    if (!lidar.suspect || (lidar.asked && now - *lidar.asked < kBetweenQuestions)) continue;
    lidar.suspect = false;
    lidar.asked = now;
    inquiries_.ask(i, *lidar.sensor.sensor);
  }
}

std::vector<LiveSensors::Change> LiveSensors::takeChanges(std::vector<std::string>& notices)
{
  askSuspects();
  for (std::string& problem : std::exchange(problems_, {})) notices.push_back(std::move(problem));
  for (const SensorInquiries::Failure& failure : inquiries_.takeFailures())
    notices.push_back(fmt::format("lidar '{}': {}", lidars_[failure.lidar].name, failure.problem));
  std::vector<Change> changes;
  for (const SensorInquiries::Answer& answer : inquiries_.take())
    if (std::optional<Change> change = changeBy(answer, notices)) changes.push_back(*std::move(change));
  return changes;
}

std::optional<LiveSensors::Change> LiveSensors::changeBy(const SensorInquiries::Answer& answer,
                                                         std::vector<std::string>& notices)
{
  Lidar& lidar = lidars_[answer.lidar];
  const bool known = lidar.sensor.metadata.has_value();
  if (known && sameButForInitId(lidar.sensor.metadata->text, answer.metadata.text)) return std::nullopt;

  RigSensor now = lidar.sensor;
  now.metadata = answer.metadata;
  try
  {
    std::shared_ptr<const PacketDecoder> decoder = decoderOf(now);
    const LidarAddress address = addressOf(now, decoder.get());
    lidar.sensor = std::move(now);
    saveMetadata(lidar);
    notices.push_back(fmt::format(
        "lidar '{}': {} is {}", lidar.name, answer.metadata.name,
        known ? "configured differently: its packets are read by its new metadata" : "known now: it joins"));
    return Change{answer.lidar, std::move(decoder), address, answer.metadata};
  }
  catch (const std::exception& problem)
  {
    notices.push_back(fmt::format("lidar '{}': {}", lidar.name, problem.what()));
    return std::nullopt;
  }
}
}  // namespace scanloom
