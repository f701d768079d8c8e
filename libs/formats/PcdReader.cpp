#include "formats/PcdReader.h"

#include "formats/CloudText.h"

#include <fmt/format.h>
#include <lzf.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
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
  std::size_t count = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), count);
  if (error != std::errc() || end != word.data() + word.size() || count > largest)
    throw std::invalid_argument(fmt::format("{} '{}'", keyword, word));
  return count;
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

using PositionFields = std::array<std::size_t, 3>;  // indices of x, y and z

PositionFields positionFields(const PcdHeader& header)
{
  PositionFields xyz{};
  const std::array names{"x", "y", "z"};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto named = [&](const PcdField& field) { return field.name == names[axis]; };
    const auto found = std::find_if(header.fields.begin(), header.fields.end(), named);
    if (found == header.fields.end()) throw std::invalid_argument("its points lack x, y or z");
    if (found->type != "F" || (found->size != 4 && found->size != 8) || found->count != 1)
      throw std::invalid_argument(fmt::format("its {} is neither float nor double", names[axis]));
    xyz[axis] = static_cast<std::size_t>(found - header.fields.begin());
  }
  return xyz;
}

/** Elements or bytes of one point before a field. */
template <typename SizeOf>
std::size_t sumBefore(const PcdHeader& header, std::size_t field, SizeOf&& sizeOf)
{
  std::size_t sum = 0;
  for (std::size_t i = 0; i < field; ++i) sum += sizeOf(header.fields[i]);
  return sum;
}

std::vector<Eigen::Vector3f> asciiPositions(const PcdHeader& header, const PositionFields& fields, CloudText& file)
{
  const std::size_t elements = header.elements();
  requireRoom(header, file.rest().size() + 1, 2 * elements);  // a digit and a blank each
  std::array<std::size_t, 3> column{};
  std::transform(fields.begin(), fields.end(), column.begin(),
                 [&](std::size_t field)
                 { return sumBefore(header, field, [](const PcdField& before) { return before.count; }); });

  std::vector<Eigen::Vector3f> positions(header.points);
  std::vector<double> row(elements);
  for (Eigen::Vector3f& position : positions)
  {
    for (double& value : row) value = file.number();
    position = Eigen::Vector3d(row[column[0]], row[column[1]], row[column[2]]).cast<float>();
  }
  return positions;
}

/** `offsetOf(point, field)` says where in `data` a value lies: point by point, or field by field when compressed. */
template <typename OffsetOf>
std::vector<Eigen::Vector3f> binaryPositions(const PcdHeader& header, const PositionFields& fields, Bytes data,
                                             OffsetOf&& offsetOf)
{
  std::vector<Eigen::Vector3f> positions(header.points);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const bool is_double = header.fields[fields[axis]].size == 8;
    for (std::size_t i = 0; i < header.points; ++i)
    {
      const std::size_t at = offsetOf(i, fields[axis]);
      positions[i][static_cast<Eigen::Index>(axis)] =
          is_double ? static_cast<float>(load<double>(data, at)) : load<float>(data, at);
    }
  }
  return positions;
}

std::size_t bytesBefore(const PcdHeader& header, std::size_t field)
{
  return sumBefore(header, field, [](const PcdField& before) { return before.bytes(); });
}

std::vector<Eigen::Vector3f> plainPositions(const PcdHeader& header, const PositionFields& fields, Bytes data)
{
  const std::size_t bytes_of_point = header.bytesOfPoint();
  requireRoom(header, data.size(), bytes_of_point);
  return binaryPositions(header, fields, data,
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

std::vector<Eigen::Vector3f> compressedPositions(const PcdHeader& header, const PositionFields& fields, Bytes data)
{
  if (data.size() < 8) throw std::invalid_argument("it ends before its last point");
  const std::size_t packed_size = load<std::uint32_t>(data, 0), size = load<std::uint32_t>(data, 4);
  if (data.size() - 8 < packed_size) throw std::invalid_argument("it ends before its last point");
  requireRoom(header, size, header.bytesOfPoint());
  const std::vector<std::uint8_t> unpacked = unpackLzf(data.slice(8, packed_size), size);
  return binaryPositions(header, fields, unpacked,
                         [&](std::size_t point, std::size_t field)
                         { return header.points * bytesBefore(header, field) + point * header.fields[field].bytes(); });
}

std::vector<Eigen::Vector3f> positionsAfter(const PcdHeader& header, CloudText& file)
{
  const auto fields = positionFields(header);
  if (header.data == "ascii") return asciiPositions(header, fields, file);
  if (header.data == "binary") return plainPositions(header, fields, file.rest());
  if (header.data == "binary_compressed") return compressedPositions(header, fields, file.rest());
  throw std::invalid_argument(fmt::format("DATA '{}'", header.data));
}
}  // namespace

std::vector<Eigen::Vector3f> pcdPositions(Bytes file)
{
  try
  {
    CloudText text(file);
    const PcdHeader header = readPcdHeader(text);
    return positionsAfter(header, text);
  }
  catch (const std::logic_error& error)
  {
    throw std::invalid_argument(fmt::format("is no PCD that can be read here: {}", error.what()));
  }
}
}  // namespace scanloom
