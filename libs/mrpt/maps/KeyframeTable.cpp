#include "mrpt/maps/KeyframeTable.h"

#include "base/config/Values.h"
#include "base/core/Decompositions.h"
#include "base/core/parseWhole.h"

#include <fmt/ostream.h>

#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>

namespace scanloom
{
namespace
{
constexpr std::size_t kNumbers = 21;  // of a triangle of 6 x 6

std::vector<std::string> fieldsOf(const std::string& line)
{
  std::istringstream stream(line);
  std::vector<std::string> fields;
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  return fields;
}

std::optional<KeyframeRow> rowOf(const std::string& line)
{
  const std::vector<std::string> fields = fieldsOf(line);
  if (fields.size() != 2 + kNumbers) return std::nullopt;
  const auto stamp = parseWhole<std::int64_t>(fields[0]);
  if (!stamp || (fields[1] != "0" && fields[1] != "1")) return std::nullopt;
  KeyframeRow row{fromNanoseconds(*stamp), fields[1] == "1"};
  std::size_t at = 2;
  for (Eigen::Index i = 0; i < 6; ++i)
    for (Eigen::Index j = 0; j <= i; ++j)
    {
      const auto value = parseNumber(fields[at++]);
      if (!value) return std::nullopt;
      row.covariance(i, j) = row.covariance(j, i) = *value;
    }
  return isPositiveDefinite(row.covariance) ? std::optional(row) : std::nullopt;
}
}  // namespace

KeyframeTableWriter::KeyframeTableWriter(const std::filesystem::path& path) : file_(path, Uncommitted::Stays)
{
  file_.stream() << "stamp_ns,begins_map";
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j <= i; ++j) fmt::print(file_.stream(), ",c{}{}", i, j);
  file_.stream() << '\n';
}

void KeyframeTableWriter::add(const KeyframeRow& row)
{
  fmt::print(file_.stream(), "{},{:d}", nanoseconds(row.stamp), row.begins_map);
  for (Eigen::Index i = 0; i < 6; ++i)
    for (Eigen::Index j = 0; j <= i; ++j) fmt::print(file_.stream(), ",{:.9e}", row.covariance(i, j));
  file_.stream() << '\n';
  file_.flush();
}

std::vector<KeyframeRow> readKeyframeTable(const std::filesystem::path& path)
{
  std::ifstream file(path);
  if (!file) throw std::runtime_error(fmt::format("cannot read {}", path.string()));
  std::vector<KeyframeRow> rows;
  std::string line;
  std::getline(file, line);  // names of the columns
  for (int number = 2; std::getline(file, line); ++number)
  {
    const auto row = rowOf(line);
    if (!row) throw std::runtime_error(fmt::format("{}:{}: is no row of keyframes.csv", path.string(), number));
    rows.push_back(*row);
  }
  return rows;
}
}  // namespace scanloom
