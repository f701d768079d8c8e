#include "base/formats/internal/PlyReader.h"

#include "base/core/parseWhole.h"
#include "base/formats/internal/CloudText.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
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

struct PlyHeader
{
  Encoding encoding = Encoding::LittleEndian;
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

std::size_t vertexCount(const std::string& text)
{
  const auto count = parseWhole<std::size_t>(text);
  if (!count) throw std::invalid_argument("its number of vertices is '" + text + "'");
  return *count;
}

/** Reads up to and including "end_header". */
PlyHeader readPlyHeader(CloudText& file)
{
  PlyHeader header;
  std::string element;
  auto line = file.line();
  if (!line || line->rfind("ply", 0) != 0) throw std::invalid_argument("it does not start with 'ply'");
  for (line = file.line(); line && line->rfind("end_header", 0) != 0; line = file.line())
  {
    std::istringstream words(*line);
    std::string keyword, first, second;
    words >> keyword >> first >> second;
    if (keyword == "format") header.encoding = encodingOf(first);
    if (keyword == "element")
    {
      if (element.empty() && first != "vertex") throw std::invalid_argument("its first element is '" + first + "'");
      if (element.empty()) header.vertices = vertexCount(second);
      element = first;
    }
    if (keyword == "property" && element == "vertex") header.properties.push_back({second, scalarType(first)});
  }
  if (!line) throw std::invalid_argument("its header has no end");
  return header;
}

/** Throws std::invalid_argument if `bytes` cannot hold the header's vertices: before memory is reserved for them. */
void requireRoomFor(const PlyHeader& header, std::size_t bytes)
{
  const bool ascii = header.encoding == Encoding::Ascii;  // a digit and a blank at least
  const std::size_t size_of_vertex = ascii ? 2 * header.properties.size() : header.vertexSize();
  if (header.vertices > 0 && size_of_vertex == 0) throw std::invalid_argument("its vertices have no properties");
  if (header.vertices > 0 && (bytes + ascii) / size_of_vertex < header.vertices)
    throw std::invalid_argument("it ends before its last vertex");
}

/** Of x, y and z among the properties. */
std::array<std::size_t, 3> positionColumns(const PlyHeader& header)
{
  std::array<std::size_t, 3> columns{};
  const std::array names{"x", "y", "z"};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto named = [&](const Property& property) { return property.name == names[axis]; };
    const auto found = std::find_if(header.properties.begin(), header.properties.end(), named);
    if (found == header.properties.end()) throw std::invalid_argument("its vertices lack x, y or z");
    columns[axis] = static_cast<std::size_t>(found - header.properties.begin());
  }
  return columns;
}

/** The values of the vertex at `offset` in a binary file, or of the next one in an ascii file. */
void readVertex(CloudText& file, const PlyHeader& header, std::size_t offset, std::vector<double>& values)
{
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const ScalarType& type = header.properties[i].type;
    if (header.encoding == Encoding::Ascii)
      values[i] = file.number();
    else
      values[i] = (header.encoding == Encoding::BigEndian ? type.load_big_endian : type.load)(file.rest(), offset);
    offset += type.size;
  }
}

CloudPoints pointsAfter(const PlyHeader& header, CloudText& file)
{
  requireRoomFor(header, file.rest().size());
  const auto [x, y, z] = positionColumns(header);
  const std::size_t size_of_vertex = header.vertexSize();
  std::vector<double> values(header.properties.size());
  std::vector<std::string> names;
  for (const Property& property : header.properties) names.push_back(property.name);
  const std::optional<std::size_t> time = timeField(names);
  CloudPoints points;
  points.positions.resize(header.vertices);
  for (std::size_t i = 0; i < header.vertices; ++i)
  {
    readVertex(file, header, i * size_of_vertex, values);
    points.positions[i] = Eigen::Vector3d(values[x], values[y], values[z]).cast<float>();
    if (time) points.times.push_back(values[*time]);
  }
  return points;
}
}  // namespace

CloudPoints plyPoints(Bytes file)
{
  try
  {
    CloudText text(file);
    const PlyHeader header = readPlyHeader(text);
    return pointsAfter(header, text);
  }
  catch (const std::invalid_argument& error)
  {
    throw std::invalid_argument(fmt::format("is no PLY that can be read here: {}", error.what()));
  }
}
}  // namespace scanloom
