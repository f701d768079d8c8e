#include "input/lidar/internal/StampedDecoder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

namespace scanloom
{
std::size_t rowOfModel(const MetadataKeys& keys, const std::vector<std::string_view>& names)
{
  const auto name = keys.text(kTopLevel, "model");
  const std::string known = fmt::format("known are {}", fmt::join(names, ", "));
  if (!name) keys.fail("model", "is missing; " + known);
  const auto row = std::find(names.begin(), names.end(), *name);
  if (row == names.end()) keys.fail("model", fmt::format("'{}' is unknown; {}", *name, known));
  return static_cast<std::size_t>(row - names.begin());
}

StampedSettings readSettings(const MetadataKeys& keys, const std::string& file_name, int channels, std::uint16_t port)
{
  StampedSettings s;
  s.serial = keys.text(kTopLevel, "serial").value_or("");
  s.rpm = keys.number(kTopLevel, "rpm", 300, 1200).value_or(s.rpm);  // what makers let a rotor be set to
  s.returns = keys.integer(kTopLevel, "returns", 1, 2).value_or(s.returns);
  s.port = static_cast<std::uint16_t>(keys.integer(kTopLevel, "port", 1, 65535).value_or(port));

  const auto view = keys.numbers(kTopLevel, "field_of_view_deg", 0, 360).value_or(std::vector<double>{0, 360});
  if (view.size() != 2)
    keys.fail("field_of_view_deg", fmt::format("must be [first, last], not {} numbers", view.size()));
  s.first_azimuth_deg = view[0];
  s.last_azimuth_deg = view[1];
  s.angles = readAngles(keys, file_name, channels);
  return s;
}

LidarDescription describe(const StampedModel& model, const StampedSettings& settings, const Rigid& body_T_sensor,
                          Duration stamp_modulus, const char* clock)
{
  LidarDescription d;
  d.model = model.name;
  d.serial = settings.serial;
  d.channels = model.channels;
  d.frame_rate = settings.rpm / 60;
  d.columns_per_frame = static_cast<int>(std::lround(1 / (d.frame_rate * seconds(model.period))));
  d.columns_per_packet = model.firings / settings.returns;
  d.first_column = columnOf(100 * settings.first_azimuth_deg, d.columns_per_frame);
  d.last_column = columnOf(100 * settings.last_azimuth_deg, d.columns_per_frame);
  d.returns = settings.returns;
  d.frame_id_modulus = 1;  // there are no frame ids: all are 0
  d.numbering = Numbering::Stamps;
  d.stamp_modulus = stamp_modulus;
  d.fixed_block_period = model.period;
  d.lidar_port = settings.port;
  d.body_T_sensor = body_T_sensor;
  d.clock = clock;
  return d;
}

int columnOf(double azimuth, int columns)
{
  // Sensors do send 360.00 degrees: that is the last column, not one more.
  return std::clamp(static_cast<int>(azimuth * columns / kTurn), 0, columns - 1);
}

std::vector<std::uint8_t> ringsFromTheTop(const std::vector<double>& vertical_deg)
{
  std::vector<std::size_t> from_the_top(vertical_deg.size());
  std::iota(from_the_top.begin(), from_the_top.end(), 0);
  std::stable_sort(from_the_top.begin(), from_the_top.end(),
                   [&](std::size_t a, std::size_t b) { return vertical_deg[a] > vertical_deg[b]; });
  std::vector<std::uint8_t> rings(vertical_deg.size());
  for (std::size_t place = 0; place < rings.size(); ++place)
    rings[from_the_top[place]] = static_cast<std::uint8_t>(place);
  return rings;
}
}  // namespace scanloom
