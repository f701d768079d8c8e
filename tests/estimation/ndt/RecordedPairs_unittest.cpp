/** Registration of recorded clouds against the transforms that came with them. */
#include "base/core/Angle.h"
#include "estimation/ndt/Registration.h"
#include "estimation/ndt/briefOf.h"
#include "support/PointFile.h"
#include "support/TestData.h"
#include "support/with.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

namespace scanloom::recorded_pairs_unittest
{
namespace
{
struct Error
{
  double metres, degrees;
};

Error errorOf(const Rigid& estimate, const Rigid& truth)
{
  const Vector6d e = boxMinus(estimate, truth);
  return {e.head<3>().norm(), e.tail<3>().norm() / kDegree};
}

/** Exactly `metres` in a uniform direction and exactly `degrees` about a uniform axis. */
Rigid offBy(double metres, double degrees, std::mt19937_64& random)
{
  std::normal_distribution<double> normal;
  const auto direction = [&]
  {
    const double x = normal(random), y = normal(random), z = normal(random);
    return Eigen::Vector3d(x, y, z).normalized();
  };
  Vector6d step;
  step.head<3>() = metres * direction();
  step.tail<3>() = degrees * kDegree * direction();
  return boxPlus(Rigid::identity(), step);
}

struct Trials
{
  double median_metres, median_degrees, success_rate;
};

Trials tryFrom(const Rigid& truth, double metres, double degrees, const std::function<Rigid(const Rigid&)>& registered)
{
  constexpr int kTrials = 50;
  std::mt19937_64 random(1);
  std::vector<double> translations, rotations;
  int successes = 0;
  for (int i = 0; i < kTrials; ++i)
  {
    const Error error = errorOf(registered(truth * offBy(metres, degrees, random)), truth);
    translations.push_back(error.metres);
    rotations.push_back(error.degrees);
    if (error.metres < 0.1 && error.degrees < 1) ++successes;
  }
  std::sort(translations.begin(), translations.end());
  std::sort(rotations.begin(), rotations.end());
  return {translations[kTrials / 2], rotations[kTrials / 2], successes / static_cast<double>(kTrials)};
}

std::string text(const Trials& t)
{
  return fmt::format("{:.1f} mm {:.3f} deg, {:.0f} %", 1000 * t.median_metres, t.median_degrees, 100 * t.success_rate);
}

NdtMap mapOf(const std::vector<Eigen::Vector3f>& points, double cell_size)
{
  return NdtMap(points, with(&NdtOptions::cell_size, cell_size));
}

Rigid readTransform(const std::filesystem::path& path)
{
  std::ifstream file(path);
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  for (int i = 0; i < 12; ++i) file >> m(i / 4, i % 4);
  return Rigid::fromMatrix(m);
}

TEST(RecordedPair, ofSmallGicpIsFoundAtThePapersCellSizes)
{
  SCANLOOM_NEEDS_DATA(folder, "registration/koide3+small_gicp/data");
  const Rigid truth = readTransform(folder / "T_target_source.txt");
  const auto source_points = readPly(folder / "source.ply");
  const NdtMap target = mapOf(readPly(folder / "target.ply"), 1.0);

  for (const double cell_size : {2.5, 0.5})
  {
    const NdtMap source = mapOf(source_points, cell_size);
    const auto registered = [&](const Rigid& guess) { return align(target, source, guess, {}).target_T_source; };
    const Trials near = tryFrom(truth, 0.5, 5, registered), far = tryFrom(truth, 1, 10, registered);
    RecordProperty(fmt::format("cells_{}_m_from_05m_5deg", cell_size), text(near));
    RecordProperty(fmt::format("cells_{}_m_from_1m_10deg", cell_size), text(far));

    EXPECT_LT(near.median_metres, 0.02) << text(near);
    EXPECT_LT(near.median_degrees, 0.4) << text(near);  // small_gicp's own GICP: 0.33
    EXPECT_EQ(near.success_rate, 1) << text(near);
    EXPECT_GE(far.success_rate, 0.98) << text(far);
  }
}

TEST(RecordedPair, ofSmallGicpIsFoundFromFurtherAwayWithCoarseLevels)
{
  SCANLOOM_NEEDS_DATA(folder, "registration/koide3+small_gicp/data");
  const Rigid truth = readTransform(folder / "T_target_source.txt");
  const auto target = readPly(folder / "target.ply"), source = readPly(folder / "source.ply");
  const NdtMap t4 = mapOf(target, 4), t2 = mapOf(target, 2), t1 = mapOf(target, 1);
  const NdtMap s4 = mapOf(source, 4), s2 = mapOf(source, 2), s1 = mapOf(source, 2.5);
  const auto registered = [&](const Rigid& guess) {
    return alignCoarseToFine({{t4, s4}, {t2, s2}, {t1, s1}}, guess, {}).target_T_source;
  };

  const Trials far = tryFrom(truth, 1, 10, registered), farther = tryFrom(truth, 2, 20, registered);
  RecordProperty("levels_from_1m_10deg", text(far));
  RecordProperty("levels_from_2m_20deg", text(farther));

  EXPECT_EQ(far.success_rate, 1) << text(far);
  EXPECT_GE(farther.success_rate, 0.9) << text(farther);
}

/** Five scans of a vehicle that hardly moves: the poses beside them are good to a millimetre. */
TEST(RecordedPair, ofAStandingVehicleIsFoundToMillimetres)
{
  SCANLOOM_NEEDS_DATA(folder, "odometry/PJLab-ADG+SensorsCalibration/lidar2imu/auto_calib/data");
  std::vector<std::filesystem::path> files;
  for (const auto& file : std::filesystem::directory_iterator(folder / "top_center_lidar"))
    files.push_back(file.path());
  std::sort(files.begin(), files.end());
  ASSERT_EQ(files.size(), 5u);

  std::ifstream poses(folder / "NovAtel-pose-lidar-time.txt");
  std::vector<Rigid> world_T_lidar;
  for (std::size_t i = 0; i < files.size(); ++i)
  {
    std::string stamp;
    Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
    poses >> stamp;
    ASSERT_EQ(stamp, files[i].stem().string());
    for (int k = 0; k < 12; ++k) poses >> m(k / 4, k % 4);
    world_T_lidar.push_back(Rigid::fromMatrix(m));
  }

  std::vector<double> metres, degrees;
  for (std::size_t i = 1; i < files.size(); ++i)
  {
    const NdtMap target = mapOf(readPcd(files[i - 1]), 1.0), source = mapOf(readPcd(files[i]), 2.5);
    const Rigid truth = world_T_lidar[i - 1].inverse() * world_T_lidar[i];
    std::mt19937_64 random(i);
    const RegistrationResult result = align(target, source, truth * offBy(0.2, 2, random), {});
    EXPECT_EQ(result.outcome, Outcome::Converged) << briefOf(result);
    metres.push_back(errorOf(result.target_T_source, truth).metres);
    degrees.push_back(errorOf(result.target_T_source, truth).degrees);
  }
  const double worst_metres = *std::max_element(metres.begin(), metres.end());
  const double worst_degrees = *std::max_element(degrees.begin(), degrees.end());
  RecordProperty("worst", fmt::format("{:.1f} mm {:.3f} deg", 1000 * worst_metres, worst_degrees));

  EXPECT_LT(worst_metres, 0.02);
  EXPECT_LT(worst_degrees, 0.2);
}
}  // namespace
}  // namespace scanloom::recorded_pairs_unittest
