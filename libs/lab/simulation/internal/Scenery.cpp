#include "lab/simulation/internal/Scenery.h"

namespace scanloom
{
namespace
{
void keepNearer(std::optional<Hit>& nearest, const std::optional<Contact>& contact, Surface surface)
{
  if (contact && (!nearest || contact->range < nearest->range))
    nearest = Hit{contact->range, contact->cosine_incidence, surface, 0};
}
}  // namespace

Moment::Moment(const World& world, const Machine& machine, const Rigid& world_T_body, const BoomPose& boom,
               const std::vector<MovingObject>& objects, double t)
  : world_(&world),
    machine_(&machine),
    world_T_body_(world_T_body),
    body_R_world_(world_T_body.rotation.conjugate().toRotationMatrix()),
    boom_(machine.boomAt(boom)),
    boxes_(boxesOf(objects)),
    cones_(conesOf(objects)),
    t_(t)
{
}

std::vector<std::optional<Hit>> Moment::cast(const std::vector<RayQuery>& queries) const
{
  std::vector<std::optional<Hit>> nearest(queries.size());
  std::vector<RayQuery> beyond;
  std::vector<std::size_t> beyond_of;  // of the queries
  for (std::size_t i = 0; i < queries.size(); ++i)
  {
    const auto& [ray, max_range, draw] = queries[i];
    const Ray in_body{body_R_world_ * (ray.origin - world_T_body_.translation), body_R_world_ * ray.direction};
    nearest[i] = castMachine(in_body);
    if (nearest[i] && nearest[i]->range <= max_range) continue;  // nothing can lie between a lidar and its own machine

    nearest[i] = castMoving(ray, in_body);
    if (nearest[i] && nearest[i]->range > max_range) nearest[i].reset();
    beyond.push_back({ray, nearest[i] ? nearest[i]->range : max_range, draw});
    beyond_of.push_back(i);
  }
  const std::vector<std::optional<Hit>> standing = world_->cast(beyond, t_);
  for (std::size_t i = 0; i < standing.size(); ++i)
    if (standing[i]) nearest[beyond_of[i]] = standing[i];
  return nearest;
}

std::optional<Hit> Moment::castMachine(const Ray& in_body) const
{
  std::optional<Hit> nearest;
  for (const Eigen::AlignedBox3d& box : machine_->body()) keepNearer(nearest, castBox(box, in_body), Surface::Machine);
  return nearest;
}

std::optional<Hit> Moment::castMoving(const Ray& in_world, const Ray& in_body) const
{
  std::optional<Hit> nearest;
  for (const OrientedBox& box : boom_) keepNearer(nearest, box.cast(in_body), Surface::Boom);
  for (const OrientedBox& box : boxes_) keepNearer(nearest, box.cast(in_world), Surface::Object);
  for (const Cone& cone : cones_) keepNearer(nearest, castCone(cone, in_world), Surface::Object);
  return nearest;
}

Scenery::Scenery(std::shared_ptr<const World> world, const Drive& drive, const Machine& machine,
                 const MovingObjects& objects)
  : world_(std::move(world)), drive_(drive), machine_(machine), objects_(objects)
{
}

Moment Scenery::at(double t) const
{
  return {*world_, machine_, drive_.at(t).world_T_body, machine_.boom().at(t), objects_.at(t), t};
}
}  // namespace scanloom
