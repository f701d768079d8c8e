#include "base/formats/internal/PcdReader.h"

#include "base/core/parseWhole.h"
#include "base/formats/internal/CloudText.h"

#include <fmt/format.h>
#include <lzf.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>

namespace scanloom
{
namespace
{
struct PcdField
{
  std::string name;
  std::size_t size = 4;  // bytes of one element
  std::string type = "F";
  std::size_t count = 1;  // elements

  std::size_t bytes() const { return size * count; }
};

struct PcdHeader
{
  std::vector<PcdField> fields;
  std::size_t points = 0;
  std::string data;

  std::size_t elements() const
  {
    std::size_t sum = 0;
    for (const PcdField& field : fields) sum += field.count;
    return sum;
  }
  std::size_t bytesOfPoint() const
  {
    std::size_t sum = 0;
    for (const PcdField& field : fields) sum += field.bytes();
    return sum;
  }
};

constexpr std::size_t kLargestField = 1 << 20;  // bytes or elements: sums and products cannot overflow

std::size_t parseCount(const std::string& keyword, const std::string& word, std::size_t largest)
{
  const auto count = parseWhole<std::size_t>(word);
  if (!count || *count > largest) throw std::invalid_argument(fmt::format("{} '{}'", keyword, word));
  return *count;
}

/** Reads a header line with one word per field. */
template <typename Assign>
void readFieldLine(std::vector<PcdField>& fields, std::istringstream& words, Assign&& assign)
{
  for (PcdField& field : fields)
  {
    std::string word;
    if (!(words >> word)) throw std::invalid_argument("its header has fewer sizes, types or counts than fields");
    assign(field, word);
  }
}

/** @return its keyword. */
std::string readHeaderLine(PcdHeader& header, const std::string& line)
{
  std::istringstream words(line);
  std::string keyword;
  words >> keyword;
  if (keyword == "FIELDS")
    for (std::string name; words >> name;) header.fields.push_back({name});
  if (keyword == "SIZE")
    readFieldLine(header.fields, words,
                  [](PcdField& field, const std::string& word) { field.size = parseCount("SIZE", word, 8); });
  if (keyword == "TYPE")
    readFieldLine(header.fields, words, [](PcdField& field, const std::string& word) { field.type = word; });
  if (keyword == "COUNT")
    readFieldLine(header.fields, words,
                  [](PcdField& field, const std::string& word)
                  { field.count = parseCount("COUNT", word, kLargestField); });
  std::string value;
  if (keyword == "POINTS" && words >> value) header.points = parseCount(keyword, value, SIZE_MAX);
  if (keyword == "DATA") words >> header.data;
  return keyword;
}

PcdHeader readPcdHeader(CloudText& file)
{
  PcdHeader header;
  bool has_points = false;
  while (header.data.empty())
  {
    const auto line = file.line();
    if (!line) throw std::invalid_argument("its header has no DATA");
    if (readHeaderLine(header, *line) == "POINTS") has_points = true;
  }
  if (!has_points) throw std::invalid_argument("its header has no POINTS");
  return header;
}

/** Throws std::invalid_argument if `bytes` cannot hold the header's points: before memory is reserved for them. */
void requireRoom(const PcdHeader& header, std::size_t bytes, std::size_t least_bytes_of_point)
{
  if (bytes / least_bytes_of_point < header.points) throw std::invalid_argument("it ends before its last point");
}

struct FieldsInUse
{
  std::array<std::size_t, 3> xyz{};  // their places among the fields
  std::optional<std::size_t> time;
};

FieldsInUse fieldsInUse(const PcdHeader& header)
{
  FieldsInUse used;
  const std::array names{"x", "y", "z"};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto named = [&](const PcdField& field) { return field.name == names[axis]; };
    const auto found = std::find_if(header.fields.begin(), header.fields.end(), named);
    if (found == header.fields.end()) throw std::invalid_argument("its points lack x, y or z");
    if (found->type != "F" || (found->size != 4 && found->size != 8) || found->count != 1)
      throw std::invalid_argument(fmt::format("its {} is neither float nor double", names[axis]));
    used.xyz[axis] = static_cast<std::size_t>(found - header.fields.begin());
  }
  std::vector<std::string> scalars;
  for (const PcdField& field : header.fields) scalars.push_back(field.count == 1 ? field.name : "");
  used.time = timeField(scalars);
  return used;
}

/** Elements or bytes of one point before a field. */
template <typename SizeOf>
std::size_t sumBefore(const PcdHeader& header, std::size_t field, SizeOf&& sizeOf)
{
  std::size_t sum = 0;
  for (std::size_t i = 0; i < field; ++i) sum += sizeOf(header.fields[i]);
  return sum;
}

CloudPoints asciiPoints(const PcdHeader& header, const FieldsInUse& fields, CloudText& file)
{
  const std::size_t elements = header.elements();
  requireRoom(header, file.rest().size() + 1, 2 * elements);  // a digit and a blank each
  const auto columnOf = [&](std::size_t field)
  { return sumBefore(header, field, [](const PcdField& before) { return before.count; }); };
  const std::array column{columnOf(fields.xyz[0]), columnOf(fields.xyz[1]), columnOf(fields.xyz[2])};

  CloudPoints points;
  points.positions.resize(header.points);
  std::vector<double> row(elements);
  for (Eigen::Vector3f& position : points.positions)
  {
    for (double& value : row) value = file.number();
    position = Eigen::Vector3d(row[column[0]], row[column[1]], row[column[2]]).cast<float>();
    if (fields.time) points.times.push_back(row[columnOf(*fields.time)]);
  }
  return points;
}

double numberAt(Bytes data, std::size_t at, const PcdField& field)
{
  const std::string type = field.type + std::to_string(field.size);
  if (type == "F4") return load<float>(data, at);
  if (type == "F8") return load<double>(data, at);
  if (type == "U4") return load<std::uint32_t>(data, at);
  if (type == "I4") return load<std::int32_t>(data, at);
  if (type == "U8") return static_cast<double>(load<std::uint64_t>(data, at));
  if (type == "I8") return static_cast<double>(load<std::int64_t>(data, at));
  throw std::invalid_argument(fmt::format("its {} is of type {}", field.name, type));
}

/** `offsetOf(point, field)` says where in `data` a value lies: point by point, or field by field when compressed. */
template <typename OffsetOf>
CloudPoints binaryPoints(const PcdHeader& header, const FieldsInUse& fields, Bytes data, OffsetOf&& offsetOf)
{
  CloudPoints points;
  points.positions.resize(header.points);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const bool is_double = header.fields[fields.xyz[axis]].size == 8;
    for (std::size_t i = 0; i < header.points; ++i)
    {
      const std::size_t at = offsetOf(i, fields.xyz[axis]);
      points.positions[i][static_cast<Eigen::Index>(axis)] =
          is_double ? static_cast<float>(load<double>(data, at)) : load<float>(data, at);
    }
  }
  for (std::size_t i = 0; fields.time && i < header.points; ++i)
    points.times.push_back(numberAt(data, offsetOf(i, *fields.time), header.fields[*fields.time]));
  return points;
}

std::size_t bytesBefore(const PcdHeader& header, std::size_t field)
{
  return sumBefore(header, field, [](const PcdField& before) { return before.bytes(); });
}

CloudPoints plainPoints(const PcdHeader& header, const FieldsInUse& fields, Bytes data)
{
  const std::size_t bytes_of_point = header.bytesOfPoint();
  requireRoom(header, data.size(), bytes_of_point);
  return binaryPoints(header, fields, data,
                      [&](std::size_t point, std::size_t field)
                      { return point * bytes_of_point + bytesBefore(header, field); });
}

std::vector<std::uint8_t> unpackLzf(Bytes packed, std::size_t size)
{
  constexpr std::size_t kLongestCopy = 264;  // bytes that three bytes of LZF can stand for: bounds the memory
  if (size / kLongestCopy > packed.size()) throw std::invalid_argument("its compressed data cannot hold all points");
  std::vector<std::uint8_t> unpacked(size);
  errno = 0;
  std::size_t got = 0;
  if (!packed.empty())  // of nothing, too, liblzf reads the first byte
    got = lzf_decompress(packed.data(), static_cast<unsigned>(packed.size()), unpacked.data(),
                         static_cast<unsigned>(unpacked.size()));
  if (errno == EINVAL) throw std::invalid_argument("its compressed data is damaged or cut short");
  if (errno == E2BIG || got != size)
    throw std::invalid_argument("its compressed data has another size than its points");
  return unpacked;
}

CloudPoints compressedPoints(const PcdHeader& header, const FieldsInUse& fields, Bytes data)
{
  if (data.size() < 8) throw std::invalid_argument("it ends before its last point");
  const std::size_t packed_size = load<std::uint32_t>(data, 0), size = load<std::uint32_t>(data, 4);
  if (data.size() - 8 < packed_size) throw std::invalid_argument("it ends before its last point");
  requireRoom(header, size, header.bytesOfPoint());
  const std::vector<std::uint8_t> unpacked = unpackLzf(data.slice(8, packed_size), size);
  return binaryPoints(header, fields, unpacked,
                      [&](std::size_t point, std::size_t field)
                      { return header.points * bytesBefore(header, field) + point * header.fields[field].bytes(); });
}

CloudPoints pointsAfter(const PcdHeader& header, CloudText& file)
{
  const auto fields = fieldsInUse(header);
  if (header.data == "ascii") return asciiPoints(header, fields, file);
  if (header.data == "binary") return plainPoints(header, fields, file.rest());
  if (header.data == "binary_compressed") return compressedPoints(header, fields, file.rest());
  throw std::invalid_argument(fmt::format("DATA '{}'", header.data));
}
}  // namespace

CloudPoints pcdPoints(Bytes file)
{
  try
  {
    CloudText text(file);
    const PcdHeader header = readPcdHeader(text);
    return pointsAfter(header, text);
  }
  catch (const std::logic_error& error)
  {
    throw std::invalid_argument(fmt::format("is no PCD that can be read here: {}", error.what()));
  }
}
}  // namespace scanloom
