#include "site/SiteFiles.h"

#include "base/core/OutputFile.h"
#include "base/core/csvField.h"
#include "base/core/jsonText.h"
#include "base/formats/Trajectory.h"
#include "mrpt/maps/MapFiles.h"
#include "mrpt/maps/MapPicture.h"
#include "mrpt/maps/SimpleMapFile.h"
#include "site/internal/MapTile.h"
#include "site/internal/SiteTiles.h"

#include <fmt/ostream.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace scanloom
{
namespace
{
constexpr const char *kMap = "keyframes.simplemap", *kPieces = "pieces", *kDrives = "drives", *kLoops = "loops.csv",
                     *kReferences = "references.csv", *kTiles = "tiles", *kGone = "gone.csv", *kPicture = "site.png",
                     *kSummary = "site.json";

Timestamp stampOf(const SiteKeyframe& keyframe, const std::vector<SiteDrive>& drives)
{
  return drives[keyframe.drive].keyframes()[keyframe.index].stamp;
}

/** Number of each keyframe's piece, from 1. */
std::vector<std::size_t> pieceByKeyframe(const Site& site)
{
  std::vector<std::size_t> piece(site.keyframes.size());
  for (std::size_t p = 0; p < site.pieces.size(); ++p)
    for (const std::size_t i : site.pieces[p].keyframes) piece[i] = p + 1;
  return piece;
}

void writeMap(const std::filesystem::path& file, const SitePiece& piece, const Site& site,
              const PlacedKeyframes& placed)
{
  SimpleMapWriter map(file, placed.lidars());
  for (const std::size_t i : piece.keyframes) map.add({placed.at(i), site.keyframes[i].covariance});
  map.close();
}

/** Pictures hold no coordinates of a country. */
Rigid lessBy(const Eigen::Vector3d& offset, Rigid pose)
{
  pose.translation -= offset;
  return pose;
}

std::vector<Trajectory> pathsOf(std::size_t piece, const Site& site, const std::vector<SiteDrive>& drives,
                                const Eigen::Vector3d& offset)
{
  std::vector<Trajectory> paths;
  for (std::size_t d = 0; d < drives.size(); ++d)
    for (const DrivePiece& part : piecesOf(d, site, drives))
    {
      if (part.piece != piece) continue;
      paths.emplace_back();
      for (const StampedPose& pose : trajectoryIn(site, drives, d))
        if (pose.stamp >= part.begin && pose.stamp <= part.end)
          paths.back().push_back({pose.stamp, lessBy(offset, pose.map_T_body)});
    }
  return paths;
}

void writeLoops(const std::filesystem::path& file, const Site& site, const std::vector<SiteDrive>& drives,
                const std::vector<std::string>& names)
{
  OutputFile output(file);
  output.stream() << "from_drive,from_stamp_ns,to_drive,to_stamp_ns,decision,agreement,reach_m,distance_sigma,"
                     "x,y,z,qx,qy,qz,qw\n";
  for (const Loop& loop : site.loops)
  {
    const SiteKeyframe &from = site.keyframes[loop.from], &to = site.keyframes[loop.to];
    const Eigen::Vector3d& t = loop.from_T_to.translation;
    const Eigen::Quaterniond& q = loop.from_T_to.rotation;
    fmt::print(output.stream(),
               "{},{},{},{},{},{:.3f},{:.2f},{:.2f},{:.4f},{:.4f},{:.4f},{:.6f},{:.6f},{:.6f},{:.6f}\n",
               csvField(names[from.drive]), nanoseconds(stampOf(from, drives)), csvField(names[to.drive]),
               nanoseconds(stampOf(to, drives)), toString(loop.decision), loop.agreement, loop.reach, loop.distance,
               t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
  }
  output.commit();
}

void writeReferences(const std::filesystem::path& file, const Site& site, const std::vector<std::string>& names)
{
  OutputFile output(file);
  output.stream() << "stamp_ns,drive,name,x,y,z,used,residual_x,residual_y,residual_z\n";
  for (const ReferencePosition& at : site.references)
    fmt::print(output.stream(), "{},{},{},{:.4f},{:.4f},{:.4f},{:d},{:.4f},{:.4f},{:.4f}\n", nanoseconds(at.stamp),
               csvField(names[site.keyframes[at.keyframe].drive]), csvField(at.name), at.measured.x(), at.measured.y(),
               at.measured.z(), at.used, at.residual.x(), at.residual.y(), at.residual.z());
  output.commit();
}

std::vector<MapLink> linksOf(std::size_t number, const Site& site, const Eigen::Vector3d& offset)
{
  const std::vector<std::size_t> piece = pieceByKeyframe(site);
  std::vector<MapLink> links;
  for (const Loop& loop : site.loops)
    if (piece[loop.from] == number && piece[loop.to] == number)
      links.push_back({site.keyframes[loop.from].site_T_body.translation - offset,
                       site.keyframes[loop.to].site_T_body.translation - offset,
                       loop.decision == LoopDecision::Accepted});
  return links;
}

void writePicture(const std::filesystem::path& file, const Site& site, const std::vector<SiteDrive>& drives,
                  const PlacedKeyframes& placed)
{
  const Eigen::Vector3d& offset = placed.offset();
  MapPicture picture(MapPictureOptions{});
  for (const std::size_t i : site.pieces.front().keyframes) picture.add(placed.lessOffset(i));
  std::string title = "site at breast height";
  if (!offset.isZero()) title += fmt::format(", coordinates less {:.0f} {:.0f} m", offset.x(), offset.y());
  picture.write(file, pathsOf(1, site, drives, offset), title, linksOf(1, site, offset));
}

void writeGone(const std::filesystem::path& file, const std::vector<GoneThing>& gone,
               const std::vector<std::string>& names)
{
  OutputFile output(file);
  output.stream() << "x,y,z,height,width,gone_by\n";
  for (const GoneThing& thing : gone)
    fmt::print(output.stream(), "{:.2f},{:.2f},{:.2f},{:.1f},{:.1f},{}\n", thing.foot.x(), thing.foot.y(),
               thing.foot.z(), thing.height, thing.width, csvField(names[thing.gone_by]));
  output.commit();
}

nlohmann::json toJson(const Site& site, const std::vector<SiteDrive>& drives, const std::vector<std::string>& names)
{
  nlohmann::json json;
  for (std::size_t d = 0; d < drives.size(); ++d)
  {
    nlohmann::json pieces = nlohmann::json::array();
    for (const DrivePiece& part : piecesOf(d, site, drives))
      pieces.push_back(
          {{"piece", part.piece}, {"begin_ns", nanoseconds(part.begin)}, {"end_ns", nanoseconds(part.end)}});
    json["drives"].push_back({{"name", names[d]}, {"folder", drives[d].folder().string()}, {"pieces", pieces}});
  }
  for (const SitePiece& piece : site.pieces)
    json["pieces"].push_back(
        {{"keyframes", piece.keyframes.size()}, {"in_reference_frame", piece.is_in_reference_frame}});
  json["loops"] = nlohmann::json::object();
  for (const Loop& loop : site.loops)
  {
    nlohmann::json& count = json["loops"][toString(loop.decision)];
    count = count.is_null() ? 1 : count.get<int>() + 1;
  }
  return json;
}
}  // namespace

std::vector<std::string> siteFiles()
{
  return {kMap, kPieces, kDrives, kLoops, kReferences, kTiles, kGone, kPicture, kSummary};
}

std::vector<std::string> namesOf(const std::vector<SiteDrive>& drives)
{
  std::vector<std::string> names;
  for (const SiteDrive& drive : drives)
  {
    const std::filesystem::path path = std::filesystem::canonical(drive.folder());
    const std::string own = path.filename().string();
    std::string name = own;
    if (std::find(names.begin(), names.end(), name) != names.end())
      name = path.parent_path().filename().string() + "_" + own;
    for (int number = 2; std::find(names.begin(), names.end(), name) != names.end(); ++number)
      name = fmt::format("{}_{}", own, number);
    names.push_back(name);
  }
  return names;
}

std::vector<DrivePiece> piecesOf(std::size_t drive, const Site& site, const std::vector<SiteDrive>& drives)
{
  const std::vector<std::size_t> piece = pieceByKeyframe(site);
  std::vector<DrivePiece> pieces;
  for (std::size_t i = 0; i < site.keyframes.size(); ++i)
  {
    if (site.keyframes[i].drive != drive) continue;
    const Timestamp stamp = stampOf(site.keyframes[i], drives);
    if (pieces.empty() || pieces.back().piece != piece[i]) pieces.push_back({piece[i], stamp, stamp});
    pieces.back().end = stamp;
  }
  return pieces;
}

Trajectory trajectoryIn(const Site& site, const std::vector<SiteDrive>& drives, std::size_t drive)
{
  const auto first = std::find_if(site.keyframes.begin(), site.keyframes.end(),
                                  [&](const SiteKeyframe& keyframe) { return keyframe.drive == drive; });
  const std::vector<DriveKeyframe>& keyframes = drives[drive].keyframes();
  const auto placed = [&](std::size_t index, const Rigid& drive_T_body)
  {
    return first[static_cast<std::ptrdiff_t>(index)].site_T_body * keyframes[index].drive_T_body.inverse() *
           drive_T_body;
  };
  Trajectory trajectory;
  std::size_t next = 0;  // the first keyframe after the pose
  for (const StampedPose& pose : drives[drive].trajectory())
  {
    while (next < keyframes.size() && keyframes[next].stamp <= pose.stamp) ++next;
    const std::size_t before = next == 0 ? 0 : next - 1;
    Rigid site_T_body = placed(before, pose.map_T_body);
    if (next > 0 && next < keyframes.size() && !keyframes[next].begins_a_part)
    {
      const double share =
          seconds(pose.stamp - keyframes[before].stamp) / seconds(keyframes[next].stamp - keyframes[before].stamp);
      site_T_body = interpolate(site_T_body, placed(next, pose.map_T_body), share);
    }
    trajectory.push_back({pose.stamp, site_T_body});
  }
  return trajectory;
}

SiteMap writeSite(const std::filesystem::path& folder, const Site& site, const std::vector<SiteDrive>& drives,
                  const SiteFrame& frame, const SiteProgress& progress)
{
  const std::vector<std::string> names = namesOf(drives);
  std::filesystem::create_directories(folder / kDrives);
  for (std::size_t d = 0; d < drives.size(); ++d)
    writeTum(folder / kDrives / (names[d] + ".tum"), trajectoryIn(site, drives, d));
  writeLoops(folder / kLoops, site, drives, names);
  if (!site.references.empty()) writeReferences(folder / kReferences, site, names);

  PlacedKeyframes placed(site, drives);
  std::filesystem::create_directories(folder / kTiles);
  WrittenTiles written = writeTiles(folder / kTiles, site, placed, progress);
  placed.leaveOut(std::move(written.gone_voxels));
  const bool in_frame = site.pieces.front().is_in_reference_frame;
  if (frame.grid && in_frame) writePointTiles(folder / kTiles, written.tiles, placed, frame);
  writeGone(folder / kGone, written.gone, names);

  for (std::size_t p = 0; p < site.pieces.size(); ++p)
  {
    if (p == 1) placed.leaveOut({}), std::filesystem::create_directories(folder / kPieces);
    const std::filesystem::path file = p == 0 ? folder / kMap : folder / kPieces / fmt::format("{}.simplemap", p + 1);
    writeMap(file, site.pieces[p], site, placed);
    if (p == 0) writePicture(folder / kPicture, site, drives, placed);
  }
  nlohmann::json json = toJson(site, drives, names);
  for (const auto& [tile, near] : written.tiles) json["tiles"].push_back(nameOf(tile));
  json["tile_edge"] = kTileEdge;
  json["coordinates_less"] = {placed.offset().x(), placed.offset().y(), placed.offset().z()};
  json["gone"] = written.gone.size();
  if (const auto& origin = frame.origin; origin && in_frame)
    json["east_north_up_of"] = {
        {"latitude", origin->latitude}, {"longitude", origin->longitude}, {"height", origin->height}};
  writeAtomically(folder / kSummary, [&](std::ostream& file) { file << jsonText(json) << '\n'; });
  return {written.tiles.size(), std::move(written.gone)};
}
}  // namespace scanloom
