#include "run/page/internal/LiveMap.h"

#include "base/core/VoxelKey.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace scanloom
{
namespace
{
enum class Kind : std::uint32_t
{
  Map = 1,
  Scan = 2,
  Path = 3
};

constexpr double kPerMetre = 100;  // 1 cm
constexpr std::size_t kPointBytes = 8;

template <typename Value>
void put(std::string& bytes, Value value)
{
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);  // little endian, as all computers that Debian's MRPT runs on
  bytes.append(raw, sizeof value);
}

void put(std::string& bytes, const Eigen::Vector3d& v)
{
  for (int i = 0; i < 3; ++i) put(bytes, v[i]);
}

void putMessage(std::string& messages, Kind kind, const std::string& payload)
{
  put(messages, static_cast<std::uint32_t>(kind));
  put(messages, static_cast<std::uint32_t>(payload.size()));
  messages += payload;
}

/** False, and nothing is added, if the point is too far from the origin. */
bool putPoint(std::string& bytes, const Eigen::Vector3d& from_origin, std::uint8_t reflectivity, std::uint8_t lidar)
{
  const Eigen::Vector3d cm = kPerMetre * from_origin;
  // Also false for a point that is no number.
  if (!(cm.cwiseAbs().maxCoeff() < std::numeric_limits<std::int16_t>::max())) return false;
  for (int i = 0; i < 3; ++i) put(bytes, static_cast<std::int16_t>(std::lround(cm[i])));
  bytes.push_back(static_cast<char>(reflectivity));
  bytes.push_back(static_cast<char>(lidar));
  return true;
}

Eigen::Vector3d pointAt(const std::string& points, std::size_t byte)
{
  std::int16_t cm[3];
  std::memcpy(cm, points.data() + byte, sizeof cm);
  return Eigen::Vector3d(cm[0], cm[1], cm[2]) / kPerMetre;
}

Eigen::Vector3d placed(const PlacedCloud& cloud, std::size_t i)
{
  const Eigen::Vector3d in_body = cloud.points.positions[i].cast<double>();
  if (cloud.period <= Duration{0}) return cloud.map_T_end * in_body;
  const double share = static_cast<double>(cloud.points.t[i]) / static_cast<double>(cloud.period.count());
  return interpolate(cloud.map_T_begin, cloud.map_T_end, std::clamp(share, 0.0, 1.0)) * in_body;
}
}  // namespace

void LiveMap::add(const LiveNews& news)
{
  if (news.restarted)
  {
    cubes_.clear();
    pieces_.clear();
    path_.clear();
    scan_.clear();
    ++map_epoch_;
    ++path_epoch_;
    edge_ = kFinestEdge;
  }
  for (const PlacedCloud& keyframe : news.keyframes) addKeyframe(keyframe);
  addPath(news.path);
  if (!news.scans.empty()) showScan(news.scans.back());
}

void LiveMap::addKeyframe(const PlacedCloud& keyframe)
{
  Piece piece{keyframe.map_T_end.translation, {}};
  for (std::size_t i = 0; i < keyframe.points.size(); ++i)
  {
    const Eigen::Vector3d in_map = placed(keyframe, i);
    if (!in_map.allFinite() || !cubes_.insert(voxelKey(in_map.cast<float>(), edge_)).second) continue;
    putPoint(piece.points, in_map - piece.origin, keyframe.points.reflectivity[i], keyframe.points.lidar[i]);
  }
  shuffle(piece.points);
  if (!piece.points.empty()) pieces_.push_back(std::move(piece));
  while (cubes_.size() > kMostPoints) makeCoarser();
}

void LiveMap::shuffle(std::string& points)
{
  for (std::size_t left = points.size() / kPointBytes; left > 1; --left)
  {
    const std::size_t last = (left - 1) * kPointBytes, other = random_() % left * kPointBytes;
    std::swap_ranges(points.begin() + static_cast<std::ptrdiff_t>(last),
                     points.begin() + static_cast<std::ptrdiff_t>(last + kPointBytes),
                     points.begin() + static_cast<std::ptrdiff_t>(other));
  }
}

void LiveMap::makeCoarser()
{
  edge_ *= 1.5;
  ++map_epoch_;
  cubes_.clear();
  for (Piece& piece : pieces_)
  {
    std::string kept;
    for (std::size_t byte = 0; byte < piece.points.size(); byte += kPointBytes)
    {
      const Eigen::Vector3d in_map = piece.origin + pointAt(piece.points, byte);
      if (cubes_.insert(voxelKey(in_map.cast<float>(), edge_)).second) kept.append(piece.points, byte, kPointBytes);
    }
    piece.points = std::move(kept);
  }
  const auto is_empty = [](const Piece& piece) { return piece.points.empty(); };
  pieces_.erase(std::remove_if(pieces_.begin(), pieces_.end(), is_empty), pieces_.end());
}

void LiveMap::addPath(const std::vector<PathPoint>& points)
{
  path_.insert(path_.end(), points.begin(), points.end());
  if (path_.size() <= kMostPath) return;
  std::vector<PathPoint> half;
  for (std::size_t i = 0; i < path_.size(); ++i)
    if (i % 2 == 0 || path_[i].health == kPathBreak) half.push_back(path_[i]);
  if (half.size() > kMostPath / 2 + 1) half.erase(half.begin(), half.end() - kMostPath / 2);
  path_ = std::move(half);
  ++path_epoch_;
}

void LiveMap::showScan(const PlacedCloud& scan)
{
  const std::size_t step = std::max<std::size_t>(1, scan.points.size() / kScanPoints);
  std::string points;
  for (std::size_t i = 0; i < scan.points.size(); i += step)
    putPoint(points, placed(scan, i) - scan.map_T_end.translation, scan.points.reflectivity[i], scan.points.lidar[i]);
  std::string payload;
  put(payload, ++scan_number_);
  put(payload, static_cast<std::uint32_t>(points.size() / kPointBytes));
  put(payload, scan.map_T_end.translation);
  for (int i = 0; i < 4; ++i) put(payload, scan.map_T_end.rotation.coeffs()[i]);
  scan_.clear();
  putMessage(scan_, Kind::Scan, payload + points);
}

std::string LiveMap::lackedBy(SeenByPage& seen, std::size_t bytes) const
{
  std::string messages;
  if (seen.scan != scan_number_) messages = scan_;
  seen.scan = scan_number_;
  appendPath(seen, messages);
  if (messages.size() < bytes) appendMap(seen, bytes - messages.size(), messages);
  return messages;
}

void LiveMap::appendMap(SeenByPage& seen, std::size_t bytes, std::string& messages) const
{
  const bool anew = seen.map != map_epoch_;
  if (anew) seen.piece = seen.byte = 0;
  seen.map = map_epoch_;
  const auto message = [&](const Eigen::Vector3d& origin, const std::string& points)
  {
    std::string payload;
    put(payload, map_epoch_);
    put(payload, static_cast<std::uint32_t>(points.size() / kPointBytes));
    put(payload, origin);
    putMessage(messages, Kind::Map, payload + points);
  };
  if (anew) message(Eigen::Vector3d::Zero(), {});  // even an empty map replaces the one before
  while (seen.piece < pieces_.size() && bytes >= kPointBytes)
  {
    const Piece& piece = pieces_[seen.piece];
    const std::size_t part = std::min(bytes / kPointBytes * kPointBytes, piece.points.size() - seen.byte);
    if (part > 0) message(piece.origin, piece.points.substr(seen.byte, part));
    bytes -= part;
    seen.byte += part;
    if (seen.byte < piece.points.size()) continue;
    ++seen.piece;
    seen.byte = 0;
  }
}

void LiveMap::appendPath(SeenByPage& seen, std::string& messages) const
{
  constexpr std::size_t kMostAtOnce = 1000;
  const bool anew = seen.path != path_epoch_;
  if (anew) seen.path_points = 0;
  seen.path = path_epoch_;
  const std::size_t end = std::min(path_.size(), seen.path_points + kMostAtOnce);
  if (!anew && end == seen.path_points) return;
  std::string payload;
  put(payload, path_epoch_);
  put(payload, static_cast<std::uint32_t>(end - seen.path_points));
  for (; seen.path_points < end; ++seen.path_points)
  {
    for (int i = 0; i < 3; ++i) put(payload, path_[seen.path_points].position[i]);
    put(payload, std::uint32_t{path_[seen.path_points].health});
  }
  putMessage(messages, Kind::Path, payload);
}
}  // namespace scanloom
