/** Clouds seen from a body whose motion is known by formula, deskewed by its gyroscope. */
#include "mrpt/edit/internal/DeskewByGyro.h"

#include "base/core/ConfigError.h"
#include "estimation/imu/AnalyticDrive.h"
#include "mrpt/edit/CloudObservation.h"
#include "mrpt/edit/internal/GyroBias.h"
#include "smallRawlog.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scanloom::deskew_by_gyro_unittest
{
namespace
{
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr Duration kRest = 3s;
const Rigid kBodyTImu = Rigid::fromXyzYawPitchRoll(0.5, -0.2, 1, 0.7, -0.3, 2.1);
const Eigen::Vector3d kBias(0.02, -0.015, 0.01);  // rad/s: up to 1.1 deg/s, 3 cm in 0.1 s at 20 m

/** At rest for kRest, then turning by up to 1 rad/s about three axes; its origin stays where it is. */
AnalyticDrive turning()
{
  AnalyticDrive drive;
  drive.x = drive.y = drive.z = {};
  drive.yaw = {0.3, 0.4, 0.5, 0.8, 0.1};
  return drive;
}

Timestamp atRest() { return kSmallStart; }
Timestamp driving() { return kSmallStart + kRest; }
Timestamp ofDrive(Timestamp stamp) { return Timestamp{stamp - driving()}; }

ImuSample reading(Timestamp stamp)
{
  ImuSample body{stamp, Eigen::Vector3d::Zero(), {0, 0, kGravity}};
  if (stamp >= driving()) body = turning().sampleAt(ofDrive(stamp));
  const Eigen::Quaterniond imu_R_body = kBodyTImu.rotation.conjugate();
  return {stamp, imu_R_body * body.gyro + kBias, imu_R_body * body.accel};
}

Eigen::Quaterniond map_R_body(Timestamp stamp) { return turning().stateAt(ofDrive(stamp)).map_T_imu.rotation; }

Eigen::Vector3d place(std::size_t point) { return {20.0, 0.25 * static_cast<double>(point), -3.0}; }

/** Fixed points, each seen from the body's pose at the time of its column. */
Scan turningScan(Timestamp start)
{
  Scan scan = someScan(start);
  for (const Column& column : scan.columns)
    for (std::size_t i = column.first_point; i < column.first_point + column.count; ++i)
    {
      const Eigen::Vector3f seen = (map_R_body(column.stamp).conjugate() * place(i)).cast<float>();
      scan.points.x[i] = seen.x();
      scan.points.y[i] = seen.y();
      scan.points.z[i] = seen.z();
    }
  return scan;
}

/** The farthest that a point is from where the body at the cloud's stamp would have seen it. */
double worstIn(const ObservationPtr& cloud, Timestamp start)
{
  const auto points = positionsInBody(*cloudIn(cloud));
  double worst = points.size() == 120 ? 0 : INFINITY;
  for (std::size_t i = 0; i < points.size(); ++i)
    worst = std::max(worst, (points[i].cast<double>() - map_R_body(start).conjugate() * place(i)).norm());
  return worst;
}

struct DeskewByGyro : testing::Test
{
  TemporaryFolder folder;
  std::filesystem::path in = folder / "in.rawlog", out = folder / "out.rawlog";

  void writeSamples(RawlogWriter& writer, Timestamp from, Timestamp to) const
  {
    for (Timestamp stamp = from; stamp < to; stamp += 5ms)
      writer.write(*toObservation(reading(stamp), kBodyTImu, "imu_left"));
  }

  /** Rest, then scans of 0.1 s each behind their samples. */
  void writeDrive(int scans) const
  {
    RawlogWriter writer(in, someHeader());
    writeSamples(writer, atRest(), driving());
    for (int i = 0; i < scans; ++i)
    {
      writeSamples(writer, driving() + i * 100ms, driving() + (i + 1) * 100ms);
      writer.write(*toObservation(turningScan(driving() + i * 100ms)));
    }
    writer.close();
  }

  Observations deskewedWith(const Eigen::Vector3d& bias) const
  {
    edited(in, deskewByGyro({"imu_left", bias}, someHeader()), out);
    return observationsIn(out, "lidar");
  }
};

TEST_F(DeskewByGyro, pointsAreWhereTheBodyAtTheStampWouldHaveSeenThem)
{
  writeDrive(5);
  ASSERT_GT(worstIn(observationsIn(in, "lidar")[2], driving() + 200ms), 0.5) << "distorted before";
  const Observations clouds = deskewedWith(gyroBiasIn(in, "imu_left")->bias);
  ASSERT_EQ(clouds.size(), 5u);
  for (int i = 0; i < 5; ++i) EXPECT_LT(worstIn(clouds[static_cast<std::size_t>(i)], driving() + i * 100ms), 1e-3) << i;
}

TEST_F(DeskewByGyro, theBiasIsThatOfTheFirstStandstill)
{
  writeDrive(5);
  const auto bias = gyroBiasIn(in, "imu_left");
  ASSERT_TRUE(bias);
  EXPECT_LT((bias->bias - kBias).norm(), 1e-6);
  EXPECT_LT(bias->until, driving());
  EXPECT_GT(worstIn(deskewedWith(Eigen::Vector3d::Zero())[2], driving() + 200ms), 0.02) << "what it would cost";
}

TEST_F(DeskewByGyro, whoNeverRestsHasNoKnownBias)
{
  RawlogWriter writer(in, someHeader());
  writeSamples(writer, driving(), driving() + 10s);
  writer.close();
  EXPECT_FALSE(gyroBiasIn(in, "imu_left"));
}

TEST_F(DeskewByGyro, aGapInTheSamplesIsNoStandstill)
{
  RawlogWriter writer(in, someHeader());
  writeSamples(writer, atRest(), atRest() + 100ms);
  writeSamples(writer, atRest() + 2s, atRest() + 2500ms);
  writer.close();
  EXPECT_FALSE(gyroBiasIn(in, "imu_left"));
}

TEST_F(DeskewByGyro, aLabelThatNoImuHasIsAMistake)
{
  writeDrive(1);
  EXPECT_THAT([&] { gyroBiasIn(in, "imu_lfet"); }, ThrowsMessage<UsageError>(HasSubstr("'imu_left'")));
}

TEST_F(DeskewByGyro, aScanBeforeItsSamplesWaitsForThemAndSoDoesWhatIsBehindIt)
{
  RawlogWriter writer(in, someHeader());
  writer.write(*toObservation(turningScan(driving())));
  writer.write(*toObservation(reading(driving()), Rigid::identity(), "imu"));
  writeSamples(writer, driving(), driving() + 200ms);
  writer.close();
  const Observations clouds = deskewedWith(kBias);
  ASSERT_EQ(clouds.size(), 1u);
  EXPECT_LT(worstIn(clouds[0], driving()), 1e-3);
  EXPECT_EQ(observationsIn(out)[1]->sensorLabel, "lidar") << "order in the file stays";
  EXPECT_EQ(observationsIn(out)[2]->sensorLabel, "imu");
}

TEST_F(DeskewByGyro, scansInAGapOfTheSamplesGo)
{
  RawlogWriter writer(in, someHeader());
  writeSamples(writer, driving(), driving() + 200ms);
  for (const Duration start : {100ms, 300ms, 500ms, 1500ms})
    writer.write(*toObservation(turningScan(driving() + start)));
  writeSamples(writer, driving() + 1400ms, driving() + 1700ms);
  writer.close();
  const Observations clouds = deskewedWith(kBias);
  ASSERT_EQ(clouds.size(), 2u);
  EXPECT_LT(worstIn(clouds[0], driving() + 100ms), 1e-3);
  EXPECT_LT(worstIn(clouds[1], driving() + 1500ms), 1e-3);
  EXPECT_EQ(observationsIn(out, "imu_left").size(), 100u);
}

TEST_F(DeskewByGyro, clocksThatDoNotMeetAreAnErrorNotAnEmptyResult)
{
  RawlogWriter writer(in, someHeader());
  writeSamples(writer, driving(), driving() + 200ms);
  writer.write(*toObservation(turningScan(driving() + 3600s)));
  writer.close();
  EXPECT_THROW(deskewedWith(kBias), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(DeskewByGyro, anEmptyCloudStays)
{
  RawlogWriter writer(in, someHeader());
  writeSamples(writer, driving(), driving() + 200ms);
  Scan empty = turningScan(driving());
  empty.points.clear();
  empty.columns.clear();
  writer.write(*toObservation(empty));
  writer.close();
  EXPECT_EQ(deskewedWith(kBias).size(), 1u);
}
}  // namespace
}  // namespace scanloom::deskew_by_gyro_unittest
