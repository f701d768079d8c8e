#include "input/lidar/internal/BeamTable.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/core/Angle.h"
#include "captures.h"
#include "simpleMetadata.h"

namespace scanloom::beam_table_unittest
{
namespace
{
/** The maker's documented formula in double, millimetres and degrees as in the metadata; the result in metres. */
Eigen::Vector3d documentedPoint(const OusterMetadata& m, int column, std::size_t beam, std::uint32_t range_mm,
                                const Eigen::Matrix4d& body_T_sensor)
{
  const double theta = 2 * M_PI * (1 - static_cast<double>(column) / m.columns_per_frame);
  const double az = -m.beam_azimuth_deg[beam] * kDegree, al = m.beam_altitude_deg[beam] * kDegree;
  const double bx = m.beam_to_lidar_mm(0, 3), bz = m.beam_to_lidar_mm(2, 3), n = std::hypot(bx, bz);
  const Eigen::Vector4d in_lidar{(range_mm - n) * std::cos(theta + az) * std::cos(al) + bx * std::cos(theta),
                                 (range_mm - n) * std::sin(theta + az) * std::cos(al) + bx * std::sin(theta),
                                 (range_mm - n) * std::sin(al) + bz, 1};
  Eigen::Vector4d in_sensor = m.lidar_to_sensor_mm * in_lidar;
  in_sensor.head<3>() *= 1e-3;
  return (body_T_sensor * in_sensor).head<3>();
}

const Rigid kTilted = Rigid::fromXyzYawPitchRoll(1.5, -1.2, 2.5, 30 * kDegree, 15 * kDegree, -25 * kDegree);
}  // namespace

TEST(BeamTable, isWithinATenthOfAMillimetreOfTheDocumentedFormulaUpTo100Metres)
{
  double largest = 0;
  for (const std::string name : {"OS-0-128_v3.0.1_1024x10", "OS-1-128_v2.3.0_1024x10", "OS-2-128-U1_v2.3.0_1024x10",
                                 "OS-0-32-U1_v2.2.0_1024x10", "OS-1-64_sensor_config_reduced", "same_ports.2"})
  {
    SCANLOOM_NEEDS_DATA(file, kOusterCaptures + name + ".json");
    const OusterMetadata m = loadOusterMetadata(file.string());
    const BeamTable table(beamsOf(m), kTilted * rigidFromMillimetres(m.lidar_to_sensor_mm));
    const ColumnAngles angles = clockwiseColumns(m.columns_per_frame);
    for (int column = 0; column < m.columns_per_frame; ++column)
      for (const std::uint32_t range_mm : {1u, 500u, 7'001u, 33'333u, 65'537u, 99'999u, 100'000u})
      {
        const auto u = static_cast<std::size_t>(column);
        for (Eigen::Index beam = 0; beam < table.size(); ++beam)
        {
          const Eigen::Vector3d expected =
              documentedPoint(m, column, static_cast<std::size_t>(beam), range_mm, kTilted.matrix());
          const Eigen::Vector3f point =
              table.project(beam, angles.cosine[u], angles.sine[u], static_cast<float>(range_mm));
          largest = std::max(largest, (point.cast<double>() - expected).norm());
        }
      }
  }
  RecordProperty("largest_error_um", std::to_string(1e6 * largest));
  EXPECT_LT(largest, 1e-4);
  EXPECT_GT(largest, 0) << "floats can't be exact: something compared with itself";
}

TEST(BeamTable, theDecodersPointsFollowTheDocumentedFormula)
{
  const OusterMetadata m = simpleMetadata("RNG19_RFL8_SIG16_NIR16_DUAL", 16);
  const OusterEncoder encoder(m);
  const OusterDecoder decoder(m, kTilted);
  double largest = 0;
  std::size_t points_checked = 0;
  for (std::uint16_t first = 0; first < m.columns_per_frame; first = static_cast<std::uint16_t>(first + 16))
  {
    const auto packet = encoder.lidarPacket(randomColumns(m, first, 7, first));
    PointCloud points;
    for (std::size_t block = 0; block < 16; ++block) decoder.appendPoints(packet, block, 0, 0, points);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const Eigen::Vector3d expected =
          documentedPoint(m, points.column[i], points.ring[i], points.range[i], kTilted.matrix());
      // Ranges here reach 262 m: the tolerance of 0.1 mm at 100 m grows with them.
      largest = std::max(largest,
                         (points.position(i).cast<double>() - expected).norm() / std::max(1.0, 1e-5 * points.range[i]));
    }
    points_checked += points.size();
  }
  EXPECT_GT(points_checked, 10000u);
  EXPECT_LT(largest, 1e-4);
}

TEST(BeamTable, aBeamThatLooksForwardMeasuresAlongX)
{
  const BeamTable table({Beam{}}, Rigid::fromXyzYawPitchRoll(0, 0, 2, 0, 0, 0));
  EXPECT_LT((table.project(0, 1, 0, 5000) - Eigen::Vector3f(5, 0, 2)).norm(), 1e-6);
  const Eigen::Vector3f quarter_turn_on = table.project(0, 0, 1, 5000);  // counter-clockwise
  EXPECT_LT((quarter_turn_on - Eigen::Vector3f(0, 5, 2)).norm(), 1e-6);
}

TEST(BeamTable, theOriginOfARayTurnsWithTheEncoder)
{
  const BeamTable table({Beam{0, 0, {0.5, 0, 0.1}, 0}}, Rigid::identity());
  EXPECT_LT((table.project(0, 0, 1, 0) - Eigen::Vector3f(0, 0.5, 0.1)).norm(), 1e-6);
}

TEST(ColumnAngles, columnsCountClockwiseFromTheFirst)
{
  const ColumnAngles angles = clockwiseColumns(4);
  EXPECT_NEAR(angles.cosine[0], 1, 1e-7);
  EXPECT_NEAR(angles.sine[1], -1, 1e-7);
  EXPECT_NEAR(angles.cosine[2], -1, 1e-7);
  EXPECT_NEAR(angles.sine[3], 1, 1e-7);
}
}  // namespace scanloom::beam_table_unittest
