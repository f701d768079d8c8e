#include "lab/simulation/internal/Boom.h"

#include "base/core/Angle.h"
#include "lab/simulation/internal/Random.h"
#include "lab/simulation/internal/SmoothStep.h"

#include <algorithm>
#include <cmath>

namespace scanloom
{
namespace
{
// Assumed, as all of the boom. The links reach farther than the head is ever sent.
constexpr double kBaseX = 2.2;         // m: x of the pillar in the body frame
constexpr double kBaseHeight = 2.0;    // m: height of the joint between pillar and inner link, in the body frame
constexpr double kInnerLink = 4.0;     // m: length of the inner link, from the pillar to the elbow
constexpr double kOuterLink = 4.5;     // m: length of the outer link, from the elbow to the head
constexpr double kSwingDeg = 60;       // deg: largest slew angle to either side at work
constexpr double kSlewMin = 20;        // deg/s: the largest slew rate within a move is at least this
constexpr double kSlewMax = 40;        // deg/s: the largest slew rate within a move is at most this
constexpr double kMoveEvery = 8;       // s: time from the start of one move to the start of the next
constexpr double kLinkWidth = 0.32;    // m: width of both links
constexpr double kPillarWidth = 0.6;   // m: width of the pillar
constexpr double kPillarHeight = 1.0;  // m: height of the pillar, below its joint
constexpr double kHeadLength = 0.7;    // m: length of the felling head, away from the machine
constexpr double kHeadWidth = 0.8;     // m: width of the felling head
constexpr double kHeadHeight = 1.4;    // m: height of the felling head, which hangs from the outer link
constexpr double kReachRest = 4.5;     // m: distance of the head from the pillar while the machine drives
constexpr double kReachMin = 4.0;      // m: smallest distance of the head from the pillar at work
constexpr double kReachMax = 7.5;      // m: largest distance of the head from the pillar at work
constexpr double kHeightRest = 0.3;    // m: height of the head's joint above the pillar's while the machine drives
constexpr double kHeightMin = -1.2;    // m: lowest height of the head's joint above the pillar's at work
constexpr double kHeightMax = 0.8;     // m: greatest height of the head's joint above the pillar's at work

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

Boom::Boom(const Route& route, std::uint64_t seed) : route_(route), seed_(seed) {}

BoomPose Boom::target(const WorkStop& stop, std::uint64_t move, std::uint64_t moves) const
{
  if (move == 0 || move >= moves) return {0, kReachRest, kHeightRest};
  Random random(seed_, RandomStream::Boom, stop.number, move);
  const double slew = kDegree * kSwingDeg * random.uniform(-1, 1);
  const double reach = random.uniform(kReachMin, kReachMax);
  return {slew, reach, random.uniform(kHeightMin, kHeightMax)};
}

BoomPose Boom::at(double t) const
{
  const auto stop = route_.workStopAt(t);
  if (!stop) return target({}, 0, 0);
  const auto moves = static_cast<std::uint64_t>((stop->end - stop->begin) / kMoveEvery);
  const auto move = static_cast<std::uint64_t>((t - stop->begin) / kMoveEvery);
  const BoomPose from = target(*stop, move, moves), to = target(*stop, move + 1, moves);

  // The rate of a smooth step is at most 15/8 of its mean: so long a move has the drawn rate as its largest.
  Random random(seed_, RandomStream::BoomRate, stop->number, move);
  const double rate = kDegree * random.uniform(kSlewMin, kSlewMax);
  const double needed = std::max(1.0, 15.0 / 8 * std::abs(to.slew - from.slew) / rate);
  const double share =
      smoothStep((t - stop->begin - static_cast<double>(move) * kMoveEvery) / std::min(needed, kMoveEvery)).value;
  return {blend(from.slew, to.slew, share), blend(from.reach, to.reach, share), blend(from.height, to.height, share)};
}

BoomJoints Boom::jointsAt(const BoomPose& pose) const
{
  const double a = kInnerLink, b = kOuterLink, c = std::hypot(pose.reach, pose.height);
  const double lift = std::atan2(pose.height, pose.reach) + std::acos((a * a + c * c - b * b) / (2 * a * c));
  return {a * Eigen::Vector2d(std::cos(lift), std::sin(lift)), {pose.reach, pose.height}};
}

std::vector<OrientedBox> Boom::boxes(const BoomPose& pose) const
{
  const Rigid body_T_pillar = Rigid::fromXyzYawPitchRoll(kBaseX, 0, kBaseHeight, pose.slew, 0, 0);
  const BoomJoints joints = jointsAt(pose);
  const Eigen::Vector3d pillar_half = 0.5 * Eigen::Vector3d(kPillarWidth, kPillarWidth, kPillarHeight);
  const Eigen::Vector3d head_half = 0.5 * Eigen::Vector3d(kHeadLength, kHeadWidth, kHeadHeight);
  const auto hangingFrom = [&](double x, double z, const Eigen::Vector3d& half) {
    return OrientedBox(body_T_pillar * Rigid{Eigen::Quaterniond::Identity(), {x, 0, z - half.z()}}, half);
  };
  return {hangingFrom(0, 0, pillar_half), link(body_T_pillar, Eigen::Vector2d::Zero(), joints.elbow, kLinkWidth),
          link(body_T_pillar, joints.elbow, joints.tip, kLinkWidth),
          hangingFrom(joints.tip.x(), joints.tip.y(), head_half)};
}
}  // namespace scanloom
