#include "lab/simulation/internal/Boxes.h"

#include "lab/simulation/internal/Wood.h"
#include "lab/simulation/internal/embree.h"

#include <fmt/format.h>

#include <stdexcept>

namespace scanloom
{
namespace
{
using List = std::vector<OrientedBox>;

/** m: single precision moves the bounds by less. */
constexpr float kMargin = 1e-3F;

void boundsOfBox(const RTCBoundsFunctionArguments* of)
{
  const OrientedBox& box = (*static_cast<const List*>(of->geometryUserPtr))[of->primID];
  const Eigen::Matrix3d axes = box.frameTBox().rotation.toRotationMatrix();
  const Eigen::Vector3f half = (axes.cwiseAbs() * box.half()).cast<float>();
  const Eigen::Vector3f centre = box.frameTBox().translation.cast<float>();
  const Eigen::Vector3f low = (centre - half).array() - kMargin, high = (centre + half).array() + kMargin;
  *of->bounds_o = {low.x(), low.y(), low.z(), 0, high.x(), high.y(), high.z(), 0};
}

/** A ray on its way through Embree's tree, in double precision. Embree hands on the address of its first member. */
struct ExactRay
{
#if RTC_VERSION_MAJOR >= 4
  RTCRayQueryContext context;
#else
  RTCIntersectContext context;
#endif
  Ray ray;
  double reach;  // m
  std::optional<Contact> nearest;
};

void castAtBox(const RTCIntersectFunctionNArguments* at)
{
  if (at->valid[0] == 0) return;
  auto& exact = *reinterpret_cast<ExactRay*>(at->context);
  const std::optional<Contact> contact = (*static_cast<const List*>(at->geometryUserPtr))[at->primID].cast(exact.ray);
  if (!contact || contact->range >= exact.reach) return;
  exact.nearest = contact;
  exact.reach = contact->range;
  // Embree skips what lies behind this; a little farther, so that rounding skips nothing.
  reinterpret_cast<RTCRayHit*>(at->rayhit)->ray.tfar = static_cast<float>(contact->range) + kMargin;
}

std::shared_ptr<RTCSceneTy> sceneOf(const List& boxes)
{
  const std::unique_ptr<RTCDeviceTy, void (*)(RTCDevice)> device(
      rtcNewDevice(fmt::format("threads=1,isa={}", embreeInstructionSet()).c_str()), rtcReleaseDevice);
  if (!device) throw std::runtime_error("Embree doesn't start");
  std::shared_ptr<RTCSceneTy> scene(rtcNewScene(device.get()), rtcReleaseScene);
  const RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(boxes.size()));
  rtcSetGeometryUserData(geometry, const_cast<List*>(&boxes));  // Embree hands it on, unchanged
  rtcSetGeometryBoundsFunction(geometry, boundsOfBox, nullptr);
  rtcSetGeometryIntersectFunction(geometry, castAtBox);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene.get());
  if (const RTCError error = rtcGetDeviceError(device.get()); error != RTC_ERROR_NONE)
    throw std::runtime_error(fmt::format("Embree can't build the scene of boxes: error {}", static_cast<int>(error)));
  return scene;
}
}  // namespace

Boxes::Boxes(List boxes) : boxes_(std::make_shared<const List>(std::move(boxes)))
{
  if (!boxes_->empty()) scene_ = sceneOf(*boxes_);
}

std::optional<Contact> Boxes::cast(const Ray& ray, double max_range) const
{
  if (!scene_) return std::nullopt;
  ExactRay exact{{}, ray, max_range, std::nullopt};
  RTCRayHit query{};
  const Eigen::Vector3f origin = ray.origin.cast<float>(), direction = ray.direction.cast<float>();
  query.ray.org_x = origin.x(), query.ray.org_y = origin.y(), query.ray.org_z = origin.z();
  query.ray.dir_x = direction.x(), query.ray.dir_y = direction.y(), query.ray.dir_z = direction.z();
  query.ray.tfar = static_cast<float>(max_range) + kMargin;
  query.ray.mask = ~0U;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
  rtcInitRayQueryContext(&exact.context);
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &exact.context;
  rtcIntersect1(scene_.get(), &query, &arguments);
#else
  rtcInitIntersectContext(&exact.context);
  rtcIntersect1(scene_.get(), &exact.context, &query);
#endif
  return exact.nearest;
}
}  // namespace scanloom
