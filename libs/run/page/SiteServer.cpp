#include "run/page/SiteServer.h"

#include "base/formats/LittleEndianBuffer.h"
#include "mrpt/maps/OctoMapFile.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace scanloom
{
namespace
{
constexpr const char *kSummary = "site.json", *kJson = "application/json", *kCsv = "text/csv; charset=utf-8",
                     *kPoses = "text/plain; charset=utf-8", *kBytes = "application/octet-stream";

std::string bytesOf(const std::filesystem::path& path)
{
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw BadRequest(kHttpNotFound, path.filename().string() + ": is not there");
  return bytes;
}

SiteIndex indexOf(const std::filesystem::path& folder)
try
{
  std::ifstream file(folder / kSummary);
  const nlohmann::json summary = nlohmann::json::parse(file);
  SiteIndex index;
  for (const nlohmann::json& drive : summary.at("drives")) index.drives.push_back(drive.at("name"));
  for (const nlohmann::json& tile : summary.at("tiles")) index.tiles.push_back(tile);
  index.tile_edge = summary.at("tile_edge");
  return index;
}
catch (const nlohmann::json::exception& error)
{
  throw std::runtime_error(fmt::format("{}: {}", (folder / kSummary).string(), error.what()));
}

/** The file's name, as "3_-2.bt", has the number of the tile's corner; `edge` is in m. */
std::string tileBytes(const std::filesystem::path& file, double edge)
{
  int east = 0, north = 0;
  if (std::sscanf(file.stem().c_str(), "%d_%d", &east, &north) != 2)
    throw BadRequest(kHttpFailed, file.string() + ": is no name of a tile");
  const auto tree = readOctoMap(file);
  std::vector<octomap::point3d> voxels;
  forEachOccupiedVoxel(*tree, [&](const octomap::point3d& at) { voxels.push_back(at); });
  const double x = east * edge, y = north * edge, z = voxels.empty() ? 0 : voxels.front().z();
  LittleEndianBuffer buffer;
  for (const double coordinate : {x, y, z}) buffer.put(coordinate);
  for (const octomap::point3d& at : voxels)
  {
    constexpr double kPerMetre = 100, kMost = std::numeric_limits<std::int16_t>::max();
    const std::array<double, 3> cm{kPerMetre * (at.x() - x), kPerMetre * (at.y() - y), kPerMetre * (at.z() - z)};
    if (std::abs(cm[2]) > kMost) continue;  // 327 m above or below the rest of its tile
    for (const double coordinate : cm) buffer.put(static_cast<std::int16_t>(std::lround(coordinate)));
  }
  std::ostringstream bytes;
  buffer.writeTo(bytes);
  return bytes.str();
}

const std::string& numbered(const std::vector<std::string>& names, const HttpRequest& request)
{
  const std::uint64_t number = request.number("number");
  if (number >= names.size()) throw BadRequest(kHttpNotFound, "there is no such number");
  return names[number];
}
}  // namespace

bool isSite(const std::filesystem::path& folder) { return std::filesystem::exists(folder / kSummary); }

SiteServer::SiteServer(const SensorAddress& address, const std::filesystem::path& site)
  : folder_(site),
    index_(indexOf(site)),
    files_(readPage()),
    server_(address, [this](const HttpRequest& request, HttpReply& reply) { answer(request, reply); })
{
}

void SiteServer::answer(const HttpRequest& request, HttpReply& reply) const
{
  if (request.method != "GET") throw BadRequest(kHttpNotAllowed, "only GET is answered");
  if (request.path == "/site.json") return reply.send(kHttpOk, kJson, bytesOf(folder_ / kSummary));
  for (const char* table : {"/loops.csv", "/references.csv", "/gone.csv"})
    if (request.path == table) return reply.send(kHttpOk, kCsv, bytesOf(folder_ / (table + 1)));
  if (request.path == "/drive")
    return reply.send(kHttpOk, kPoses, bytesOf(folder_ / "drives" / (numbered(index_.drives, request) + ".tum")));
  if (request.path == "/tile")
    return reply.send(kHttpOk, kBytes,
                      tileBytes(folder_ / "tiles" / (numbered(index_.tiles, request) + ".bt"), index_.tile_edge));
  const auto file = files_.find(request.path == "/" ? "/site.html" : request.path);
  if (file == files_.end()) throw BadRequest(kHttpNotFound, "there is no such page");
  reply.send(kHttpOk, file->second.type, file->second.bytes);
}
}  // namespace scanloom
