/** `scanloom register` as a person meets it. */
#include "support/TemporaryFolder.h"
#include "support/TestData.h"
#include "support/runProgram.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include <fstream>
#include <random>

namespace scanloom::register_unittest
{
namespace
{
using testing::HasSubstr;

Ended registered(const std::string& arguments, const std::string& redirection = "2>&1")
{
  return runProgram(SCANLOOM_BIN_DIR "/scanloom register " + arguments + " " + redirection);
}

/** Ground, two walls to the ends of it, and a third within. */
std::vector<Eigen::Vector3d> courtyard()
{
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 0.01);
  std::uniform_real_distribution<double> across(-12, 12), up(-1.5, 4);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 30000; ++i) points.emplace_back(across(random), across(random), -1.5 + noise(random));
  for (int i = 0; i < 8000; ++i) points.emplace_back(12 + noise(random), across(random), up(random));
  for (int i = 0; i < 8000; ++i) points.emplace_back(across(random), -12 + noise(random), up(random));
  for (int i = 0; i < 6000; ++i) points.emplace_back(-9.3 + noise(random), 5.7 + noise(random), up(random));
  return points;
}

/** Of 12 m by 8 m, with a column in one corner. */
std::vector<Eigen::Vector3d> room()
{
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 0.01);
  std::uniform_real_distribution<double> along(-6, 6), across(-4, 4), up(-1.2, 1.8), column(2.5, 3.5);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 20000; ++i) points.emplace_back(along(random), across(random), -1.2 + noise(random));
  for (const double side : {-1, 1})
    for (int i = 0; i < 5000; ++i)
    {
      points.emplace_back(along(random), side * 4 + noise(random), up(random));
      points.emplace_back(side * 6 + noise(random), across(random), up(random));
    }
  for (int i = 0; i < 4000; ++i) points.emplace_back(column(random) + 2, 3 + noise(random), up(random));
  return points;
}

std::vector<Eigen::Vector3d> plain()
{
  std::vector<Eigen::Vector3d> points = courtyard();
  points.resize(30000);
  return points;
}

void writePcd(const std::filesystem::path& path, const std::vector<Eigen::Vector3d>& points,
              const Eigen::Isometry3d& move)
{
  std::ofstream file(path);
  file << fmt::format("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS {}\nDATA ascii\n", points.size());
  for (const Eigen::Vector3d& point : points)
  {
    const Eigen::Vector3d p = move * point;
    file << fmt::format("{:.4f} {:.4f} {:.4f}\n", p.x(), p.y(), p.z());
  }
}

/** A source that was seen from 0.6 m, -0.4 m, 0.1 m, turned by 8 deg to the left. */
struct Register : testing::Test
{
  TemporaryFolder folder;
  Eigen::Isometry3d target_T_source = Eigen::Translation3d(0.6, -0.4, 0.1) *
                                      Eigen::AngleAxisd(8 * M_PI / 180, Eigen::Vector3d::UnitZ()) *
                                      Eigen::Isometry3d::Identity();
  const std::string truth = " --truth '0.6 -0.4 0.1 8 0 0' ";

  std::string pairOf(const std::vector<Eigen::Vector3d>& points) const
  {
    writePcd(folder / "target.pcd", points, Eigen::Isometry3d::Identity());
    writePcd(folder / "source.pcd", points, target_T_source.inverse());
    return (folder / "target.pcd").string() + " " + (folder / "source.pcd").string() + " ";
  }
};

TEST_F(Register, findsAKnownMotion)
{
  const Ended ended = registered(pairOf(courtyard()) + "--json", "2>/dev/null");
  ASSERT_EQ(ended.status, 0);
  const auto json = nlohmann::json::parse(ended.output);

  EXPECT_NEAR(json.at("pose").at("x_m"), 0.6, 0.01);
  EXPECT_NEAR(json.at("pose").at("y_m"), -0.4, 0.01);
  EXPECT_NEAR(json.at("pose").at("z_m"), 0.1, 0.01);
  EXPECT_NEAR(json.at("pose").at("yaw_deg"), 8, 0.1);
  EXPECT_NEAR(json.at("pose").at("pitch_deg"), 0, 0.1);
  EXPECT_NEAR(json.at("pose").at("roll_deg"), 0, 0.1);
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      EXPECT_NEAR(json.at("pose").at("matrix")[row][column], target_T_source.matrix()(row, column), 0.01);
  EXPECT_EQ(json.at("covariance").size(), 6U);
  EXPECT_EQ(json.at("outcome"), "converged");
  EXPECT_EQ(json.at("points").at("source"), 52000);
  EXPECT_TRUE(json.at("degenerate_directions").empty());
  EXPECT_GT(json.at("milliseconds").at("align"), 0);
}

TEST_F(Register, saysHowFarItIsFromTheTruthGivenAsPoseOrAsMatrix)
{
  const std::string pair = pairOf(courtyard());
  std::ofstream(folder / "truth.txt") << target_T_source.matrix();
  const auto as_pose = nlohmann::json::parse(registered(pair + truth + "--json").output);
  const auto as_matrix =
      nlohmann::json::parse(registered(pair + "--json --truth " + (folder / "truth.txt").string()).output);

  EXPECT_LT(as_pose.at("error_m"), 0.01);
  EXPECT_LT(as_pose.at("error_deg"), 0.1);
  EXPECT_NEAR(as_matrix.at("error_m"), as_pose.at("error_m"), 1e-5);
}

TEST_F(Register, startsFromTheGuess)
{
  const std::string pair = pairOf(courtyard());
  EXPECT_EQ(registered(pair + "--guess '-300 0 0 0 0 0'").status, 3);
  EXPECT_THAT(registered(pair + "--guess '-300 0 0 0 0 0'").output, HasSubstr("low overlap"));
  EXPECT_THAT(registered(pair + "--guess '-300 0 0 0 0 0'").output, HasSubstr("deviations  unknown"));
  EXPECT_EQ(registered(pair + "--guess '0.5 -0.5 0 10 0 0'").status, 0);
}

TEST_F(Register, namesDirectionsThatAPlaneDoesNotMeasureAndEndsWithThree)
{
  const Ended ended = registered(pairOf(plain()) + "--json", "2>/dev/null");
  EXPECT_EQ(ended.status, 3);
  const auto json = nlohmann::json::parse(ended.output);

  EXPECT_EQ(json.at("outcome"), "degenerate");
  EXPECT_EQ(json.at("degenerate_directions").size(), 3U);
}

TEST_F(Register, refusesWhatItCannotDo)
{
  const std::string pair = pairOf(plain());
  EXPECT_THAT(registered(pair + "--guess '1 2 3'").output, HasSubstr("--guess '1 2 3': 3 numbers"));
  EXPECT_EQ(registered(pair + "--guess '1 2 3'").status, 2);
  EXPECT_EQ(registered(pair + "--truth nowhere.txt").status, 2);

  std::ofstream(folder / "notes.txt") << "1 2 3";
  const Ended no_cloud = registered((folder / "notes.txt").string() + " " + pair.substr(0, pair.find(' ')));
  EXPECT_EQ(no_cloud.status, 1);
  EXPECT_THAT(no_cloud.output, HasSubstr("notes.txt: is no cloud by its name"));
}

TEST_F(Register, refusesADeviationOfTheGuessForMetresAlone)
{
  EXPECT_EQ(registered(pairOf(courtyard()) + "--guess-sigma 0.1").status, 2);
  EXPECT_EQ(registered(pairOf(courtyard()) + "--guess-sigma '0.1 1'").status, 0);
}

TEST_F(Register, saysThatARoomFitsItselfTheOtherWayRoundAsWell)
{
  const std::vector<Eigen::Vector3d> points = room();
  writePcd(folder / "target.pcd", points, Eigen::Isometry3d::Identity());
  const auto statusAfter = [&](double turn)
  {
    const Eigen::Isometry3d pose(Eigen::AngleAxisd(turn * M_PI / 180, Eigen::Vector3d::UnitZ()));
    writePcd(folder / "source.pcd", points, pose.inverse());
    return registered((folder / "target.pcd").string() + " " + (folder / "source.pcd").string()).status;
  };
  EXPECT_EQ(statusAfter(10), 0);
  EXPECT_EQ(statusAfter(90), 3);
  EXPECT_EQ(statusAfter(180), 3);
}

TEST(RegisterRecorded, findsThePairOfSmallGicp)
{
  SCANLOOM_NEEDS_DATA(folder, "registration/koide3+small_gicp/data");
  const Ended ended =
      registered(fmt::format("{0}/target.ply {0}/source.ply --truth {0}/T_target_source.txt --json", folder.string()));
  ASSERT_EQ(ended.status, 0) << ended.output;
  const auto json = nlohmann::json::parse(ended.output);

  EXPECT_LT(json.at("error_m"), 0.03);
  EXPECT_LT(json.at("error_deg"), 0.3);
  EXPECT_EQ(json.at("points").at("source"), 69792);
}

TEST(RegisterRecorded, aPoseThatALittleOverlapSuggestsIsOnlyTrustedWhereTheOtherWayRoundConfirmsIt)
{
  SCANLOOM_NEEDS_DATA(folder, "registration/koide3+small_gicp/data");
  for (const int yaw : {60, 90, -150})  // these converge, 39 to 133 deg off
  {
    const Ended ended =
        registered(fmt::format("{0}/target.ply {0}/source.ply --guess '0 0 0 {1} 0 0'", folder.string(), yaw));
    EXPECT_EQ(ended.status, 3) << yaw;
    EXPECT_THAT(ended.output, HasSubstr("not confirmed")) << yaw;
  }
}
}  // namespace
}  // namespace scanloom::register_unittest
