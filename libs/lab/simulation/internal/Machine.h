/** The machine that carries the lidars: boxes of its body, and its boom. */
#pragma once
#include "base/core/Field.h"
#include "lab/simulation/internal/Boom.h"
#include "lab/simulation/internal/Solids.h"

#include <string>
#include <vector>

namespace scanloom
{
/** Boxes in the body frame. Assumed: a mid-size harvester in four boxes. */
struct MachineOptions
{
  std::string engine = "-4 -1.25 0.7 -1 1.25 2.7";
  std::string cabin = "-1 -1.15 1 1.25 1.15 3.6";
  std::string front = "1.25 -1 0.6 3.6 1 1.8";
  std::string wheels = "1 -1.45 0 2.9 1.45 1.6";

  template <typename Self, typename Visitor>
  static void fields(Self& o, Visitor&& visit)
  {
    visit(o.engine, Field{"engine", "m", "box xmin ymin zmin xmax ymax zmax in the body frame (assumed); empty: none"});
    visit(o.cabin, Field{"cabin", "m", "box of the cabin, like 'engine' (assumed)"});
    visit(o.front, Field{"front", "m", "box of the front frame that carries the boom, like 'engine' (assumed)"});
    visit(o.wheels, Field{"wheels", "m", "box of the front axle, like 'engine' (assumed)"});
  }
};

class Machine
{
 public:
  /** Throws std::invalid_argument that names an option which is no box. */
  Machine(const MachineOptions&, const Boom&);

  /** In the body frame. */
  const std::vector<Eigen::AlignedBox3d>& body() const { return body_; }
  const Boom& boom() const { return boom_; }

 private:
  std::vector<Eigen::AlignedBox3d> body_;
  Boom boom_;
};
}  // namespace scanloom
