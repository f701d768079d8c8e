#include "lab/simulation/internal/Wood.h"

#include "lab/simulation/internal/embree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace scanloom
{
namespace
{
/** Embree's cones are thicker by this much, so that its single precision loses no hit. */
double marginFor(double extent) { return 1e-4 + extent * 0x1p-21; }

/** A hit this little behind the surface of Embree's thicker cone is the nearest: nothing can lie in between. */
constexpr double kMarginsToBark = 4;

/**
 * m. Embree's error in radius grows with length^2 / radius: at the thin end of a cone of 8 m it exceeds the margin, and
 * rays are lost. So stems are given to it in pieces.
 */
constexpr double kLongestPiece = 1.5;

/** Geometries of the scene. */
constexpr unsigned kTrunks = 0, kBranches = 1;

void requireNoError(RTCDevice device, const char* what)
{
  if (const RTCError error = rtcGetDeviceError(device); error != RTC_ERROR_NONE)
    throw std::runtime_error(fmt::format("Embree can't {}: error {}", what, static_cast<int>(error)));
}

/** Adds the `count` cones that `forEachCone` visits to a scene. */
template <typename ForEachCone>
void attachCones(RTCDevice device, RTCScene scene, unsigned id, std::size_t count, const Eigen::Vector3d& origin,
                 double margin, ForEachCone&& forEachCone)
{
  if (count == 0) return;
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_CONE_LINEAR_CURVE);
  auto* vertex = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), 2 * count));
  auto* first_vertices = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, sizeof(unsigned), count));
  requireNoError(device, "make room for cones");
  for (std::size_t i = 0; i < count; ++i) first_vertices[i] = static_cast<unsigned>(2 * i);
  forEachCone(
      [&](const Cone& cone)
      {
        Eigen::Map<Eigen::Matrix<float, 4, 2>> ends(vertex);
        ends.col(0) << (cone.base - margin * cone.axis - origin).cast<float>(),
            static_cast<float>(cone.base_radius + margin);
        ends.col(1) << (cone.tip() + margin * cone.axis - origin).cast<float>(),
            static_cast<float>(cone.tip_radius + margin);
        vertex += ends.size();
      });
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, id);
  rtcReleaseGeometry(geometry);
}

std::vector<Cone> piecesOf(const Cone& whole)
{
  const double count = std::max(1.0, std::ceil(whole.length / kLongestPiece));
  const double narrowing = (whole.base_radius - whole.tip_radius) / count;
  std::vector<Cone> pieces;
  for (double i = 0; i < count; ++i)
    pieces.push_back({whole.base + i / count * whole.length * whole.axis, whole.axis, whole.length / count,
                      whole.base_radius - i * narrowing, whole.base_radius - (i + 1) * narrowing});
  return pieces;
}

Eigen::AlignedBox3d boundsOf(const std::vector<Cone>& cones)
{
  Eigen::AlignedBox3d box(Eigen::Vector3d::Zero());
  if (!cones.empty()) box = Eigen::AlignedBox3d(cones.front().base);
  for (const Cone& cone : cones) box.extend(cone.base).extend(cone.tip());
  return box;
}
double longestBranch(const std::vector<std::vector<Cone>>& looks)
{
  double longest = 0;
  for (const std::vector<Cone>& branches : looks)
    for (const Cone& branch : branches) longest = std::max(longest, branch.length);
  return longest;
}
}  // namespace

std::string embreeInstructionSet()
{
#ifdef __x86_64__
  return __builtin_cpu_supports("avx2") ? "avx2" : "sse4.2";
#else
  return "sse2";  // which Embree has for ARM, in terms of NEON
#endif
}

void Wood::Release::operator()(RTCDeviceTy* device) const { rtcReleaseDevice(device); }
void Wood::Release::operator()(RTCSceneTy* scene) const { rtcReleaseScene(scene); }

Wood::Wood(std::vector<Stem> stems, const std::vector<Cone>& stumps, const TreeOptions& trees,
           const std::string& instruction_set)
  : stems_(std::move(stems)),
    // One thread builds; callers cast rays from as many as they like.
    device_(rtcNewDevice(fmt::format("threads=1,isa={}", instruction_set).c_str()))
{
  if (!device_) throw std::runtime_error(fmt::format("Embree doesn't start with isa={}", instruction_set));

  for (const Stem& stem : stems_) trunks_.push_back(stem.wood());
  trunks_.insert(trunks_.end(), stumps.begin(), stumps.end());
  const Eigen::AlignedBox3d bounds = boundsOf(trunks_);
  origin_ = bounds.center();
  margin_ = marginFor(bounds.sizes().maxCoeff());
  growLooks(trees);
  highest_ = bounds.max().z() + longestBranch(looks_);

  std::vector<Cone> pieces;
  for (std::size_t i = 0; i < trunks_.size(); ++i)
    for (const Cone& piece : piecesOf(trunks_[i]))
    {
      pieces.push_back(piece);
      trunk_of_piece_.push_back(static_cast<std::uint32_t>(i));
    }

  scene_.reset(rtcNewScene(device_.get()));
  attachCones(device_.get(), scene_.get(), kTrunks, pieces.size(), origin_, margin_,
              [&](auto&& add) { std::for_each(pieces.begin(), pieces.end(), add); });
  attachCones(device_.get(), scene_.get(), kBranches, first_branch_.back(), origin_, margin_,
              [&](auto&& add)
              {
                for (std::size_t i = 0; i < stems_.size(); ++i)
                  for (const Cone& branch : looks_[look_of_[i]]) add(placeBranch(branch, stems_[i]));
              });
  rtcCommitScene(scene_.get());
  requireNoError(device_.get(), "build the scene of stems and branches");
}

void Wood::growLooks(const TreeOptions& trees)
{
  std::map<TreeLook, std::uint32_t> known;
  for (const Stem& stem : stems_)
  {
    const auto [look, is_new] = known.try_emplace(lookOf(stem), static_cast<std::uint32_t>(looks_.size()));
    if (is_new) looks_.push_back(growBranches(trees, look->first));
    look_of_.push_back(look->second);
    first_branch_.push_back(first_branch_.back() + static_cast<std::uint32_t>(looks_[look->second].size()));
  }
}

std::optional<Hit> Wood::cast(const Ray& ray, double max_range) const
{
  const Ray from_origin{ray.origin - origin_, ray.direction};
  std::optional<Hit> nearest;
  double from = 0;
  while (const auto candidate = nextCandidate(from_origin, from, nearest ? nearest->range : max_range))
  {
    const std::optional<Hit> hit = hitOf(*candidate, ray);
    if (hit && hit->range < (nearest ? nearest->range : max_range)) nearest = hit;
    if (hit && hit->range - candidate->range < kMarginsToBark * margin_) break;
    from = candidate->range * (1 + 0x1p-21) + 1e-5;  // go on behind it: the ray passed through the margin only
  }
  return nearest;
}

std::optional<Wood::Candidate> Wood::nextCandidate(const Ray& ray, double nearest, double farthest) const
{
  const Eigen::Vector3f origin = ray.origin.cast<float>(), direction = ray.direction.cast<float>();
  RTCRayHit query{};
  query.ray.org_x = origin.x(), query.ray.org_y = origin.y(), query.ray.org_z = origin.z();
  query.ray.dir_x = direction.x(), query.ray.dir_y = direction.y(), query.ray.dir_z = direction.z();
  query.ray.tnear = static_cast<float>(nearest);
  query.ray.tfar = static_cast<float>(farthest);
  query.ray.mask = ~0U;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  intersect(scene_.get(), query);

  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return Candidate{query.ray.tfar, query.hit.geomID, query.hit.primID};
}

std::optional<Hit> Wood::hitOf(const Candidate& candidate, const Ray& ray) const
{
  const auto hitAt = [&](const Cone& solid, Surface surface, std::uint32_t id) -> std::optional<Hit>
  {
    const auto entry = solid.intersect(ray);
    if (!entry) return std::nullopt;
    return Hit{entry->range, std::abs(entry->normal.dot(ray.direction)), surface, id};
  };
  if (candidate.geometry == kTrunks)
  {
    const std::uint32_t trunk = trunk_of_piece_[candidate.index];
    return hitAt(trunks_[trunk], Surface::Stem, trunk < stems_.size() ? trunk : 0);
  }

  const auto next_stem = std::upper_bound(first_branch_.begin(), first_branch_.end(), candidate.index);
  const auto stem = static_cast<std::uint32_t>(next_stem - first_branch_.begin()) - 1;
  const Cone& branch = looks_[look_of_[stem]][candidate.index - first_branch_[stem]];
  return hitAt(placeBranch(branch, stems_[stem]), Surface::Branch, stem);
}
}  // namespace scanloom
