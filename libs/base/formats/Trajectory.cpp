#include "base/formats/Trajectory.h"

#include "base/formats/SecondsText.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <sstream>
#include <stdexcept>
#include <string>

namespace scanloom
{
namespace
{
/** Of the two quaternions of a rotation the one with w >= 0, so that equal poses are equal text. */
Eigen::Quaterniond canonical(const Eigen::Quaterniond& q) { return q.w() < 0 ? Eigen::Quaterniond(-q.coeffs()) : q; }
}  // namespace

void TumWriter::add(const StampedPose& pose)
{
  const Eigen::Vector3d& t = pose.map_T_body.translation;
  const Eigen::Quaterniond q = canonical(pose.map_T_body.rotation);
  fmt::print(file_.stream(), "{} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f}\n", secondsText(pose.stamp), t.x(),
             t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
}

void writeTum(const std::filesystem::path& path, const Trajectory& trajectory)
{
  TumWriter writer(path);
  for (const StampedPose& pose : trajectory) writer.add(pose);
  writer.close();
}

std::optional<StampedPose> parseTum(const std::string& line)
{
  std::istringstream words(line);
  std::string stamp, surplus;
  Eigen::Vector3d t;
  Eigen::Quaterniond q;
  if (!(words >> stamp >> t.x() >> t.y() >> t.z() >> q.x() >> q.y() >> q.z() >> q.w()) || words >> surplus)
    return std::nullopt;
  const bool is_rotation = std::abs(q.norm() - 1.0) < 1e-3 && t.allFinite();
  const auto time = parseSeconds(stamp);
  if (!is_rotation || !time) return std::nullopt;
  return StampedPose{*time, Rigid{q.normalized(), t}};
}
Trajectory readTum(const std::filesystem::path& path)
{
  std::ifstream file(path);
  if (!file) throw std::invalid_argument(fmt::format("cannot read the trajectory '{}'", path.string()));

  Trajectory trajectory;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number)
  {
    const auto first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || line[first] == '#') continue;
    const auto pose = parseTum(line);
    if (!pose)
      throw std::invalid_argument(
          fmt::format("{}:{}: expected 't x y z qx qy qz qw' with a unit quaternion, found '{}'", path.string(), number,
                      line.substr(0, 80)));
    if (!trajectory.empty() && pose->stamp <= trajectory.back().stamp)
      throw std::invalid_argument(fmt::format("{}:{}: stamp {} is not after {}: sort the file by time", path.string(),
                                              number, secondsText(pose->stamp), secondsText(trajectory.back().stamp)));
    trajectory.push_back(*pose);
  }
  return trajectory;
}

void writeKitti(const std::filesystem::path& poses, const std::filesystem::path& times, const Trajectory& trajectory)
{
  const Eigen::IOFormat row_major(9, Eigen::DontAlignCols, " ", " ");
  writeAtomically(poses,
                  [&](std::ostream& file)
                  {
                    for (const StampedPose& pose : trajectory)
                      file << std::fixed << pose.map_T_body.matrix().topRows<3>().format(row_major) << '\n';
                  });
  writeAtomically(times,
                  [&](std::ostream& file)
                  {
                    for (const StampedPose& pose : trajectory) file << secondsText(pose.stamp) << '\n';
                  });
}

void writeEuroc(const std::filesystem::path& path, const Trajectory& trajectory)
{
  OutputFile file(path);
  file.stream() << "#timestamp [ns],p_x [m],p_y [m],p_z [m],q_w [],q_x [],q_y [],q_z []\n";
  for (const StampedPose& pose : trajectory)
  {
    const Eigen::Vector3d& t = pose.map_T_body.translation;
    const Eigen::Quaterniond q = canonical(pose.map_T_body.rotation);
    fmt::print(file.stream(), "{},{:.9f},{:.9f},{:.9f},{:.9f},{:.9f},{:.9f},{:.9f}\n", nanoseconds(pose.stamp), t.x(),
               t.y(), t.z(), q.w(), q.x(), q.y(), q.z());
  }
  file.commit();
}
}  // namespace scanloom
