#include "core/Bytes.h"
#include "output/PlyFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <array>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>

namespace scanloom
{
namespace
{
struct ScalarType
{
  const char* name;
  const char* other_name;
  std::size_t size;
  double (*load)(Bytes, std::size_t offset);
};

template <typename T>
constexpr ScalarType scalar(const char* name, const char* other_name)
{
  return {name, other_name, sizeof(T),
          [](Bytes bytes, std::size_t at) { return static_cast<double>(load<T>(bytes, at)); }};
}

constexpr std::array kScalarTypes{
    scalar<std::int8_t>("char", "int8"),    scalar<std::uint8_t>("uchar", "uint8"),
    scalar<std::int16_t>("short", "int16"), scalar<std::uint16_t>("ushort", "uint16"),
    scalar<std::int32_t>("int", "int32"),   scalar<std::uint32_t>("uint", "uint32"),
    scalar<float>("float", "float32"),      scalar<double>("double", "float64"),
};

struct Property
{
  std::string name;
  ScalarType type;
};

struct Header
{
  bool ascii = false;
  Timestamp time_origin;
  std::size_t vertices = 0;
  std::vector<Property> properties;  // of the vertices

  std::size_t vertexSize() const
  {
    std::size_t size = 0;
    for (const Property& property : properties) size += property.type.size;
    return size;
  }
};

ScalarType scalarType(const std::string& name)
{
  const auto named = [&](const ScalarType& type) { return name == type.name || name == type.other_name; };
  const auto found = std::find_if(kScalarTypes.begin(), kScalarTypes.end(), named);
  if (found == kScalarTypes.end()) throw std::invalid_argument(fmt::format("vertex property of type '{}'", name));
  return *found;
}

/** Reads up to and including "end_header". Throws std::invalid_argument, without the file's name, on what it cannot
 * read. */
Header readHeader(std::istream& file)
{
  Header header;
  std::string line, element;
  if (!std::getline(file, line) || line.rfind("ply", 0) != 0)
    throw std::invalid_argument("it does not start with 'ply'");
  while (std::getline(file, line) && line.rfind("end_header", 0) != 0)
  {
    std::istringstream words(line);
    std::string keyword, first, second;
    words >> keyword >> first >> second;
    if (keyword == "format")
    {
      header.ascii = first == "ascii";
      if (!header.ascii && first != "binary_little_endian") throw std::invalid_argument("format " + first);
    }
    if (keyword == "comment" && first == "time_origin_ns") header.time_origin = fromNanoseconds(std::stoll(second));
    if (keyword == "element")
    {
      if (element.empty() && first != "vertex") throw std::invalid_argument("its first element is '" + first + "'");
      if (element.empty()) header.vertices = std::stoull(second);
      element = first;
    }
    if (keyword == "property" && element == "vertex") header.properties.push_back({second, scalarType(first)});
  }
  if (!file) throw std::invalid_argument("its header has no end");
  return header;
}

/** All values of all vertices, in the file's order; throws std::invalid_argument if the file ends early. */
std::vector<double> readValues(std::istream& file, const Header& header)
{
  std::vector<double> values;
  if (header.ascii)
  {
    std::copy_n(std::istream_iterator<double>(file), header.vertices * header.properties.size(),
                std::back_inserter(values));
    if (!file) throw std::invalid_argument("it ends before its last vertex");
    return values;
  }
  const std::vector<char> text{std::istreambuf_iterator<char>(file), {}};
  const std::vector<std::uint8_t> bytes(text.begin(), text.end());
  if (header.vertexSize() > 0 && bytes.size() / header.vertexSize() < header.vertices)
    throw std::invalid_argument("it ends before its last vertex");
  std::size_t offset = 0;
  for (std::size_t i = 0; i < header.vertices; ++i)
    for (const Property& property : header.properties)
    {
      values.push_back(property.type.load(bytes, offset));
      offset += property.type.size;
    }
  return values;
}

std::uint8_t toByte(double value) { return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0))); }

PlyContent contentOf(const Header& header, const std::vector<double>& values)
{
  PlyContent content;
  content.points.resize(header.vertices);
  const std::size_t stride = header.properties.size();
  const auto copy = [&](const char* name, auto&& assign)
  {
    const auto named = [&](const Property& property) { return property.name == name; };
    const auto found = std::find_if(header.properties.begin(), header.properties.end(), named);
    if (found == header.properties.end()) return false;
    const auto first = static_cast<std::size_t>(found - header.properties.begin());
    for (std::size_t i = 0; i < header.vertices; ++i) assign(i, values[i * stride + first]);
    return true;
  };

  PointCloud& points = content.points;
  const bool has_x = copy("x", [&](std::size_t i, double v) { points.x[i] = static_cast<float>(v); });
  const bool has_y = copy("y", [&](std::size_t i, double v) { points.y[i] = static_cast<float>(v); });
  const bool has_z = copy("z", [&](std::size_t i, double v) { points.z[i] = static_cast<float>(v); });
  if (!has_x || !has_y || !has_z) throw std::invalid_argument("its vertices lack x, y or z");

  copy("intensity", [&](std::size_t i, double v) { points.intensity[i] = toByte(v); });
  copy("ring", [&](std::size_t i, double v) { points.ring[i] = toByte(v); });
  copy("sensor_id", [&](std::size_t i, double v) { points.sensor_id[i] = static_cast<std::uint8_t>(v); });
  copy("time", [&](std::size_t, double v) { content.stamps.push_back(header.time_origin + fromSeconds(v)); });
  return content;
}
}  // namespace

PlyContent readPly(const std::filesystem::path& path)
{
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::invalid_argument(fmt::format("cannot read '{}'", path.string()));
  try
  {
    const Header header = readHeader(file);
    return contentOf(header, readValues(file, header));
  }
  catch (const std::logic_error& error)  // ours and those of stoull
  {
    throw std::invalid_argument(fmt::format("'{}' is no PLY that can be read here: {}", path.string(), error.what()));
  }
}
}  // namespace scanloom
