#include "simulation/Wood.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace scanloom
{
namespace
{
/** Cones are thickened by this much for Embree, so that its floats lose no hit: some units in the last place. */
double marginFor(double extent) { return 1e-4 + extent * 0x1p-21; }

/** Returns at once what lies so little behind Embree's thickened surface that nothing else can be in between. */
constexpr double kMarginsToBark = 4;

bool countBytes(void* counter, ssize_t bytes, bool)
{
  *static_cast<std::atomic<std::int64_t>*>(counter) += bytes;
  return true;
}

void requireNoError(RTCDevice device, const char* what)
{
  if (const RTCError error = rtcGetDeviceError(device); error != RTC_ERROR_NONE)
    throw std::runtime_error(fmt::format("Embree can't {}: error {}", what, static_cast<int>(error)));
}

RTCGeometry makeCones(RTCDevice device, const std::vector<Cone>& cones, const Eigen::Vector3d& origin, double margin)
{
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_CONE_LINEAR_CURVE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
                                                               4 * sizeof(float), 2 * cones.size()));
  auto* first_vertices = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, sizeof(unsigned), cones.size()));
  requireNoError(device, "make room for cones");
  for (std::size_t i = 0; i < cones.size(); ++i)
  {
    const Cone& cone = cones[i];
    Eigen::Map<Eigen::Matrix<float, 4, 2>> ends(vertices + 8 * i);
    ends.col(0) << (cone.base - margin * cone.axis - origin).cast<float>(),
        static_cast<float>(cone.base_radius + margin);
    ends.col(1) << (cone.tip() + margin * cone.axis - origin).cast<float>(),
        static_cast<float>(cone.tip_radius + margin);
    first_vertices[i] = static_cast<unsigned>(2 * i);
  }
  rtcCommitGeometry(geometry);
  return geometry;
}

/** Moved and turned only: Embree 3.13 misses cones of scaled instances, because it takes directions for unit vectors.
 */
RTCGeometry makeInstance(RTCDevice device, RTCScene look, const Stem& stem, const Eigen::Vector3d& origin)
{
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry, look);
  Eigen::Matrix<float, 3, 4> placed;
  placed << stem.rotation().toRotationMatrix().cast<float>(), (stem.foot - origin).cast<float>();
  rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, placed.data());
  rtcCommitGeometry(geometry);
  return geometry;
}

void attach(RTCScene scene, RTCGeometry geometry, unsigned id)
{
  rtcAttachGeometryByID(scene, geometry, id);
  rtcReleaseGeometry(geometry);
}

Eigen::AlignedBox3d boundsOf(const std::vector<Cone>& cones)
{
  Eigen::AlignedBox3d box(Eigen::Vector3d::Zero());
  if (!cones.empty()) box = Eigen::AlignedBox3d(cones.front().base);
  for (const Cone& cone : cones) box.extend(cone.base).extend(cone.tip());
  return box;
}
}  // namespace

std::string embreeInstructionSet() { return __builtin_cpu_supports("avx2") ? "avx2" : "sse4.2"; }

void Wood::Release::operator()(RTCDeviceTy* device) const { rtcReleaseDevice(device); }
void Wood::Release::operator()(RTCSceneTy* scene) const { rtcReleaseScene(scene); }

Wood::Wood(std::vector<Stem> stems, const std::vector<Cone>& stumps, const TreeOptions& trees,
           const std::string& instruction_set)
  : stems_(std::move(stems)),
    // One thread: who casts many rays shares them out himself.
    device_(rtcNewDevice(fmt::format("threads=1,isa={}", instruction_set).c_str()))
{
  if (!device_) throw std::runtime_error(fmt::format("Embree doesn't start with isa={}", instruction_set));
  rtcSetDeviceMemoryMonitorFunction(device_.get(), &countBytes, embree_bytes_.get());

  for (const Stem& stem : stems_) trunks_.push_back(stem.wood());
  trunks_.insert(trunks_.end(), stumps.begin(), stumps.end());
  const Eigen::AlignedBox3d bounds = boundsOf(trunks_);
  origin_ = bounds.center();
  margin_ = marginFor(bounds.sizes().maxCoeff());
  growLooks(trees);

  scene_ = makeScene();
  attach(scene_.get(), makeCones(device_.get(), trunks_, origin_, margin_), 0);
  for (std::size_t i = 0; i < stems_.size(); ++i)
    if (!looks_[look_of_[i]].empty())
      attach(scene_.get(), makeInstance(device_.get(), look_scenes_[look_of_[i]].get(), stems_[i], origin_),
             static_cast<unsigned>(i + 1));
  rtcCommitScene(scene_.get());
  requireNoError(device_.get(), "build the scene of stems and branches");
}

Wood::Scene Wood::makeScene() const
{
  Scene scene(rtcNewScene(device_.get()));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_NONE);
  return scene;
}

void Wood::growLooks(const TreeOptions& trees)
{
  std::map<TreeLook, std::uint32_t> known;
  for (const Stem& stem : stems_)
  {
    const auto [look, is_new] = known.try_emplace(lookOf(stem), static_cast<std::uint32_t>(looks_.size()));
    look_of_.push_back(look->second);
    if (!is_new) continue;
    looks_.push_back(growBranches(trees, look->first));
    look_scenes_.push_back(makeScene());
    attach(look_scenes_.back().get(), makeCones(device_.get(), looks_.back(), Eigen::Vector3d::Zero(), margin_), 0);
    rtcCommitScene(look_scenes_.back().get());
  }
}

std::vector<Cone> Wood::branchesOf(std::uint32_t stem) const
{
  std::vector<Cone> branches;
  for (const Cone& branch : looks_[look_of_[stem]]) branches.push_back(placeBranch(branch, stems_[stem]));
  return branches;
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
    from = candidate->range * (1 + 0x1p-21) + 1e-5;  // behind it: the ray passed through the margin alone
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
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene_.get(), &context, &query);

  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  if (query.hit.instID[0] == RTC_INVALID_GEOMETRY_ID) return Candidate{query.ray.tfar, query.hit.primID, std::nullopt};
  return Candidate{query.ray.tfar, query.hit.instID[0] - 1, query.hit.primID};
}

std::optional<Hit> Wood::hitOf(const Candidate& candidate, const Ray& ray) const
{
  const bool is_branch = candidate.branch.has_value();
  const Cone solid = is_branch
                         ? placeBranch(looks_[look_of_[candidate.index]][*candidate.branch], stems_[candidate.index])
                         : trunks_[candidate.index];
  const auto entry = solid.intersect(ray);
  if (!entry) return std::nullopt;
  const std::uint32_t id = candidate.index < stems_.size() ? candidate.index : 0;
  return Hit{entry->range, std::abs(entry->normal.dot(ray.direction)), is_branch ? Surface::Branch : Surface::Stem, id};
}
}  // namespace scanloom
