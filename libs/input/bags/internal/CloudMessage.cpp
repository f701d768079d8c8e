#include "input/bags/internal/CloudMessage.h"

#include "base/formats/SecondsText.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace scanloom
{
namespace
{
struct CloudField
{
  std::string name;
  std::uint32_t offset = 0;
  std::uint8_t type = 0;  // 1 to 8 as in sensor_msgs/PointField
};

enum FieldType : std::uint8_t
{
  kInt8 = 1,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kFloat32,
  kFloat64,
};

constexpr std::array kTypeNames{"?", "int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64"};

double valueIn(Bytes point, const CloudField& field)
{
  switch (field.type)
  {
    case kInt8:
      return load<std::int8_t>(point, field.offset);
    case kUint8:
      return load<std::uint8_t>(point, field.offset);
    case kInt16:
      return load<std::int16_t>(point, field.offset);
    case kUint16:
      return load<std::uint16_t>(point, field.offset);
    case kInt32:
      return load<std::int32_t>(point, field.offset);
    case kUint32:
      return load<std::uint32_t>(point, field.offset);
    case kFloat32:
      return static_cast<double>(load<float>(point, field.offset));
    case kFloat64:
      return load<double>(point, field.offset);
    default:
      throw std::invalid_argument(fmt::format("field '{}' has the unknown type {}", field.name, field.type));
  }
}

using Fields = std::vector<CloudField>;

const CloudField* find(const Fields& fields, std::initializer_list<const char*> names)
{
  for (const char* name : names)
    for (const CloudField& field : fields)
      if (field.name == name) return &field;
  return nullptr;
}

const CloudField& fieldNamed(const Fields& fields, std::initializer_list<const char*> names)
{
  if (const CloudField* field = find(fields, names)) return *field;
  std::vector<std::string> there;
  for (const CloudField& field : fields) there.push_back(field.name);
  throw std::invalid_argument(fmt::format("a cloud without field '{}'; its fields are: {}", fmt::join(names, "' or '"),
                                          fmt::join(there, ", ")));
}

/** How a field's values become stamps. */
struct TimeUnit
{
  double nanoseconds = 1;
  bool absolute = false;
  const char* name = "ns";
};

TimeUnit unitOf(std::uint8_t type, double lowest, double highest)
{
  const double span = highest - lowest;
  if (type != kFloat32 && type != kFloat64) return span < 2e6 ? TimeUnit{1e3, false, "us"} : TimeUnit{};
  if (type == kFloat64 && lowest > 1e15) return {1, true, "ns"};
  if (type == kFloat64 && lowest > 1e8) return {1e9, true, "s"};
  if (span <= 1) return {1e9, false, "s"};
  if (span <= 1e3) return {1e6, false, "ms"};
  return span <= 1e6 ? TimeUnit{1e3, false, "us"} : TimeUnit{};
}

/** The unit in which doubles are of the header's time; none if there is no such. */
std::optional<TimeUnit> unitByHeader(std::uint8_t type, double lowest, Timestamp header)
{
  constexpr double kNear = 5;  // s
  if (type != kFloat64) return std::nullopt;
  for (const TimeUnit& unit :
       {TimeUnit{1e9, true, "s"}, TimeUnit{1e6, true, "ms"}, TimeUnit{1e3, true, "us"}, TimeUnit{1, true, "ns"}})
    if (std::abs(1e-9 * lowest * unit.nanoseconds - seconds(header.time_since_epoch())) < kNear) return unit;
  return std::nullopt;
}

/** After the header's stamp, if they are near 0 then; else of the header's time; else by their size alone. */
TimeUnit judgedUnit(std::uint8_t type, double lowest, double highest, Timestamp header)
{
  constexpr double kNearZero = 2e9;  // ns
  const TimeUnit by_size = unitOf(type, lowest, highest);
  if (!by_size.absolute && std::abs(lowest) * by_size.nanoseconds < kNearZero) return by_size;
  return unitByHeader(type, lowest, header).value_or(by_size);
}

struct CloudLayout
{
  MessageHeader header;
  Fields fields;
  std::size_t points = 0, step = 0;
  Bytes data;
};

CloudLayout layoutOf(const BagTopic& topic, Bytes bytes)
{
  constexpr std::size_t kLeastBytesOfAField = 4 + 4 + 1 + 4;
  constexpr std::size_t kMostPoints = 2'000'000;  // two returns of 128 channels in 4096 columns are 1'048'576
  MessageReader message(bytes, topic.serialisation);
  CloudLayout layout;
  layout.header = message.header();
  const std::uint64_t height = message.number<std::uint32_t>(), width = message.number<std::uint32_t>();
  for (std::size_t left = message.count(kLeastBytesOfAField); left > 0; --left)
  {
    CloudField field;
    field.name = message.string();
    field.offset = message.number<std::uint32_t>();
    field.type = message.number<std::uint8_t>();
    message.number<std::uint32_t>();  // how many of it: one
    layout.fields.push_back(field);
  }
  if (message.boolean()) throw std::invalid_argument("a big-endian cloud");
  layout.step = message.number<std::uint32_t>();
  const std::uint64_t row = message.number<std::uint32_t>();
  layout.data = message.byteSequence();
  if (layout.step == 0 || (height > 1 && row != width * layout.step))
    throw std::invalid_argument("a cloud whose rows have gaps, or whose points have no size");
  layout.points = std::min<std::uint64_t>(height * width, layout.data.size() / layout.step);
  if (layout.points > kMostPoints)
    throw std::invalid_argument(fmt::format("a cloud of {} points; a turn has at most {}", layout.points, kMostPoints));
  return layout;
}

std::uint8_t byteOf(const CloudField* field, Bytes point)
{
  if (!field) return 0;
  const double value = valueIn(point, *field);
  return value > 0 ? static_cast<std::uint8_t>(std::min(value, 255.0)) : 0;  // not for NaN
}

/** The first: those of doubles in absolute time keep a quarter of a microsecond. */
std::vector<double> timesOf(const CloudLayout& cloud, const CloudField& field)
{
  std::vector<double> times;
  for (std::size_t i = 0; i < cloud.points; ++i)
    times.push_back(valueIn(cloud.data.slice(i * cloud.step, cloud.step), field));
  return times;
}

Timestamp stampOf(double time, const TimeUnit& unit, double first, Timestamp header)
{
  const auto nanosecondsOf = [&](double t) { return static_cast<std::int64_t>(std::llround(t * unit.nanoseconds)); };
  return unit.absolute ? fromNanoseconds(nanosecondsOf(first) + nanosecondsOf(time - first))
                       : header + Duration{nanosecondsOf(time)};
}
}  // namespace

std::pair<Timestamp, Timestamp> TimedCloud::span() const
{
  const auto [earliest, latest] = std::minmax_element(
      points.begin(), points.end(), [](const TimedPoint& a, const TimedPoint& b) { return a.stamp < b.stamp; });
  return {earliest->stamp, latest->stamp};
}

bool isCloudType(const std::string& type) { return type == "sensor_msgs/PointCloud2"; }

TimedCloud timedCloudOf(const BagTopic& topic, Bytes message)
{
  const CloudLayout layout = layoutOf(topic, message);
  const CloudField &x = fieldNamed(layout.fields, {"x"}), &y = fieldNamed(layout.fields, {"y"}),
                   &z = fieldNamed(layout.fields, {"z"});
  const CloudField& time = fieldNamed(layout.fields, {"t", "time", "timestamp", "offset_time", "time_stamp"});
  const CloudField* ring = find(layout.fields, {"ring", "channel", "line"});
  const CloudField* intensity = find(layout.fields, {"intensity", "reflectivity"});

  TimedCloud cloud;
  cloud.frame = layout.header.frame;
  const std::vector<double> times = timesOf(layout, time);
  if (times.empty()) return cloud;
  if (!std::all_of(times.begin(), times.end(), [](double t) { return std::isfinite(t); }))
    throw std::invalid_argument(fmt::format("a cloud whose field '{}' holds what is no number", time.name));
  const auto [lowest, highest] = std::minmax_element(times.begin(), times.end());
  const TimeUnit unit = judgedUnit(time.type, *lowest, *highest, layout.header.stamp);
  const bool is_a_turn = (*highest - *lowest) * unit.nanoseconds <= 1e9;
  const bool is_near = std::abs(*lowest) * unit.nanoseconds < (unit.absolute ? 4e18 : 1e10);
  if (!is_a_turn || !is_near)
    throw std::invalid_argument(
        fmt::format("a cloud of {} s whose field '{}' spans {:g} to {:g}: neither a turn after the header's stamp, nor "
                    "times around it, in s, ms, us or ns",
                    secondsText(layout.header.stamp), time.name, *lowest, *highest));
  cloud.time_is = fmt::format("field '{}': {}, {}{}", time.name, kTypeNames[time.type], unit.name,
                              unit.absolute ? "" : " after the header's stamp");
  cloud.one_instant = layout.points > 1 && *highest == *lowest;
  if (cloud.one_instant) cloud.time_is += "; all points have the same";
  for (std::size_t i = 0; i < layout.points; ++i)
  {
    const Bytes point = layout.data.slice(i * layout.step, layout.step);
    cloud.points.push_back({stampOf(times[i], unit, *lowest, layout.header.stamp),
                            static_cast<float>(valueIn(point, x)), static_cast<float>(valueIn(point, y)),
                            static_cast<float>(valueIn(point, z)), byteOf(intensity, point), byteOf(ring, point)});
    cloud.channels = std::max(cloud.channels, cloud.points.back().ring + 1);
  }
  return cloud;
}
}  // namespace scanloom
