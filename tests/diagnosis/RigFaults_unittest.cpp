/** Recorded rigs with one fault put in: it must be found, with its size, and nothing else. */
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/core/Angle.h"
#include "base/core/So3.h"
#include "diagnosis/DoctorFindings.h"
#include "input/lidar/OusterDecoder.h"
#include "input/lidar/internal/OusterLayout.h"
#include "support/TestData.h"
#include "support/harvesterSettings.h"
#include "support/mergedCaptures.h"
#include "support/recordedRig.h"

namespace scanloom::rig_faults_unittest
{
namespace
{
constexpr std::uint16_t kRightPort = 7504;

Rig recordedRig(const std::filesystem::path& folder, const std::string& more_keys = "")
{
  return makeRig(recordedRigSettings(folder, more_keys));
}

/** What becomes of a datagram: none, one or several. */
using Fault = std::function<std::vector<Datagram>(const Datagram&)>;

struct Examined
{
  RigExamination rig;
  Findings findings;

  Verdict verdictOn(const std::string& about, const std::string& measure) const
  {
    for (const Finding& f : findings)
      if (f.about == about && f.measure == measure) return f.verdict;
    ADD_FAILURE() << "no finding on " << about << ", " << measure;
    return Verdict::NotMeasured;
  }
  /** Warnings and worse. */
  std::vector<std::string> complaints() const
  {
    std::vector<std::string> names;
    for (const Finding& f : findings)
      if (f.verdict > Verdict::Ok) names.push_back(f.about + ": " + f.measure);
    return names;
  }
  std::string mend(const std::string& about, const std::string& measure) const
  {
    for (const Finding& f : findings)
      if (f.about == about && f.measure == measure) return f.mend;
    return "";
  }
};

Examined examined(const Rig& rig, const Fault& fault = {}, Duration longest = 1h)
{
  RigListener listener(rig, true);
  MergedCaptures captures = mergedCaptures(rig.captures);
  std::optional<Timestamp> start;
  for (Datagram datagram; captures.next(datagram);)
  {
    if (!start) start = datagram.received;
    if (datagram.received - *start > longest) break;
    if (!fault)
      listener.add(datagram);
    else
      for (const Datagram& changed : fault(datagram)) listener.add(changed);
  }
  Examined result;
  result.rig = examine(listener.finish(), harvesterSettings().crop);
  result.findings = findingsOf(result.rig);
  return result;
}

/** Changes the stamps of the right lidar's packets, and their CRC with them. */
Fault restamped(const Rig& rig, const std::function<Timestamp(Timestamp)>& change)
{
  const auto decoder = std::dynamic_pointer_cast<const OusterDecoder>(rig.lidars[1].decoder);
  return [decoder, change](const Datagram& datagram) -> std::vector<Datagram>
  {
    if (datagram.destination_port != kRightPort) return {datagram};
    Datagram changed = datagram;
    for (std::size_t i = 0; i < decoder->layout().columns; ++i)
    {
      const std::size_t at = decoder->layout().columnOffset(i);
      const auto stamp = fromNanoseconds(load<std::int64_t>(datagram.payload, at));
      store<std::int64_t>(changed.payload, at, nanoseconds(change(stamp)));
    }
    const std::size_t end = changed.payload.size() - kOusterCrcBytes;
    store<std::uint64_t>(changed.payload, end, crc64(Bytes(changed.payload).slice(0, end)));
    return {changed};
  };
}

Fault everyNthLost(int n)
{
  return [n, count = 0](const Datagram& datagram) mutable -> std::vector<Datagram>
  {
    if (datagram.destination_port == kRightPort && ++count % n == 0) return {};
    return {datagram};
  };
}

using testing::TestWithParam;
}  // namespace

class HealthyRigs : public TestWithParam<const char*>
{
};

TEST_P(HealthyRigs, getNoComplaint)
{
  SCANLOOM_NEEDS_DATA(folder, std::string("recordings/") + GetParam());
  const Examined seen = examined(recordedRig(folder));
  EXPECT_EQ(seen.complaints(), std::vector<std::string>{});
  for (const LidarExamination& lidar : seen.rig.lidars)
  {
    EXPECT_LT(std::abs(lidar.clock.drift->ppm), 0.5);
    EXPECT_EQ(*lidar.clock.epoch, Epoch::Utc);
    EXPECT_LT(degreesBetween(lidar.ground->up, Eigen::Vector3d::UnitZ()), 3);
    EXPECT_NEAR(lidar.ground->sensor_height, 2.5, 0.1);  // extrinsics.txt
  }
  // The README of the recordings: frame periods of 0.099963 and 0.100021 s.
  EXPECT_NEAR(seen.rig.lidars[0].clock.phase->rate_error_ppm, 1e6 * (0.1 / 0.099963 - 1), 1);
  EXPECT_NEAR(seen.rig.lidars[1].clock.phase->rate_error_ppm, 1e6 * (0.1 / 0.100021 - 1), 1);
  ASSERT_EQ(seen.rig.imus.size(), 3u);
  EXPECT_NEAR(*seen.rig.imus[0].timing.rate, 200, 0.1);
  EXPECT_NEAR(*seen.rig.imus[1].timing.rate, 100, 0.1);
  for (std::size_t i = 1; i < 3; ++i)
  {
    const GyroAgreement& to_body = *seen.rig.imus[i].compared->agreement;
    EXPECT_LT(to_body.rotation.norm() / kDegree, 1);
    EXPECT_LT(std::abs(seconds(to_body.lag)), 2e-3);
    EXPECT_NEAR(to_body.scale, 1, 0.005);
  }
  EXPECT_LT(seen.rig.pairs.front().agreement->correction->offset.norm(), 0.03);
}

INSTANTIATE_TEST_SUITE_P(OfBothRecordings, HealthyRigs, testing::Values("sparse", "dense"));

TEST(RigFaults, lossIsCountedToThePacket)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  const Examined seen = examined(recordedRig(folder), everyNthLost(50));
  const Delivery& delivery = seen.rig.lidars[1].delivery;
  EXPECT_EQ(delivery.loss.packets, 9559u / 50);  // summary.json: 9559 packets
  EXPECT_EQ(delivery.loss.longest, 1u);
  EXPECT_EQ(seen.complaints(), std::vector<std::string>{"right: loss"});
  EXPECT_EQ(seen.verdictOn("right", "loss"), Verdict::Warning);

  EXPECT_EQ(examined(recordedRig(folder), everyNthLost(5)).verdictOn("right", "loss"), Verdict::NotFit);
}

TEST(RigFaults, aClockOnTaiIsNamedWithItsOffset)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  const Rig rig = recordedRig(folder);
  const Examined seen = examined(rig, restamped(rig, [](Timestamp t) { return t + 37s; }), 10s);
  EXPECT_EQ(*seen.rig.lidars[1].clock.epoch, Epoch::Tai);
  EXPECT_NEAR(seconds(*seen.rig.lidars[1].clock.ahead_of_first), 37, 1e-3);
  EXPECT_EQ(seen.verdictOn("right", "clock offset"), Verdict::NotFit);
  EXPECT_NE(seen.mend("right", "clock offset").find("lidar2_time_offset = -37.00"), std::string::npos);
}

TEST(RigFaults, aTimeOffsetOfTheConfigurationMendsIt)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  const Rig rig = recordedRig(folder, "lidar2_time_offset = -37\n");
  const Examined seen = examined(rig, restamped(rig, [](Timestamp t) { return t + 37s; }), 10s);
  EXPECT_LT(std::abs(seconds(*seen.rig.lidars[1].clock.ahead_of_first)), 1e-3);
  EXPECT_EQ(seen.verdictOn("right", "clock offset"), Verdict::Ok);
}

TEST(RigFaults, aClockThatIsFortyPpmFastIsMeasuredToATenthOfAPpm)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  const Rig rig = recordedRig(folder);
  const Timestamp start{1750000000s};
  const Examined seen =
      examined(rig, restamped(rig, [start](Timestamp t) { return t + fromSeconds(40e-6 * seconds(t - start)); }));
  const ClockDrift drift = *seen.rig.lidars[1].clock.drift_to_first;
  EXPECT_NEAR(drift.ppm, 40, 0.1);
  EXPECT_LT(drift.sigma_ppm, 0.1);
  EXPECT_EQ(seen.complaints(), std::vector<std::string>{"right: clock drift"});
}

TEST(RigFaults, aClockStepIsFoundWithItsSize)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  const Rig rig = recordedRig(folder);
  const Timestamp lock{1750000005s};
  const auto fault = restamped(rig, [lock](Timestamp t) { return t < lock ? Timestamp{t - lock + 40s} : t; });
  const Examined seen = examined(rig, fault, 10s);
  ASSERT_EQ(seen.rig.lidars[1].clock.steps.size(), 1u);
  // What was 40 s became 1750000005 s, but for the 0.2 ms from block to block.
  EXPECT_NEAR(seconds(seen.rig.lidars[1].clock.steps.front().size) - 1749999965, 0, 1e-3);
  EXPECT_EQ(seen.verdictOn("right", "clock steps"), Verdict::NotFit);
  EXPECT_EQ(seen.verdictOn("right", "clock offset"), Verdict::Ok) << "after the step the clocks agree";
}

TEST(RigFaults, duplicatesAndOvertakenPacketsAreToldFromLoss)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  std::optional<Datagram> held;
  int count = 0;
  const Examined seen = examined(
      recordedRig(folder),
      [&](const Datagram& datagram) -> std::vector<Datagram>
      {
        if (datagram.destination_port != kRightPort) return {datagram};
        ++count;
        if (count % 100 == 7) return {datagram, datagram};
        if (count % 100 == 50)
        {
          held = datagram;
          return {};
        }
        if (!held) return {datagram};
        held->received = datagram.received;
        std::vector<Datagram> both{datagram, *held};
        held.reset();
        return both;
      },
      10s);
  const Delivery& delivery = seen.rig.lidars[1].delivery;
  EXPECT_EQ(delivery.loss.packets, 0u);
  EXPECT_NEAR(static_cast<double>(delivery.order.duplicates), count / 100.0, 1);
  EXPECT_NEAR(static_cast<double>(delivery.order.reordered), count / 100.0, 1);
  EXPECT_EQ(delivery.order.displacement, 1);
  EXPECT_EQ(seen.complaints(), std::vector<std::string>{});
}

TEST(RigFaults, damagedAndStrangePacketsAreCounted)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  int count = 0;
  const Examined seen = examined(
      recordedRig(folder),
      [&](const Datagram& datagram) -> std::vector<Datagram>
      {
        Datagram changed = datagram;
        if (datagram.destination_port != kRightPort) return {datagram};
        if (++count % 100 == 1) changed.payload.resize(700);
        if (count % 100 == 2) changed.payload[1000] ^= 1;
        return {changed};
      },
      10s);
  EXPECT_NEAR(static_cast<double>(seen.rig.lidars[1].malformed), count / 100.0, 1);
  EXPECT_EQ(seen.verdictOn("right", "malformed"), Verdict::Warning);
}

TEST(RigFaults, aSilentLidarIsNotFit)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  const Examined seen = examined(
      recordedRig(folder),
      [](const Datagram& datagram) -> std::vector<Datagram>
      { return datagram.destination_port == kRightPort ? std::vector<Datagram>{} : std::vector<Datagram>{datagram}; },
      10s);
  EXPECT_EQ(seen.verdictOn("right", "packets"), Verdict::NotFit);
}

TEST(RigFaults, packetsThatComeTooLateForTheDeadlineAskForALongerOne)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  int count = 0;
  const Examined seen = examined(
      recordedRig(folder),
      [&](Datagram datagram) -> std::vector<Datagram>
      {
        if (datagram.destination_port == kRightPort && ++count % 500 == 0) datagram.received += 12ms;
        return {datagram};
      },
      10s);
  EXPECT_NEAR(seconds(seen.rig.lidars[1].jitter->largest), 12e-3, 1e-3);
  EXPECT_NEAR(seen.rig.lidars[1].jitter->late_share, 1.0 / 500, 1e-3);
  EXPECT_EQ(seen.verdictOn("right", "jitter"), Verdict::Warning);
  EXPECT_NE(seen.mend("right", "jitter").find("deadline_ms = 1"), std::string::npos);  // 12 or 13
}

namespace
{
struct ImuFault
{
  const char* name;
  std::function<void(Rig&)> make;
  const char* measure;
  const char* mend;
};
void PrintTo(const ImuFault& fault, std::ostream* out) { *out << fault.name; }

void turnImu(Rig& rig, const Eigen::Vector3d& about_body)
{
  rig.body_T_imu->rotation = expSo3(about_body) * rig.body_T_imu->rotation;
}
void scale(Rig& rig, double accel, double gyro)
{
  for (ImuSample& sample : rig.body_imu)
  {
    sample.accel *= accel;
    sample.gyro *= gyro;
  }
}
}  // namespace

class ImuFaults : public TestWithParam<ImuFault>
{
};

TEST_P(ImuFaults, areNamedWithTheirMend)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  Rig rig = recordedRig(folder);
  GetParam().make(rig);
  const Examined seen = examined(rig);
  EXPECT_EQ(seen.verdictOn("imu", GetParam().measure), Verdict::NotFit);
  EXPECT_NE(seen.mend("imu", GetParam().measure).find(GetParam().mend), std::string::npos)
      << seen.mend("imu", GetParam().measure);
}

INSTANTIATE_TEST_SUITE_P(
    OfUnitsAndAxes, ImuFaults,
    testing::Values(ImuFault{"accelerometer_in_g", [](Rig& rig) { scale(rig, 1 / 9.80665, 1); }, "gravity", "in g"},
                    ImuFault{"gyro_in_degrees", [](Rig& rig) { scale(rig, 1, 1 / kDegree); }, "gyro units", "deg/s"},
                    ImuFault{"gyro_converted_twice", [](Rig& rig) { scale(rig, 1, kDegree); }, "gyro units", "57.2958"},
                    ImuFault{"gyro_left_handed", [](Rig& rig) { scale(rig, 1, -1); }, "gyro units", "signs"},
                    ImuFault{"accelerometer_tells_gravity", [](Rig& rig) { scale(rig, -1, 1); }, "up",
                             "change all signs"},
                    ImuFault{"pose_rolled",
                             [](Rig& rig) {
                               turnImu(rig, {-90 * kDegree, 0, 0});
                             },
                             "up", "deg about x"},
                    ImuFault{"pose_pitched",
                             [](Rig& rig) {
                               turnImu(rig, {0, 90 * kDegree, 0});
                             },
                             "up", "deg about y"},
                    ImuFault{"other_clock",
                             [](Rig& rig)
                             {
                               for (ImuSample& sample : rig.body_imu) sample.stamp += 37s;
                             },
                             "time", "another clock"}),
    [](const auto& fault) { return std::string(fault.param.name); });

TEST(RigFaults, anImuThatIsYawedIsFoundByTheOthersTurnRates)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  Rig rig = recordedRig(folder);
  turnImu(rig, {0, 0, 90 * kDegree});
  const Examined seen = examined(rig);
  EXPECT_EQ(seen.verdictOn("imu", "up"), Verdict::Ok) << "gravity cannot see it";
  EXPECT_EQ(seen.verdictOn("imu", "turns"), Verdict::NotFit) << "the two others agree";
  EXPECT_EQ(seen.verdictOn("imu_right", "turns"), Verdict::Ok);
  EXPECT_NEAR(seen.rig.imus[0].compared->agreement->rotation.z() / kDegree, -90, 1);
}

namespace
{
struct PoseFault
{
  const char* name;
  const char* pose;  // believed; true is 1.5 -1.2 2.5 -30 15 25
};
void PrintTo(const PoseFault& fault, std::ostream* out) { *out << fault.name; }
}  // namespace

class PoseFaults : public TestWithParam<std::tuple<const char*, PoseFault>>
{
};

TEST_P(PoseFaults, areFoundWithTheirSize)
{
  const auto& [recording, fault] = GetParam();
  SCANLOOM_NEEDS_DATA(folder, std::string("recordings/") + recording);
  const Examined seen = examined(recordedRig(folder, std::string("lidar2_pose = [") + fault.pose + "]\n"));
  const Rigid right = Rigid::fromXyzYawPitchRoll(1.5, -1.2, 2.5, -30 * kDegree, 15 * kDegree, 25 * kDegree);
  const Rigid believed = seen.rig.lidars[1].lidar.body_T_sensor;

  EXPECT_EQ(seen.verdictOn("right", "pose"), Verdict::NotFit);
  ASSERT_TRUE(seen.rig.pairs.front().agreement->correction);
  const CloudAgreement::Correction& found = *seen.rig.pairs.front().agreement->correction;
  EXPECT_LT((found.offset - (right.translation - believed.translation)).norm(), 0.08);
  EXPECT_LT((found.rotation - logSo3(right.rotation * believed.rotation.conjugate())).norm() / kDegree, 1);
}

INSTANTIATE_TEST_SUITE_P(OfBothRecordings, PoseFaults,
                         testing::Combine(testing::Values("sparse", "dense"),
                                          testing::Values(PoseFault{"yaw_and_sideways", "1.5 -0.9 2.5 -25 15 25"},
                                                          PoseFault{"pitch_and_forward", "1.8 -1.2 2.5 -30 20 25"},
                                                          PoseFault{"roll_and_down", "1.5 -1.2 2.2 -30 15 30"})),
                         [](const auto& fault)
                         { return std::string(std::get<0>(fault.param)) + "_" + std::get<1>(fault.param).name; });

TEST(RigFaults, aLidarWhosePoseNamesAWrongAxisIsNotFit)
{
  SCANLOOM_NEEDS_DATA(folder, "recordings/sparse");
  const Examined seen = examined(recordedRig(folder, "lidar2_pose = [1.5 -1.2 2.5 -30 15 115]\n"));
  EXPECT_EQ(seen.verdictOn("right", "ground"), Verdict::NotFit);
  EXPECT_EQ(seen.verdictOn("imu_right", "up"), Verdict::NotFit);
  EXPECT_EQ(seen.verdictOn("left", "ground"), Verdict::Ok);
}
}  // namespace scanloom::rig_faults_unittest
