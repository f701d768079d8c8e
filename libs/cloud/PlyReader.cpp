#include "cloud/PlyReader.h"

#include "cloud/CloudText.h"
#include "core/Bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
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
  double (*load_big_endian)(Bytes, std::size_t offset);
};

template <typename T>
T loadBigEndian(Bytes bytes, std::size_t offset)
{
  const Bytes there = bytes.slice(offset, sizeof(T));
  std::array<std::uint8_t, sizeof(T)> reversed;
  std::reverse_copy(there.begin(), there.end(), reversed.begin());
  return load<T>({reversed.data(), reversed.size()}, 0);
}

template <typename T>
constexpr ScalarType scalar(const char* name, const char* other_name)
{
  return {name, other_name, sizeof(T),
          [](Bytes bytes, std::size_t at) { return static_cast<double>(load<T>(bytes, at)); },
          [](Bytes bytes, std::size_t at) { return static_cast<double>(loadBigEndian<T>(bytes, at)); }};
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

enum class Encoding
{
  Ascii,
  LittleEndian,
  BigEndian,
};

struct Header
{
  Encoding encoding = Encoding::LittleEndian;
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

Encoding encodingOf(const std::string& format)
{
  if (format == "ascii") return Encoding::Ascii;
  if (format == "binary_little_endian") return Encoding::LittleEndian;
  if (format == "binary_big_endian") return Encoding::BigEndian;
  throw std::invalid_argument("format '" + format + "'");
}

/** Reads up to and including "end_header". Throws std::invalid_argument, without the file's name, on what it cannot
 * read. */
Header readHeader(CloudText& file)
{
  Header header;
  std::string element;
  auto line = file.line();
  if (!line || line->rfind("ply", 0) != 0) throw std::invalid_argument("it does not start with 'ply'");
  for (line = file.line(); line && line->rfind("end_header", 0) != 0; line = file.line())
  {
    std::istringstream words(*line);
    std::string keyword, first, second;
    words >> keyword >> first >> second;
    if (keyword == "format") header.encoding = encodingOf(first);
    if (keyword == "comment" && first == "time_origin_ns") header.time_origin = fromNanoseconds(std::stoll(second));
    if (keyword == "element")
    {
      if (element.empty() && first != "vertex") throw std::invalid_argument("its first element is '" + first + "'");
      if (element.empty()) header.vertices = std::stoull(second);
      element = first;
    }
    if (keyword == "property" && element == "vertex") header.properties.push_back({second, scalarType(first)});
  }
  if (!line) throw std::invalid_argument("its header has no end");
  return header;
}

/** A header may promise more than memory holds: what it promises must be there. */
void requireRoomFor(const Header& header, std::size_t bytes)
{
  const bool ascii = header.encoding == Encoding::Ascii;  // a digit and a blank at least
  const std::size_t size_of_vertex = ascii ? 2 * header.properties.size() : header.vertexSize();
  if (header.vertices > 0 && size_of_vertex == 0) throw std::invalid_argument("its vertices have no properties");
  if (header.vertices > 0 && (bytes + ascii) / size_of_vertex < header.vertices)
    throw std::invalid_argument("it ends before its last vertex");
}

/** All values of all vertices, in the file's order; throws std::invalid_argument if the file ends early. */
std::vector<double> readValues(CloudText& file, const Header& header)
{
  requireRoomFor(header, file.rest().size());
  std::vector<double> values;
  values.reserve(header.vertices * header.properties.size());
  std::size_t offset = 0;
  for (std::size_t i = 0; i < header.vertices; ++i)
    for (const auto& [name, type] : header.properties)
    {
      if (header.encoding == Encoding::Ascii)
        values.push_back(file.number());
      else
        values.push_back(
            (header.encoding == Encoding::BigEndian ? type.load_big_endian : type.load)(file.rest(), offset));
      offset += type.size;
    }
  return values;
}

std::uint8_t toByte(double value) { return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0))); }

/** Calls assign(vertex, value) for all vertices if they have the property. @return whether they have it. */
template <typename Assign>
bool copyProperty(const Header& header, const std::vector<double>& values, const char* name, Assign&& assign)
{
  const auto named = [&](const Property& property) { return property.name == name; };
  const auto found = std::find_if(header.properties.begin(), header.properties.end(), named);
  if (found == header.properties.end()) return false;
  const auto first = static_cast<std::size_t>(found - header.properties.begin());
  for (std::size_t i = 0; i < header.vertices; ++i) assign(i, values[i * header.properties.size() + first]);
  return true;
}

template <typename Assign>
void copyPositions(const Header& header, const std::vector<double>& values, Assign&& assign)
{
  int axis = 0;
  for (const char* name : {"x", "y", "z"})
  {
    if (!copyProperty(header, values, name, [&](std::size_t i, double v) { assign(i, axis, static_cast<float>(v)); }))
      throw std::invalid_argument("its vertices lack x, y or z");
    ++axis;
  }
}

PlyContent contentOf(const Header& header, const std::vector<double>& values)
{
  PlyContent content;
  PointCloud& points = content.points;
  points.resize(header.vertices);
  copyPositions(header, values,
                [&](std::size_t i, int axis, float v) {
                  (axis == 0 ? points.x : axis == 1 ? points.y : points.z)[i] = v;
                });

  const auto copy = [&](const char* name, auto&& assign) { copyProperty(header, values, name, assign); };
  copy("intensity", [&](std::size_t i, double v) { points.intensity[i] = toByte(v); });
  copy("ring", [&](std::size_t i, double v) { points.ring[i] = toByte(v); });
  copy("sensor_id", [&](std::size_t i, double v) { points.sensor_id[i] = toByte(v); });
  copy("time", [&](std::size_t, double v) { content.stamps.push_back(header.time_origin + fromSeconds(v)); });
  return content;
}
}  // namespace

std::vector<Eigen::Vector3f> plyPositions(Bytes file)
{
  try
  {
    CloudText text(file);
    const Header header = readHeader(text);
    const std::vector<double> values = readValues(text, header);
    std::vector<Eigen::Vector3f> positions(header.vertices);
    copyPositions(header, values, [&](std::size_t i, int axis, float v) { positions[i][axis] = v; });
    return positions;
  }
  catch (const std::logic_error& error)  // ours and those of stoull
  {
    throw std::invalid_argument(fmt::format("is no PLY that can be read here: {}", error.what()));
  }
}

PlyContent readPly(const std::filesystem::path& path)
{
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::invalid_argument(fmt::format("cannot read '{}'", path.string()));
  const std::string content{std::istreambuf_iterator<char>(file), {}};
  try
  {
    CloudText text({reinterpret_cast<const std::uint8_t*>(content.data()), content.size()});
    const Header header = readHeader(text);
    return contentOf(header, readValues(text, header));
  }
  catch (const std::logic_error& error)
  {
    throw std::invalid_argument(fmt::format("'{}' is no PLY that can be read here: {}", path.string(), error.what()));
  }
}
}  // namespace scanloom
