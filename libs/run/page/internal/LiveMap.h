#pragma once
#include "run/page/internal/LiveExchange.h"

#include <tsl/robin_set.h>

#include <random>
#include <string>
#include <vector>

namespace scanloom
{
/** What one page has got so far. */
struct SeenByPage
{
  std::uint32_t map = 0, path = 0;  // epochs; 0: nothing yet
  std::size_t piece = 0, byte = 0;  // of the map
  std::size_t path_points = 0;
  std::uint32_t scan = 0;
};

/**
 * The map so far, the path and the newest scan, as bytes for pages. The map grows at its end only, so a page that comes
 * late gets all of it, and one that stays gets each point once. The points of a message are in random order: its first
 * ones are a fair sample, for a page that cannot draw all. Memory is bounded: when there are too many points, the
 * map is made coarser and a new epoch begins, in which pages get all of it again.
 *
 * Messages, little endian: u32 kind, u32 bytes that follow, then
 *
 *     1 map   u32 epoch, u32 points, f64 origin[3] (m, map frame), points
 *     2 scan  u32 number, u32 points, f64 origin[3], f64 quaternion[4] (x, y, z, w; map_T_body), points
 *     3 path  u32 epoch, u32 points, then for each f32 position[3], u32 health (PathPoint)
 *
 * with points of i16 position[3] (cm from the origin, along the map's axes), u8 reflectivity, u8 lidar.
 */
class LiveMap
{
 public:
  static constexpr std::size_t kMostPoints = 1000000, kMostPath = 50000, kScanPoints = 4000;
  static constexpr double kFinestEdge = 0.15;  // m, of the cubes with one point each

  void add(const LiveNews&);

  /** The messages that a page lacks, the newest scan first, in about `bytes`: a map that is larger comes in parts. */
  std::string lackedBy(SeenByPage&, std::size_t bytes) const;

  std::size_t points() const { return cubes_.size(); }

 private:
  struct Piece
  {
    Eigen::Vector3d origin;
    std::string points;
  };

  /** The keys of neighbours differ in a few bits, which alone would choose the same places of the table. */
  struct SpreadKeys
  {
    std::size_t operator()(std::uint64_t key) const
    {
      key *= 0x9E3779B97F4A7C15;  // 2^64 divided by the golden ratio
      return static_cast<std::size_t>(key ^ key >> 32);
    }
  };

  void addKeyframe(const PlacedCloud&);
  void addPath(const std::vector<PathPoint>&);
  void shuffle(std::string& points);
  void showScan(const PlacedCloud&);
  void makeCoarser();
  void appendMap(SeenByPage&, std::size_t bytes, std::string& messages) const;
  void appendPath(SeenByPage&, std::string& messages) const;

  double edge_ = kFinestEdge;
  std::uint32_t map_epoch_ = 1, path_epoch_ = 1, scan_number_ = 0;
  tsl::robin_set<std::uint64_t, SpreadKeys> cubes_;  // with a point
  std::vector<Piece> pieces_;
  std::vector<PathPoint> path_;
  std::string scan_;  // a whole message
  std::mt19937 random_;
};
}  // namespace scanloom
