#include "input/lidar/internal/VelodyneMetadata.h"

#include "input/lidar/MetadataKeys.h"

#include <fmt/format.h>

#include <stdexcept>

namespace scanloom
{
namespace
{
const VelodyneModel& modelOf(const MetadataKeys& keys)
{
  std::string known;
  for (const VelodyneModel& model : kVelodyneModels)
    known += fmt::format("{}{}", known.empty() ? "" : ", ", model.name);
  const auto name = keys.text(kTopLevel, "model");
  if (!name) keys.fail("model", "is missing; known are " + known);
  const VelodyneModel* model = findVelodyneModel(*name);
  if (!model) keys.fail("model", fmt::format("'{}' is unknown; known are {}", *name, known));
  return *model;
}

std::vector<double> perLaser(const MetadataKeys& keys, const std::string& key, const VelodyneModel& model, double limit)
{
  auto list = keys.numbers(kTopLevel, key, -limit, limit);
  if (!list) keys.fail(key, fmt::format("is missing; expected {} numbers in the order of firing", model.channels));
  if (list->size() != static_cast<std::size_t>(model.channels))
    keys.fail(key, fmt::format("must have {} numbers in the order of firing, not {}", model.channels, list->size()));
  return *std::move(list);
}
}  // namespace

bool looksLikeVelodyne(const std::string& text) { return namesLidar(text, "velodyne"); }

VelodyneMetadata parseVelodyneMetadata(const std::string& text, const std::string& name)
{
  const MetadataKeys keys(text, name);
  const VelodyneModel& model = modelOf(keys);
  VelodyneMetadata m;
  m.model = &model;
  const auto product_id = keys.integer(kTopLevel, "product_id", 0, 255);
  m.product_id = static_cast<std::uint8_t>(product_id.value_or(model.product_id));
  if (!product_id) m.early_product_id = model.early_product_id;
  m.serial = keys.text(kTopLevel, "serial").value_or("");
  m.rpm = keys.number(kTopLevel, "rpm", 300, 1200).value_or(m.rpm);
  m.returns = keys.integer(kTopLevel, "returns", 1, 2).value_or(m.returns);
  if (m.returns == 2 && !model.dual_return)
    keys.fail("returns",
              fmt::format("two returns of the {} are not supported: set it to strongest or last", model.name));
  m.lidar_port = static_cast<std::uint16_t>(keys.integer(kTopLevel, "port", 1, 65535).value_or(m.lidar_port));

  const auto view = keys.numbers(kTopLevel, "field_of_view_deg", 0, 360).value_or(std::vector<double>{0, 360});
  if (view.size() != 2)
    keys.fail("field_of_view_deg", fmt::format("must be [first, last], not {} numbers", view.size()));
  m.first_azimuth_deg = view[0];
  m.last_azimuth_deg = view[1];

  m.vertical_deg = perLaser(keys, "vertical_angles_deg", model, 90);
  m.azimuth_offset_deg = perLaser(keys, "azimuth_offsets_deg", model, 30);
  m.vertical_offset_mm = perLaser(keys, "vertical_offsets_mm", model, 1000);
  return m;
}
}  // namespace scanloom
