/** The machine that carries the lidars: boxes of its body, and its boom. */
#pragma once
#include "base/core/Field.h"
#include "lab/simulation/internal/Boom.h"
#include "lab/simulation/internal/Solids.h"

#include <string>
#include <vector>

namespace scanloom
{
/** Body and boom are not keys of the configuration: tests measure without a machine, or with another one. */
struct MachineParts
{
  std::string kind = "harvester";

  /** In the body frame, m. Assumed: a mid-size harvester as engine, cabin, front frame and front axle. */
  std::vector<Eigen::AlignedBox3d> body = {{Eigen::Vector3d(-4, -1.25, 0.7), Eigen::Vector3d(-1, 1.25, 2.7)},
                                           {Eigen::Vector3d(-1, -1.15, 1), Eigen::Vector3d(1.25, 1.15, 3.6)},
                                           {Eigen::Vector3d(1.25, -1, 0.6), Eigen::Vector3d(3.6, 1, 1.8)},
                                           {Eigen::Vector3d(1, -1.45, 0), Eigen::Vector3d(2.9, 1.45, 1.6)}};
  bool has_boom = true;

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.kind, Field{"kind", "",
                        "what carries the lidars: harvester, car, robot or person (assumed sizes); lidars of the last "
                        "three belong above 1.75 m"});
  }
};

/** The parts of that kind of machine; a harvester's are those given. Throws std::invalid_argument for another kind. */
MachineParts partsOf(MachineParts);

class Machine
{
 public:
  Machine(MachineParts parts, const Boom& boom) : parts_(std::move(parts)), boom_(boom) {}

  /** In the body frame. */
  const std::vector<Eigen::AlignedBox3d>& body() const { return parts_.body; }

  /** In the body frame; none without a boom. */
  std::vector<OrientedBox> boomAt(const BoomPose& pose) const
  {
    return parts_.has_boom ? boom_.boxes(pose) : std::vector<OrientedBox>{};
  }

  const Boom& boom() const { return boom_; }

 private:
  MachineParts parts_;
  Boom boom_;
};
}  // namespace scanloom
