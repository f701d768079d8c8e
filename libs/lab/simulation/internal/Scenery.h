/** All that rays meet: the static world, the machine, and what moves around it. */
#pragma once
#include "lab/simulation/internal/Drive.h"
#include "lab/simulation/internal/Machine.h"
#include "lab/simulation/internal/MovingObjects.h"
#include "lab/simulation/internal/World.h"

#include <memory>
#include <optional>
#include <vector>

namespace scanloom
{
/** The scenery at one instant. */
class Moment
{
 public:
  Moment(const World&, const Machine&, const Rigid& world_T_body, const BoomPose&, const std::vector<MovingObject>&,
         double t);

  const Rigid& worldTBody() const { return world_T_body_; }

  /** What each ray, given in the world frame, meets. Pure, as World::cast. */
  std::vector<std::optional<Hit>> cast(const std::vector<RayQuery>&) const;
  std::optional<Hit> cast(const RayQuery& query) const { return cast(std::vector<RayQuery>{query}).front(); }

 private:
  std::optional<Hit> castMachine(const Ray& in_body) const;
  std::optional<Hit> castMoving(const Ray& in_world, const Ray& in_body) const;

  const World* world_;
  const Machine* machine_;
  Rigid world_T_body_;
  Eigen::Matrix3d body_R_world_;
  std::vector<OrientedBox> boom_;   // in the body frame
  std::vector<OrientedBox> boxes_;  // in the world
  std::vector<Cone> cones_;         // in the world
  double t_;                        // s after the start
};

/** Copies share the world. */
class Scenery
{
 public:
  Scenery(std::shared_ptr<const World>, const Drive&, const Machine&, const MovingObjects&);

  /** `t` s after the start of the recording; the scenery must outlive it. */
  Moment at(double t) const;

  const World& world() const { return *world_; }
  const Drive& drive() const { return drive_; }
  const Machine& machine() const { return machine_; }
  const MovingObjects& objects() const { return objects_; }

 private:
  std::shared_ptr<const World> world_;
  Drive drive_;
  Machine machine_;
  MovingObjects objects_;
};
}  // namespace scanloom
