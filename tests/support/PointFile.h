/** Just enough of PLY and PCD for the recorded clouds that registration is tested on. */
#pragma once
#include <Eigen/Core>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace scanloom
{
/** Binary little-endian PLY whose first three properties are float x, y, z and all others float as well. */
inline std::vector<Eigen::Vector3f> readPly(const std::filesystem::path& path)
{
  std::ifstream file(path, std::ios::binary);
  std::size_t points = 0, floats = 0;
  for (std::string line; std::getline(file, line) && line != "end_header";)
  {
    if (line.rfind("element vertex ", 0) == 0) points = std::stoul(line.substr(15));
    if (line.rfind("property float ", 0) == 0) ++floats;
  }
  std::vector<float> values(points * floats);
  if (!file.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(4 * values.size())))
    throw std::runtime_error(path.string() + ": shorter than its header says");
  std::vector<Eigen::Vector3f> cloud(points);
  for (std::size_t i = 0; i < points; ++i) cloud[i] = Eigen::Map<const Eigen::Vector3f>(&values[i * floats]);
  return cloud;
}

/** LZF, the compression inside "DATA binary_compressed". */
inline std::vector<std::uint8_t> unpackLzf(const std::vector<std::uint8_t>& packed, std::size_t size)
{
  std::vector<std::uint8_t> out;
  out.reserve(size);
  for (std::size_t i = 0; i < packed.size();)
  {
    const std::size_t control = packed.at(i++);
    if (control < 32)
    {
      for (std::size_t k = 0; k <= control; ++k) out.push_back(packed.at(i++));
      continue;
    }
    std::size_t length = control >> 5;
    if (length == 7) length += packed.at(i++);
    const std::size_t back = ((control & 31) << 8) + packed.at(i++) + 1;
    for (std::size_t k = 0; k < length + 2; ++k) out.push_back(out.at(out.size() - back));
  }
  if (out.size() != size) throw std::runtime_error("LZF: unpacked size differs");
  return out;
}

/** Compressed PCD whose first three fields are float x, y, z: stored field by field. */
inline std::vector<Eigen::Vector3f> readPcd(const std::filesystem::path& path)
{
  std::ifstream file(path, std::ios::binary);
  std::size_t points = 0;
  for (std::string line; std::getline(file, line) && line != "DATA binary_compressed";)
    if (line.rfind("POINTS ", 0) == 0) points = std::stoul(line.substr(7));
  std::uint32_t sizes[2];
  file.read(reinterpret_cast<char*>(sizes), sizeof sizes);
  const std::vector<std::uint8_t> packed((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const auto bytes = unpackLzf({packed.begin(), packed.begin() + sizes[0]}, sizes[1]);
  std::vector<Eigen::Vector3f> cloud(points);
  for (std::size_t i = 0; i < points; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) std::memcpy(&cloud[i][axis], &bytes.at((axis * points + i) * 4), 4);
  return cloud;
}

/** Uncompressed binary PCD whose first three fields are float x, y, z: stored point by point. */
inline std::vector<Eigen::Vector3f> readPlainPcd(const std::filesystem::path& path)
{
  std::ifstream file(path, std::ios::binary);
  std::size_t points = 0, bytes_of_point = 0;
  for (std::string line; std::getline(file, line) && line != "DATA binary";)
  {
    if (line.rfind("POINTS ", 0) == 0) points = std::stoul(line.substr(7));
    std::istringstream sizes(line.rfind("SIZE ", 0) == 0 ? line.substr(5) : "");
    for (std::size_t size = 0; sizes >> size;) bytes_of_point += size;
  }
  const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (bytes.size() < points * bytes_of_point || bytes_of_point < sizeof(Eigen::Vector3f))
    throw std::runtime_error(path.string() + ": shorter than its header says");
  std::vector<Eigen::Vector3f> cloud(points);
  for (std::size_t i = 0; i < points; ++i) std::memcpy(cloud[i].data(), &bytes[i * bytes_of_point], sizeof cloud[i]);
  return cloud;
}
}  // namespace scanloom
