#include "lidar/HesaiMetadata.h"

#include "lidar/AngleTable.h"
#include "lidar/MetadataKeys.h"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

namespace scanloom
{
namespace
{
const std::string kTopLevel;  // the file has no sections

const HesaiModel& modelOf(const MetadataKeys& keys)
{
  std::string known;
  for (const HesaiModel& model : kHesaiModels) known += fmt::format("{}{}", known.empty() ? "" : ", ", model.name);
  const auto name = keys.text(kTopLevel, "model");
  if (!name) keys.fail("model", "is missing; known are " + known);
  const HesaiModel* model = findHesaiModel(*name);
  if (!model) keys.fail("model", fmt::format("'{}' is unknown; known are {}", *name, known));
  return *model;
}

std::vector<double> perChannel(const MetadataKeys& keys, const std::string& key, const HesaiModel& model, double limit)
{
  auto list = keys.numbers(kTopLevel, key, -limit, limit);
  if (!list)
    keys.fail(key, fmt::format("is missing; expected {} numbers, or \"angles\": \"FILE.csv\"", model.channels));
  if (list->size() != static_cast<std::size_t>(model.channels))
    keys.fail(key, fmt::format("must have {} numbers, one per channel, not {}", model.channels, list->size()));
  return *std::move(list);
}

void readAngles(const MetadataKeys& keys, const std::string& name, HesaiMetadata& m)
{
  const auto file = keys.text(kTopLevel, "angles");
  if (!file)
  {
    m.vertical_deg = perChannel(keys, "vertical_angles_deg", *m.model, 90);
    m.azimuth_offset_deg = perChannel(keys, "azimuth_offsets_deg", *m.model, 30);
    return;
  }
  const std::string path = (std::filesystem::path(name).parent_path() / *file).string();
  AngleTable angles = parseAngleTable(readMetadataText(path), path, m.model->channels);
  m.vertical_deg = std::move(angles.vertical);
  m.azimuth_offset_deg = std::move(angles.azimuth);
}
}  // namespace

bool looksLikeHesai(const std::string& text)
{
  if (text.find("hesai") == std::string::npos) return false;  // spares parsing long files of other makers
  try
  {
    return MetadataKeys(text, "").text(kTopLevel, "lidar") == "hesai";
  }
  catch (const std::invalid_argument&)
  {
    return false;
  }
}

HesaiMetadata parseHesaiMetadata(const std::string& text, const std::string& name)
{
  const MetadataKeys keys(text, name);
  HesaiMetadata m;
  m.model = &modelOf(keys);
  m.serial = keys.text(kTopLevel, "serial").value_or("");
  m.rpm = keys.number(kTopLevel, "rpm", 300, 1200).value_or(m.rpm);
  m.returns = keys.integer(kTopLevel, "returns", 1, 2).value_or(m.returns);
  m.lidar_port = static_cast<std::uint16_t>(keys.integer(kTopLevel, "port", 1, 65535).value_or(m.lidar_port));

  const auto view = keys.numbers(kTopLevel, "field_of_view_deg", 0, 360).value_or(std::vector<double>{0, 360});
  if (view.size() != 2)
    keys.fail("field_of_view_deg", fmt::format("must be [first, last], not {} numbers", view.size()));
  m.first_azimuth_deg = view[0];
  m.last_azimuth_deg = view[1];

  readAngles(keys, name, m);
  return m;
}
}  // namespace scanloom
