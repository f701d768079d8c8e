#include "input/lidar/internal/RobosenseMetadata.h"

#include "input/lidar/MetadataKeys.h"

#include <fmt/format.h>

namespace scanloom
{
namespace
{
const RobosenseModel& robosenseModel(const MetadataKeys& keys)
{
  std::string known;
  for (const RobosenseModel& model : kRobosenseModels)
    known += fmt::format("{}{}", known.empty() ? "" : ", ", model.name);
  const auto name = keys.text(kTopLevel, "model");
  if (!name) keys.fail("model", "is missing; known are " + known);
  const RobosenseModel* model = findRobosenseModel(*name);
  if (!model) keys.fail("model", fmt::format("'{}' is unknown; known are {}", *name, known));
  return *model;
}
}  // namespace

bool looksLikeRobosense(const std::string& text) { return namesLidar(text, "robosense"); }

RobosenseMetadata parseRobosenseMetadata(const std::string& text, const std::string& name)
{
  const MetadataKeys keys(text, name);
  RobosenseMetadata m;
  m.model = &robosenseModel(keys);
  m.serial = keys.text(kTopLevel, "serial").value_or("");
  m.rpm = keys.number(kTopLevel, "rpm", 300, 1200).value_or(m.rpm);
  m.returns = keys.integer(kTopLevel, "returns", 1, 2).value_or(m.returns);
  m.lidar_port = static_cast<std::uint16_t>(keys.integer(kTopLevel, "port", 1, 65535).value_or(m.lidar_port));

  const auto view = keys.numbers(kTopLevel, "field_of_view_deg", 0, 360).value_or(std::vector<double>{0, 360});
  if (view.size() != 2)
    keys.fail("field_of_view_deg", fmt::format("must be [first, last], not {} numbers", view.size()));
  m.first_azimuth_deg = view[0];
  m.last_azimuth_deg = view[1];

  m.angles = readAngles(keys, name, m.model->channels);
  return m;
}
}  // namespace scanloom
