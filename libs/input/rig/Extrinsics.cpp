#include "input/rig/Extrinsics.h"

#include "base/core/Angle.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace scanloom
{
namespace
{
constexpr double kRounding = 1e-6;  // more than files with twelve decimals need

std::vector<double> numbersIn(std::istringstream& text)
{
  std::vector<double> numbers;
  for (std::string word; text >> word;)
  {
    std::size_t used = 0;
    double number = 0;
    try
    {
      number = std::stod(word, &used);
    }
    catch (const std::exception&)
    {
    }
    if (used == 0 || used != word.size() || !std::isfinite(number))
      throw std::invalid_argument(fmt::format("'{}' is not a number", word));
    numbers.push_back(number);
  }
  return numbers;
}

Rigid poseFrom(const std::vector<double>& n)
{
  if (n.size() != 6)
    throw std::invalid_argument(fmt::format("{} numbers: a pose is x y z (m) yaw pitch roll (deg)", n.size()));
  return Rigid::fromXyzYawPitchRoll(n[0], n[1], n[2], n[3] * kDegree, n[4] * kDegree, n[5] * kDegree);
}
}  // namespace

Rigid parsePose(const std::string& text)
{
  std::string inner = text;
  const auto open = inner.find('['), close = inner.rfind(']');
  if (open != std::string::npos && close != std::string::npos && close > open)
    inner = inner.substr(open + 1, close - open - 1);
  std::istringstream stream(inner);
  return poseFrom(numbersIn(stream));
}

std::string poseText(const Rigid& pose)
{
  const Eigen::Vector3d& t = pose.translation;
  const Eigen::Vector3d angles = pose.yawPitchRoll() / kDegree;
  const auto text = [](double value) { return fmt::format("{:.9f}", std::abs(value) < 0.5e-9 ? 0.0 : value); };
  return fmt::format("{} {} {} {} {} {}", text(t.x()), text(t.y()), text(t.z()), text(angles[0]), text(angles[1]),
                     text(angles[2]));
}

std::map<std::string, Rigid> readExtrinsics(const std::filesystem::path& path)
{
  std::ifstream file(path);
  if (!file) throw std::runtime_error(fmt::format("{}: cannot be read", path.string()));

  std::map<std::string, Rigid> poses;
  Eigen::Matrix4d expected = Eigen::Matrix4d::Identity();
  Eigen::Index row = 4;  // of the matrix that may follow a pose
  int number = 0;
  for (std::string line; std::getline(file, line);)
  {
    ++number;
    std::istringstream words(line.substr(0, line.find('#')));
    std::string name;
    if (!(words >> name)) continue;
    try
    {
      if (name.rfind("T_", 0) == 0)
      {
        const Rigid pose = poseFrom(numbersIn(words));
        if (!poses.emplace(name, pose).second) throw std::invalid_argument(fmt::format("{} is given twice", name));
        expected = pose.matrix();
        row = 0;
        continue;
      }
      words = std::istringstream(line);
      const std::vector<double> numbers = numbersIn(words);
      if (numbers.size() != 4 || row == 4) throw std::invalid_argument("expected 'T_a_b x y z yaw pitch roll'");
      for (Eigen::Index c = 0; c < 4; ++c)
        if (std::abs(numbers[static_cast<std::size_t>(c)] - expected(row, c)) > kRounding)
          throw std::invalid_argument("the matrix contradicts the pose above it");
      ++row;
    }
    catch (const std::invalid_argument& problem)
    {
      throw std::runtime_error(fmt::format("{}:{}: {}", path.string(), number, problem.what()));
    }
  }
  return poses;
}
}  // namespace scanloom
