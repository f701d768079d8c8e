/** `scanloom evaluate` as a person or a script meets it. */
#include "support/runProgram.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <string>

#include "support/TemporaryFolder.h"

namespace scanloom::evaluate_unittest
{
namespace
{
using testing::HasSubstr;

/** 10 m along x in 10 s; the estimate is off by 0.3 m at 7 s. */
class EvaluateVerb : public testing::Test
{
 protected:
  EvaluateVerb()
  {
    std::ofstream truth(folder_ / "truth.tum"), estimate(folder_ / "estimate.tum"), station(folder_ / "station.csv");
    station << "#t [s],x [m],y [m],z [m]\n";
    for (int t = 0; t <= 10; ++t)
    {
      truth << t << ' ' << t << " 0 0 0 0 0 1\n";
      estimate << t << ' ' << t << " 0 " << (t == 7 ? 0.3 : 0) << " 0 0 0 1\n";
      station << t << ',' << 500 + t << ",1,54\n";  // the prism is 1 m to the left and 4 m above the body
    }
  }

  Ended evaluate(const std::string& arguments) const
  {
    return runProgram("cd " + folder_.path().string() +
                      " && " SCANLOOM_BIN_DIR "/scanloom evaluate --trajectory estimate.tum " + arguments + " 2>&1");
  }

  TemporaryFolder folder_;
};

TEST_F(EvaluateVerb, tellsTheDriftAgainstAStationAndAgainstPoses)
{
  for (const char* reference : {"station.csv --lever-arm '0 1 4'", "truth.tum"})
  {
    const auto json = nlohmann::json::parse(evaluate(std::string("--json --reference ") + reference).output);

    EXPECT_NEAR(json.at("drift_m"), 0.3, 1e-12);
    EXPECT_NEAR(json.at("drift_percent"), 3, 1e-10);
    EXPECT_NEAR(json.at("path_m"), 10, 1e-12);
    EXPECT_EQ(json.at("largest_at_s"), "7.000000000");
    EXPECT_NEAR(json.at("ape_rmse_m"), std::sqrt((0.09 - 0.09 / 11) / 11), 1e-9);  // the mean is fitted
    EXPECT_TRUE(json.contains("clock_offset_s"));
  }
}

TEST_F(EvaluateVerb, drawsAPictureAndReplacesItOnlyWhenTold)
{
  for (const std::string name : {"error.svg", "error.png"})
  {
    const std::string arguments = "--reference station.csv --lever-arm '0 1 4' --plot " + name;
    ASSERT_EQ(evaluate(arguments).status, 0);
    EXPECT_THAT(contentOf(folder_ / name), HasSubstr(name == "error.svg" ? ">distance [m]<" : "PNG"));
    EXPECT_EQ(evaluate(arguments).status, 2);
    EXPECT_EQ(evaluate(arguments + " -w").status, 0);
  }
  EXPECT_THAT(evaluate("--reference station.csv --plot error.pdf").output, HasSubstr(".svg or .png"));
}

TEST_F(EvaluateVerb, readsReferencesOfEurocAndKitti)
{
  std::ofstream estimate(folder_ / "estimate.tum"), euroc(folder_ / "euroc.csv"), kitti(folder_ / "kitti.txt"),
      times(folder_ / "kitti_times.txt");
  euroc << "#timestamp [ns],p_x [m],p_y [m],p_z [m],q_w [],q_x [],q_y [],q_z []\n";
  for (int t = 2000; t <= 2010; ++t)
  {
    estimate << t << ' ' << t << " 0 " << (t == 2007 ? 0.3 : 0) << " 0 0 0 1\n";
    euroc << t << "000000000," << t << ",0,0,1,0,0,0\n";
    kitti << "1 0 0 " << t << " 0 1 0 0 0 0 1 0\n";
    times << t << '\n';
  }
  for (std::ofstream* file : {&estimate, &euroc, &kitti, &times}) file->close();
  for (const char* reference : {"euroc.csv", "kitti.txt"})
  {
    const Ended ended = evaluate(std::string("--json --reference ") + reference);
    ASSERT_EQ(ended.status, 0) << ended.output;
    EXPECT_NEAR(nlohmann::json::parse(ended.output).at("drift_m"), 0.3, 1e-12) << reference;
  }
}

TEST_F(EvaluateVerb, endsWithThreeAboveTheLimitAndStillTellsAll)
{
  EXPECT_EQ(evaluate("--reference truth.tum --fail-if-drift-above 0.31").status, 0);

  const Ended above = evaluate("--reference truth.tum --fail-if-drift-above 0.29");
  EXPECT_EQ(above.status, 3);
  EXPECT_THAT(above.output, HasSubstr("drift                     0.300 m (3.00 %)"));
  EXPECT_THAT(above.output, HasSubstr("drift 0.300 m is above the limit of 0.29 m"));
}

TEST_F(EvaluateVerb, endsWithThreeIfTheTrajectoryIsOnlyAPartOfTheReference)
{
  std::ofstream(folder_ / "estimate.tum") << "0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n2 2 0 0 0 0 0 1\n";
  for (const std::string align : {"yaw", "first"})
  {
    const std::string arguments = "--reference truth.tum --fail-if-drift-above 1 --align " + align;
    const Ended ended = evaluate(arguments);
    EXPECT_EQ(ended.status, 3);
    EXPECT_THAT(ended.output, HasSubstr("covers 20.0 % of the reference's time, less than 90 %"));
    EXPECT_EQ(evaluate("--reference truth.tum --align " + align).status, 0);
  }
}

TEST_F(EvaluateVerb, alignsTheFirstPosesOnRequest)
{
  const auto json = nlohmann::json::parse(evaluate("--reference truth.tum --align first --json").output);

  EXPECT_NEAR(json.at("largest_m"), 0.3, 1e-12);
  EXPECT_NEAR(json.at("rmse_m"), std::sqrt(0.09 / 11), 1e-12);
  EXPECT_EQ(json.at("final_m"), 0);
  EXPECT_EQ(json.at("poses"), 11);
  EXPECT_EQ(json.at("path_length_m"), 10);
  EXPECT_EQ(json.at("largest_at_s"), "7.000000000");
}

TEST_F(EvaluateVerb, saysThatAFullAlignmentRestsOnAStraightLine)
{
  EXPECT_THAT(evaluate("--reference truth.tum --align se3").output,
              HasSubstr("aligned on                2 of 11 samples, 0.00 m from the axis of the least certain rotation "
                        "(rms), condition inf"));
}

TEST_F(EvaluateVerb, saysThatAReferenceIsOfACamera)
{
  std::ofstream camera(folder_ / "camera.tum"), level(folder_ / "level.tum"), estimate(folder_ / "estimate.tum");
  for (int t = 0; t <= 100; ++t)  // circles of 5 m
  {
    const double x = 5 * std::cos(0.5 * t), y = 5 * std::sin(0.5 * t);
    estimate << fmt::format("{} {} {} 0 0 0 0 1\n", t, x, y);
    level << fmt::format("{} {} {} 0 0 0 0 1\n", t, x, y);
    camera << fmt::format("{} {} 0 {} 0 0 0 1\n", t, -y, x);  // x to the right, z ahead
  }
  camera.close();
  level.close();
  estimate.close();
  EXPECT_THAT(evaluate("--reference camera.tum").output, HasSubstr("--align se3"));
  EXPECT_THAT(evaluate("--reference level.tum").output, testing::Not(HasSubstr("--align se3")));
}

TEST_F(EvaluateVerb, namesWhatIsWrong)
{
  const Ended lever = evaluate("--reference station.csv --lever-arm '1 2'");
  EXPECT_EQ(lever.status, 2);
  EXPECT_THAT(lever.output, HasSubstr("--lever-arm '1 2': must be \"x y z\" in m"));

  EXPECT_THAT(evaluate("--reference station.csv").output, HasSubstr("give --lever-arm"));
  EXPECT_THAT(evaluate("--reference truth.tum").output, testing::Not(HasSubstr("--lever-arm")));

  EXPECT_EQ(evaluate("--reference station.csv --align first").status, 2);
  EXPECT_EQ(evaluate("--reference missing.tum").status, 1);
}
}  // namespace
}  // namespace scanloom::evaluate_unittest
