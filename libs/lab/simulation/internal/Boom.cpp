#include "lab/simulation/internal/Boom.h"

#include "base/core/Angle.h"
#include "lab/simulation/internal/Random.h"
#include "lab/simulation/internal/SmoothStep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace scanloom
{
namespace
{
double blend(double from, double to, double share) { return from + share * (to - from); }

/** The box between two joints, given in the boom's vertical plane. */
OrientedBox link(const Rigid& body_T_pillar, const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width)
{
  const Eigen::Vector2d middle = 0.5 * (from + to), along = to - from;
  const Rigid pillar_T_link =
      Rigid::fromXyzYawPitchRoll(middle.x(), 0, middle.y(), 0, -std::atan2(along.y(), along.x()), 0);
  return {body_T_pillar * pillar_T_link, {0.5 * along.norm(), 0.5 * width, 0.5 * width}};
}
}  // namespace

Boom::Boom(const BoomOptions& options, const Route& route, std::uint64_t seed)
  : options_(options), route_(route), seed_(seed)
{
  const double longest = options.inner_link + options.outer_link;
  const double shortest = std::abs(options.inner_link - options.outer_link);
  const auto check = [&](const char* name, double reach)
  {
    const double steepest = std::max(
        {std::abs(options.reach.height_rest), std::abs(options.reach.height_min), std::abs(options.reach.height_max)});
    const double farthest = std::hypot(reach, steepest);
    if (farthest >= longest || reach <= shortest)
      throw std::invalid_argument(fmt::format("[simulated_boom] {} = {} m: the links of {} and {} m cannot reach it",
                                              name, reach, options.inner_link, options.outer_link));
  };
  check("reach_rest", options.reach.reach_rest);
  check("reach_min", options.reach.reach_min);
  check("reach_max", options.reach.reach_max);
  if (options.motion.slew_min > options.motion.slew_max)
    throw std::invalid_argument("[simulated_boom] slew_min: must be at most slew_max");
}

BoomPose Boom::target(const WorkStop& stop, std::uint64_t move, std::uint64_t moves) const
{
  if (move == 0 || move >= moves) return {0, options_.reach.reach_rest, options_.reach.height_rest};
  Random random(seed_, RandomStream::Boom, stop.number, move);
  const double slew = kDegree * options_.motion.swing_deg * random.uniform(-1, 1);
  const double reach = random.uniform(options_.reach.reach_min, options_.reach.reach_max);
  return {slew, reach, random.uniform(options_.reach.height_min, options_.reach.height_max)};
}

BoomPose Boom::at(double t) const
{
  const auto stop = route_.workStopAt(t);
  if (!stop) return target({}, 0, 0);
  const auto moves = static_cast<std::uint64_t>((stop->end - stop->begin) / options_.motion.move_every);
  const auto move = static_cast<std::uint64_t>((t - stop->begin) / options_.motion.move_every);
  const BoomPose from = target(*stop, move, moves), to = target(*stop, move + 1, moves);

  // The rate of a smooth step is at most 15/8 of its mean: so long a move has the drawn rate as its largest.
  Random random(seed_, RandomStream::BoomRate, stop->number, move);
  const double rate = kDegree * random.uniform(options_.motion.slew_min, options_.motion.slew_max);
  const double needed = std::max(1.0, 15.0 / 8 * std::abs(to.slew - from.slew) / rate);
  const double share = smoothStep((t - stop->begin - static_cast<double>(move) * options_.motion.move_every) /
                                  std::min(needed, options_.motion.move_every))
                           .value;
  return {blend(from.slew, to.slew, share), blend(from.reach, to.reach, share), blend(from.height, to.height, share)};
}

BoomJoints Boom::jointsAt(const BoomPose& pose) const
{
  const double a = options_.inner_link, b = options_.outer_link, c = std::hypot(pose.reach, pose.height);
  const double lift = std::atan2(pose.height, pose.reach) + std::acos((a * a + c * c - b * b) / (2 * a * c));
  return {a * Eigen::Vector2d(std::cos(lift), std::sin(lift)), {pose.reach, pose.height}};
}

std::vector<OrientedBox> Boom::boxes(const BoomPose& pose) const
{
  if (!options_.boom) return {};
  const Rigid body_T_pillar = Rigid::fromXyzYawPitchRoll(options_.base_x, 0, options_.base_height, pose.slew, 0, 0);
  const BoomJoints joints = jointsAt(pose);
  const Eigen::Vector3d pillar_half =
      0.5 * Eigen::Vector3d(options_.shape.pillar_width, options_.shape.pillar_width, options_.shape.pillar_height);
  const Eigen::Vector3d head_half =
      0.5 * Eigen::Vector3d(options_.shape.head_length, options_.shape.head_width, options_.shape.head_height);
  const auto hangingFrom = [&](double x, double z, const Eigen::Vector3d& half) {
    return OrientedBox(body_T_pillar * Rigid{Eigen::Quaterniond::Identity(), {x, 0, z - half.z()}}, half);
  };
  return {hangingFrom(0, 0, pillar_half),
          link(body_T_pillar, Eigen::Vector2d::Zero(), joints.elbow, options_.shape.link_width),
          link(body_T_pillar, joints.elbow, joints.tip, options_.shape.link_width),
          hangingFrom(joints.tip.x(), joints.tip.y(), head_half)};
}
}  // namespace scanloom
