/** RawlogWriter, RawlogReader and RawlogInfo on files. */
#include "mrpt/observations/CGenericPointsMap.h"
#include "mrpt/observations/GzipArchive.h"

#include "base/formats/CompressedFile.h"
#include "mrpt/observations/Observations.h"
#include "mrpt/observations/RawlogInfo.h"
#include "mrpt/observations/RawlogInput.h"
#include "mrpt/observations/RawlogReader.h"
#include "mrpt/observations/RawlogWriter.h"
#include "mrpt/observations/RecordingHeaderJson.h"
#include "mrpt/observations/registerClasses.h"
#include "someScan.h"
#include "support/FullDisk.h"
#include "support/TemporaryFolder.h"
#include "support/messageOf.h"
#include "support/peakMemory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/maps/CColouredPointsMap.h>
#include <mrpt/maps/CPointsMapXYZI.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/maps/CWeightedPointsMap.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationRange.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPosePDFGaussian.h>

#include <unistd.h>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

namespace scanloom::rawlog_unittest
{
namespace
{
namespace fs = std::filesystem;

constexpr std::int64_t kStart = 1'700'000'000'000'000'000;
const Rigid kBodyTImu = Rigid::fromXyzYawPitchRoll(0.1, 0.2, 0.3, 0, 0, 0);

class Rawlog : public testing::Test
{
 protected:
  /** `scans` scans of 120 points, each with two IMU samples. */
  fs::path written(int scans, const RawlogOptions& options = {}, CloudClass cloud = CloudClass::CGenericPointsMap)
  {
    RawlogWriter writer(path_, someHeader(), options);
    for (int i = 0; i < scans; i++)
    {
      const Timestamp start = fromNanoseconds(kStart) + i * 100ms;
      writer.write(*toObservation(someScan(start), cloud));
      writer.write(*toObservation(ImuSample{start + 10ms, {1, 2, 3}, {4, 5, 6}}, kBodyTImu));
      writer.write(*toObservation(ImuSample{start + 60ms, {1, 2, 3}, {4, 5, 6}}, kBodyTImu));
    }
    writer.close();
    return path_;
  }

  std::string bytes() const
  {
    std::ifstream in(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  void overwrite(const std::string& content) const { std::ofstream(path_, std::ios::binary) << content; }

  TemporaryFolder folder_;
  fs::path path_ = folder_ / "some.rawlog";
};

/** Objects as they are in a rawlog before it is compressed; readers take such a file, too. */
std::string serialised(const fs::path& path, const std::vector<const mrpt::serialization::CSerializable*>& objects)
{
  GzipArchive archive(path, 0);
  for (const auto* object : objects) archive << *object;
  archive.close();
  std::string plain(uncompressedBytes(path), '\0');
  CompressedFile(path).read(plain.data(), plain.size());
  return plain;
}

/** The text with another number in the four bytes before it. */
std::string withLengthBefore(std::string bytes, const std::string& text, std::uint32_t length)
{
  const std::size_t at = bytes.find(text);
  EXPECT_NE(at, std::string::npos) << text;
  std::memcpy(&bytes[at - sizeof length], &length, sizeof length);
  return bytes;
}

mrpt::obs::CObservationPointCloud labelledCloud(mrpt::maps::CPointsMap::Ptr points)
{
  mrpt::obs::CObservationPointCloud cloud;
  cloud.sensorLabel = "label of the cloud";
  points->resize(1);
  points->setPoint(0, 1, 2, 3);
  cloud.pointcloud = std::move(points);
  return cloud;
}

int scansIn(RawlogReader& reader)
{
  int scans = 0;
  while (const auto event = reader.next()) scans += std::holds_alternative<RecordedScan>(*event);
  return scans;
}
}  // namespace

TEST_F(Rawlog, givesBackWhatAPersonMarked)
{
  {
    RawlogWriter writer(path_, someHeader(), {});
    writer.write(*toObservation(someScan(fromNanoseconds(kStart)), CloudClass::CGenericPointsMap));
    writer.write(*toObservation(EventMark{fromNanoseconds(kStart) + 100ms, "a deer"}));
    mrpt::obs::CObservationComment other;
    other.text = "remark: no event";
    writer.write(other);
    writer.close();
  }
  RawlogInput input(path_);
  std::vector<EventMark> marks;
  while (const auto event = input.next())
    if (const auto* mark = std::get_if<EventMark>(&*event)) marks.push_back(*mark);
  ASSERT_EQ(marks.size(), 1U);
  EXPECT_EQ(marks[0].text, "a deer");
  EXPECT_LE(std::abs(nanoseconds(marks[0].stamp) - (kStart + 100'000'000)), 100) << "MRPT's clock counts in 100 ns";
}

TEST_F(Rawlog, givesScansAfterTheirSamplesWhereverTheseStandInTheFile)
{
  {
    RawlogWriter writer(path_, someHeader(), {});
    for (int i = 0; i < 6; ++i)
      writer.write(*toObservation(someScan(fromNanoseconds(kStart) + i * 100ms), CloudClass::CGenericPointsMap));
    for (int i = 0; i <= 60; ++i)
      writer.write(*toObservation(ImuSample{fromNanoseconds(kStart) + i * 10ms, {1, 2, 3}, {4, 5, 6}}, kBodyTImu));
    writer.close();
  }
  RawlogInput input(path_);
  ASSERT_EQ(input.setup().body_T_imu.size(), 1U) << "the IMU begins after the sixth scan";
  Timestamp newest;
  int scans = 0;
  while (const auto event = input.next())
  {
    if (const auto* imu = std::get_if<SensorImu>(&*event)) newest = imu->sample.stamp;
    if (const auto* scan = std::get_if<Scan>(&*event))
    {
      ++scans;
      EXPECT_GE(newest, scan->end());
    }
  }
  EXPECT_EQ(scans, 6);
}

TEST_F(Rawlog, givesBackScansAndSamplesWholeAndInOrder)
{
  RawlogReader reader(written(3));
  ASSERT_TRUE(reader.header());
  EXPECT_EQ(reader.header()->lidars.at(1).name, "right");

  std::string order;
  int scans = 0;
  while (const auto event = reader.next())
  {
    if (const auto* recorded = std::get_if<RecordedScan>(&*event))
    {
      order += 's';
      EXPECT_EQ(recorded->label, "lidar");
      EXPECT_EQ(recorded->scan.start, fromNanoseconds(kStart) + scans++ * 100ms);
      EXPECT_EQ(recorded->scan.period, 100ms);
      EXPECT_EQ(recorded->scan.points.x, someScan({}).points.x);
    }
    if (const auto* imu = std::get_if<RecordedImu>(&*event))
    {
      order += 'i';
      EXPECT_EQ(imu->sample.accel, Eigen::Vector3d(4, 5, 6));
    }
  }
  EXPECT_EQ(order, "siisiisii") << "as they were written";
  EXPECT_EQ(reader.damage(), "");
}

TEST_F(Rawlog, isReadByMrptsOwnLoader)
{
  registerClasses();  // as the plugin does in the stock applications
  mrpt::obs::CRawlog rawlog;
  ASSERT_TRUE(rawlog.loadFromRawLogFile(written(3).string()));

  std::string comment;
  rawlog.getCommentText(comment);
  EXPECT_TRUE(recordingHeaderFromJson(comment)) << "MRPT takes the comment for the log's own: " << comment;
  ASSERT_EQ(rawlog.size(), 9u);
  const auto cloud = std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(rawlog.getAsObservation(6));
  ASSERT_TRUE(cloud);
  EXPECT_EQ(cloud->pointcloud->size(), 120u);
}

TEST_F(Rawlog, holdsTheHeaderEvenIfNothingElse)
{
  RawlogReader reader(written(0));
  EXPECT_TRUE(reader.header());
  EXPECT_FALSE(reader.next());
}

TEST_F(Rawlog, hasItsNameOnlyWhenItIsWhole)
{
  {
    RawlogWriter writer(path_, someHeader());
    writer.write(*toObservation(someScan(fromNanoseconds(kStart))));
    EXPECT_FALSE(fs::exists(path_));
  }
  EXPECT_FALSE(fs::exists(path_));
  RawlogReader abandoned(path_.string() + ".part");
  EXPECT_EQ(scansIn(abandoned), 1);
}

TEST_F(Rawlog, leavesAnOlderFileAloneUntilTheNewOneIsWhole)
{
  written(1);
  {
    RawlogWriter interrupted(path_, someHeader());
    interrupted.write(*toObservation(someScan(fromNanoseconds(kStart))));
  }
  EXPECT_EQ(rawlogInfo(path_).observations(), 3u);
}

TEST_F(Rawlog, saysWhichFileItCouldNotOpen)
{
  const auto expectNamed = [](const auto& open)
  { EXPECT_THAT(messageOf<std::runtime_error>([&] { open(); }), testing::HasSubstr("nowhere")); };
  expectNamed([&] { RawlogReader(folder_ / "nowhere" / "x.rawlog"); });
  expectNamed([&] { RawlogWriter(folder_ / "nowhere" / "x.rawlog", {}); });
}

TEST_F(Rawlog, saysSoWhenTheDiskIsFull)
{
  const FullDisk full(100);
  EXPECT_THROW(
      {
        RawlogWriter writer(path_, someHeader());
        writer.write(*toObservation(someScan({})));
        writer.close();
      },
      std::runtime_error);
}

TEST_F(Rawlog, thatACrashLeftIsKeptByTheNextRecordingOfThatName)
{
  {
    RawlogWriter crashed(path_, someHeader());
    crashed.write(*toObservation(someScan(fromNanoseconds(kStart))));
  }
  RawlogWriter next(path_, someHeader());
  next.close();

  EXPECT_EQ(next.earlierPart(), path_.string() + ".part.1");
  RawlogReader abandoned(next.earlierPart());
  EXPECT_EQ(scansIn(abandoned), 1);
}

TEST_F(Rawlog, replacesNoOtherIfItIsPartial)
{
  written(1);
  RawlogWriter interrupted(path_, someHeader());
  EXPECT_EQ(interrupted.close(Completeness::Partial), folder_ / "some.partial.rawlog");
  EXPECT_EQ(rawlogInfo(path_).observations(), 3u);
}

TEST_F(Rawlog, givesNoScanOfALidarThatItsHeaderDoesNotName)
{
  RawlogWriter writer(path_, someHeader());
  for (int i = 0; i < 5; i++)
  {
    Scan scan = someScan(fromNanoseconds(kStart) + i * 100ms);
    if (i == 1 || i == 3) scan.points.sensor_id[7] = 7;
    writer.write(*toObservation(scan));
  }
  writer.close();

  RawlogInput input(path_);
  int scans = 0;
  while (const auto event = input.next()) scans += std::holds_alternative<Scan>(*event);
  EXPECT_EQ(scans, 3);
  EXPECT_EQ(input.account().input.at("rawlog_scans_refused"), 2u);
  const auto warnings = input.takeWarnings();
  ASSERT_EQ(warnings.size(), 1u) << "for the first one";
  EXPECT_EQ(
      warnings[0],
      "the scan at 1700000000.100000000 s has points of sensor_id 7, but the header names 2 lidars: such scans are "
      "left out");
}

TEST_F(Rawlog, isReadUpToWhereItWasCut)
{
  written(20, {0});
  const std::string whole = bytes();
  int last = -1;
  for (const double share : {0.02, 0.3, 0.6, 0.95})
  {
    overwrite(whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size()))));
    RawlogReader reader(path_);
    const int scans = scansIn(reader);
    EXPECT_GE(scans, static_cast<int>(20 * share) - 2);
    EXPECT_LT(scans, 20);
    EXPECT_GT(scans, last);
    EXPECT_NE(reader.damage(), "") << "cut at " << share;
    last = scans;
  }
}

TEST_F(Rawlog, isReadUpToWhereItWasDamaged)
{
  written(20, {1});
  std::string damaged = bytes();
  for (std::size_t i = 0; i < 64; i++) damaged[damaged.size() / 2 + i] ^= 0x5A;
  overwrite(damaged);

  RawlogReader reader(path_);
  EXPECT_LT(scansIn(reader), 20);
  EXPECT_NE(reader.damage(), "");
  EXPECT_NE(rawlogInfo(path_).damage, "");
}

TEST_F(Rawlog, cutWithinItsLastCheckSumIsStillSaidToBeCut)
{
  written(2, {0});
  overwrite(bytes().substr(0, bytes().size() - 4));

  RawlogReader reader(path_);
  EXPECT_EQ(scansIn(reader), 2);
  EXPECT_NE(reader.damage(), "");
}

TEST_F(Rawlog, thatIsNoneIsSaidToBeDamaged)
{
  overwrite("this is no rawlog, but a text about one\n");
  RawlogReader reader(path_);
  EXPECT_FALSE(reader.header());
  EXPECT_FALSE(reader.next());
  EXPECT_NE(reader.damage(), "");
}

TEST_F(Rawlog, isCountedByLabelAndClass)
{
  const RawlogInfo info = rawlogInfo(written(4));

  ASSERT_EQ(info.sensors.size(), 2u);
  EXPECT_EQ(info.sensors[0].label, "imu");
  EXPECT_EQ(info.sensors[0].count, 8u);
  EXPECT_EQ(info.sensors[0].observation_class, "mrpt::obs::CObservationIMU");
  EXPECT_EQ(info.sensors[1].label, "lidar");
  EXPECT_EQ(info.sensors[1].count, 4u);
  EXPECT_EQ(info.sensors[1].points, 480u);
  EXPECT_EQ(info.sensors[1].cloud_class, "mrpt::maps::CGenericPointsMap");
  EXPECT_EQ(info.observations(), 12u);
  EXPECT_EQ(info.points(), 480u);
  EXPECT_EQ(info.span(), 360ms) << "from the first scan's start to the last IMU sample";
  EXPECT_EQ(info.file_size, fs::file_size(path_));
  ASSERT_TRUE(info.header);
  EXPECT_EQ(info.header->scan_rate, 10);
}

TEST_F(Rawlog, holdsXyziCloudsIfAskedTo)
{
  const RawlogInfo info = rawlogInfo(written(1, {}, CloudClass::CPointsMapXYZI));
  EXPECT_EQ(info.sensors.at(1).cloud_class, "mrpt::maps::CPointsMapXYZI");
}

TEST_F(Rawlog, givesNoPointsThatNoLidarMeasures)
{
  {
    Scan scan = someScan(fromNanoseconds(kStart));
    scan.points.y[4] = std::numeric_limits<float>::quiet_NaN();
    for (const std::size_t i : {9, 10, 11}) scan.points.x[i] = std::numeric_limits<float>::infinity();
    scan.points.z[30] = -1e30F;
    RawlogWriter writer(path_, someHeader());
    writer.write(*toObservation(scan));
    writer.close();
  }
  RawlogReader reader(path_);
  const auto event = reader.next();
  const Scan& scan = std::get<RecordedScan>(event.value()).scan;
  ASSERT_EQ(scan.points.size(), 115u);
  for (std::size_t i = 0; i < scan.points.size(); ++i) EXPECT_LT(scan.points.position(i).norm(), 100) << i;
  ASSERT_EQ(scan.columns.size(), 39u) << "one column lost all its points";
  EXPECT_EQ(scan.columns_of, (std::vector<std::uint32_t>{20, 19}));
  EXPECT_EQ(scan.columns[1].first_point, 3u);
  EXPECT_EQ(scan.columns[1].count, 2u);
  EXPECT_EQ(scan.columns[2].stamp, someScan(fromNanoseconds(kStart)).columns[2].stamp);
}

TEST_F(Rawlog, aSampleThatIsNotANumberIsNoSample)
{
  RawlogWriter writer(path_, someHeader());
  for (const double accel : {1.0, std::numeric_limits<double>::quiet_NaN(), 2.0})
    writer.write(*toObservation(ImuSample{fromNanoseconds(kStart), {1, 2, 3}, {accel, 5, 6}}, kBodyTImu));
  writer.close();
  RawlogReader reader(path_);
  std::string kinds;
  while (const auto event = reader.next()) kinds += std::holds_alternative<RecordedImu>(*event) ? 'i' : '-';
  EXPECT_EQ(kinds, "i-i");
}

TEST_F(Rawlog, anImpossiblePoseIsDamage)
{
  {
    RawlogWriter writer(path_, someHeader());
    writer.write(*toObservation(someScan(fromNanoseconds(kStart))));
    auto imu = toObservation(ImuSample{fromNanoseconds(kStart), {1, 2, 3}, {4, 5, 6}}, kBodyTImu);
    imu->sensorPose.x(std::numeric_limits<double>::quiet_NaN());
    writer.write(*imu);
    writer.write(*toObservation(someScan(fromNanoseconds(kStart) + 100ms)));
    writer.close();
  }
  RawlogReader reader(path_);
  EXPECT_EQ(scansIn(reader), 1) << "what is before the damage is given";
  EXPECT_THAT(reader.damage(), testing::HasSubstr("after 3 objects: an observation of 'imu'"));
}

TEST_F(Rawlog, aScanOfNextYearHoldsNoOtherBack)
{
  {
    RawlogWriter writer(path_, someHeader());
    for (int i = 0; i < 5; ++i)
    {
      const Timestamp start = fromNanoseconds(kStart) + i * 100ms;
      writer.write(*toObservation(someScan(i == 1 ? start + 365 * 24h : start)));
      writer.write(*toObservation(ImuSample{start + 10ms, {1, 2, 3}, {4, 5, 6}}, kBodyTImu));
    }
    writer.close();
  }
  RawlogInput input(path_);
  std::string order;
  while (const auto event = input.next()) order += std::holds_alternative<Scan>(*event) ? 's' : 'i';
  EXPECT_EQ(order, "isissisisi");
}

/** A length before a text, or the number of points of a map, that asks for gigabytes. */
TEST_F(Rawlog, takesNoGigabytesForAFalseLength)
{
  mrpt::obs::CObservationComment comment;
  comment.text = "text of the comment";
  mrpt::obs::CObservationIMU imu;
  imu.sensorLabel = "label of the imu";
  auto generic = mrpt::maps::CGenericPointsMap::Create();
  generic->registerField_float("name of the field");
  const auto cloud = labelledCloud(generic);
  mrpt::obs::CObservationPointCloud external;
  external.setAsExternalStorage("name of a file",
                                mrpt::obs::CObservationPointCloud::ExternalStorageFormat::KittiBinFile);

  const long before = peakMegabytes();
  for (const std::uint32_t length : {0x10000000u, 0x7FFFFFFFu, 0xFFFFFFFFu})
  {
    const auto expectDamage = [&](const mrpt::serialization::CSerializable& object, const std::string& text)
    {
      overwrite(withLengthBefore(serialised(path_, {&object}), text, length));
      EXPECT_NE(rawlogInfo(path_).damage, "") << text;
      EXPECT_LT(peakMegabytes() - before, 100) << text;
    };
    expectDamage(comment, comment.text);
    expectDamage(imu, imu.sensorLabel);
    expectDamage(cloud, cloud.sensorLabel);
    expectDamage(cloud, "name of the field");
    expectDamage(external, "name of a file");
  }
}

/** Before comments had labels (version 0: text and stamp): the numbers of what follows are no lengths. */
TEST_F(Rawlog, readsOnBehindACommentWithoutALabel)
{
  mrpt::obs::CObservationRange range;
  range.maxSensorDistance = 5;
  const std::string others = serialised(path_, {&range, &range});
  const std::string name = "mrpt::obs::CObservationComment", text = "of 2011";
  std::string comment = std::string(1, static_cast<char>(0x80 | name.size())) + name + std::string(1, '\0') +
                        std::string{static_cast<char>(text.size()), 0, 0, 0} + text + std::string(8, '\1') + "\x88";
  overwrite(comment + others);
  EXPECT_EQ(rawlogInfo(path_).damage, "");
  EXPECT_EQ(rawlogInfo(path_).observations(), 3u);
}

TEST_F(Rawlog, aLabelHasNoControlCharacters)
{
  mrpt::obs::CObservationRange range;
  range.maxSensorDistance = 5;
  range.sensorLabel = "\x1b[31ma\nb\xff";
  overwrite(serialised(path_, {&range}));
  ASSERT_EQ(rawlogInfo(path_).sensors.size(), 1u);
  EXPECT_EQ(rawlogInfo(path_).sensors.front().label, "?[31ma?b?");
}

/** Values are copied into arrays of as many as there are points. */
TEST_F(Rawlog, aFieldOfMoreOrFewerValuesThanPointsIsADamage)
{
  const std::string name = "name of the field";
  auto generic = mrpt::maps::CGenericPointsMap::Create();
  generic->registerField_float(name);
  const auto cloud = labelledCloud(generic);
  for (const std::uint32_t values : {0U, 2U})
  {
    std::string content = serialised(path_, {&cloud});
    std::memcpy(&content[content.find(name) + name.size()], &values, sizeof values);
    overwrite(content);
    EXPECT_NE(rawlogInfo(path_).damage, "") << values;
  }
}

template <typename Map>
struct RawlogOfMaps : Rawlog
{
};
using MapsOfMrpt =
    testing::Types<mrpt::maps::CGenericPointsMap, mrpt::maps::CPointsMapXYZI, mrpt::maps::CSimplePointsMap,
                   mrpt::maps::CColouredPointsMap, mrpt::maps::CWeightedPointsMap>;
TYPED_TEST_SUITE(RawlogOfMaps, MapsOfMrpt, );  // the comma: clang counts arguments pedantically

TYPED_TEST(RawlogOfMaps, takesNoGigabytesForAFalseNumberOfPoints)
{
  const auto cloud = labelledCloud(TypeParam::Create());
  mrpt::obs::CSensoryFrame frame;
  frame.insert(std::make_shared<mrpt::obs::CObservationPointCloud>(cloud));
  const long before = peakMegabytes();
  const std::string sound = serialised(this->path_, {&frame});
  const float x_y_z[] = {1, 2, 3};
  for (const std::uint32_t points : {0x10000000u, 0x7FFFFFFFu, 0xFFFFFFFFu})
  {
    const std::string position(reinterpret_cast<const char*>(x_y_z), sizeof x_y_z);
    this->overwrite(withLengthBefore(sound, position, points));
    EXPECT_NE(rawlogInfo(this->path_).damage, "");
    EXPECT_LT(peakMegabytes() - before, 100);
  }
}

mrpt::obs::CActionCollection actionsOf(mrpt::obs::CActionRobotMovement2D::TDrawSampleMotionModel model)
{
  mrpt::obs::CActionRobotMovement2D movement;
  mrpt::obs::CActionRobotMovement2D::TMotionModelOptions options;
  options.modelSelection = model;
  options.thrunModel.nParticlesCount = 123;
  movement.computeFromOdometry({1, 2, 3}, options);
  mrpt::obs::CActionCollection actions;
  actions.insert(movement);
  return actions;
}

TEST_F(Rawlog, passesOverMovements)
{
  using Movement = mrpt::obs::CActionRobotMovement2D;
  for (const auto model : {Movement::mmGaussian, Movement::mmThrun})
  {
    const auto actions = actionsOf(model);
    const auto cloud = labelledCloud(mrpt::maps::CPointsMapXYZI::Create());
    overwrite(serialised(path_, {&actions, &cloud, &actions}));
    const RawlogInfo info = rawlogInfo(path_);
    EXPECT_EQ(info.damage, "");
    EXPECT_EQ(info.observations(), 1u);
  }
}

/** MRPT would draw them all. */
TEST_F(Rawlog, aMovementOfABillionParticlesIsDamage)
{
  const auto actions = actionsOf(mrpt::obs::CActionRobotMovement2D::mmThrun);
  std::string bytes = serialised(path_, {&actions});
  const std::size_t at = bytes.find(std::string("\173\0\0\0", 4));
  ASSERT_NE(at, std::string::npos);
  bytes[at + 3] = 0x40;
  overwrite(bytes);
  EXPECT_THAT(rawlogInfo(path_).damage, testing::HasSubstr("1073741947 particles"));
}

/** MRPT would follow the null pointer, here and below. */
TEST_F(Rawlog, anActionThatIsNoneIsDamage)
{
  auto actions = actionsOf(mrpt::obs::CActionRobotMovement2D::mmGaussian);
  actions.insert(mrpt::obs::CActionRobotMovement2D());
  std::string bytes = serialised(path_, {&actions});
  const std::string action = "mrpt::obs::CActionRobotMovement2D";
  const std::size_t second = bytes.find(action, bytes.find(action) + 1);
  ASSERT_NE(second, std::string::npos);
  overwrite(bytes.replace(second - 1, 1 + action.size(), "\x87nullptr\x88"));
  EXPECT_THAT(rawlogInfo(path_).damage, testing::HasSubstr("an action of class 'nullptr'"));
}

TEST_F(Rawlog, anObservationOfAFrameThatIsNoneIsPassedOver)
{
  mrpt::obs::CSensoryFrame frame;
  for (int i = 0; i < 2; ++i) frame.insert(toObservation(ImuSample{fromNanoseconds(kStart), {}, {}}, kBodyTImu));
  std::string bytes = serialised(path_, {&frame});
  const std::string imu = "mrpt::obs::CObservationIMU";
  const std::size_t first = bytes.find(imu) - 1, second = bytes.find(imu, first + 2) - 1;
  overwrite(bytes.replace(first, second - first, "\x87nullptr\x88"));
  const RawlogInfo info = rawlogInfo(path_);
  EXPECT_EQ(info.damage, "");
  EXPECT_EQ(info.observations(), 1u);
}

TEST_F(Rawlog, aMovementWithoutAPoseIsDamage)
{
  mrpt::obs::CActionRobotMovement2D movement;
  movement.estimationMethod = mrpt::obs::CActionRobotMovement2D::emScan2DMatching;
  movement.poseChange = mrpt::poses::CPosePDFGaussian::Create();
  mrpt::obs::CActionCollection actions;
  actions.insert(movement);
  std::string bytes = serialised(path_, {&actions});
  const std::string pose = "mrpt::poses::CPosePDFGaussian";
  const std::size_t at = bytes.find(pose);
  ASSERT_NE(at, std::string::npos);
  overwrite(bytes.replace(at - 1, 1 + pose.size(), "\x87nullptr\x88"));
  EXPECT_THAT(rawlogInfo(path_).damage, testing::HasSubstr("without a pose"));
}

TEST_F(Rawlog, isNotUnpackedIntoMoreThanItsSizeCanMean)
{
  auto points = mrpt::maps::CPointsMapXYZI::Create();
  points->resize(6'000'000);  // 96 MB of zeros, packed into 0.1 MB
  mrpt::obs::CObservationPointCloud bomb;
  bomb.pointcloud = points;
  {
    GzipArchive archive(path_, 9);
    archive << bomb;
    archive.close();
  }
  EXPECT_THAT(rawlogInfo(path_).damage, testing::HasSubstr("an object of more than 64 MB"));
}
}  // namespace scanloom::rawlog_unittest
