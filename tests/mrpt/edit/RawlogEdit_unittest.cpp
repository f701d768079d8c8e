/** Streaming of rawlogs, and the operations that choose whole observations. */
#include "mrpt/edit/RawlogEdit.h"

#include "base/core/ConfigError.h"
#include "input/rawlogs/Conversions.h"
#include "mrpt/edit/internal/KeepEvery.h"
#include "mrpt/edit/internal/RawlogCut.h"
#include "mrpt/edit/internal/RawlogLabels.h"
#include "mrpt/edit/internal/TimeOffset.h"
#include "smallRawlog.h"
#include "support/messageOf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scanloom::rawlog_edit_unittest
{
namespace
{
using testing::ElementsAre;
using testing::HasSubstr;

struct RawlogEdit : testing::Test
{
  TemporaryFolder folder;
  std::filesystem::path in = writeSmallRawlog(folder / "in.rawlog");
  std::filesystem::path out = folder / "out.rawlog";
};

Observations unchanged(const ObservationPtr& observation)
{
  return observation ? Observations{observation} : Observations{};
}

std::vector<std::string> labelsOf(const std::filesystem::path& rawlog)
{
  std::vector<std::string> labels;
  for (const ObservationPtr& observation : observationsIn(rawlog)) labels.push_back(observation->sensorLabel);
  return labels;
}

std::vector<std::int64_t> millisecondsOf(const Observations& observations)
{
  std::vector<std::int64_t> stamps;
  for (const ObservationPtr& observation : observations)
    stamps.push_back((fromMrpt(observation->timestamp) - kSmallStart) / 1ms);
  return stamps;
}

TEST_F(RawlogEdit, whatIsNotChangedKeepsItsBytes)
{
  const RawlogEdited result = edited(in, unchanged, out);

  EXPECT_TRUE(uncompressed(out) == uncompressed(in));
  EXPECT_EQ(result.read(), 17u) << "header, 4 scans, 12 samples";
  EXPECT_EQ(result.labels.at("imu").written, 8u);
  EXPECT_EQ(result.damage, "");
}

TEST_F(RawlogEdit, aCutFileIsEditedUpToTheCutAndSaidToBeCut)
{
  std::filesystem::resize_file(in, std::filesystem::file_size(in) * 2 / 3);

  const RawlogEdited result = edited(in, unchanged, out);

  EXPECT_NE(result.damage, "");
  EXPECT_THAT(result.damage, HasSubstr("after"));
  EXPECT_GE(result.read(), 2u);
  EXPECT_LT(result.read(), 17u);
  EXPECT_EQ(observationsIn(out).size(), result.read());
  const std::string whole = uncompressed(writeSmallRawlog(folder / "whole.rawlog"));
  const std::string recovered = uncompressed(out);
  EXPECT_TRUE(recovered == whole.substr(0, recovered.size())) << "to the byte what was before the cut";
}

TEST_F(RawlogEdit, leavesNoFileWhenAnOperationFails)
{
  const auto failing = [](const ObservationPtr&) -> Observations { throw std::runtime_error("no"); };
  EXPECT_THROW(edited(in, failing, out), std::runtime_error);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1) << "the input";
}

TEST_F(RawlogEdit, keepsWhatItHasWhenItIsStopped)
{
  int seen = 0;
  editRawlog(in, unchanged, out, [&](std::uint64_t) { return ++seen < 5; });
  EXPECT_EQ(observationsIn(out).size(), 5u);
}

TEST_F(RawlogEdit, replacesNoWholeFileWhenItIsStopped)
{
  edited(in, unchanged, out);
  const RawlogEdited stopped = editRawlog(in, unchanged, out, [](std::uint64_t) { return false; });
  EXPECT_TRUE(stopped.stopped);
  EXPECT_EQ(stopped.output, folder / "out.partial.rawlog");
  EXPECT_EQ(observationsIn(stopped.output).size(), 1u);
  EXPECT_EQ(observationsIn(out).size(), 17u);
}

TEST_F(RawlogEdit, chainedOperationsSeeEachOthersLateResults)
{
  const auto last = [held = ObservationPtr()](const ObservationPtr& observation) mutable -> Observations
  { return std::exchange(held, observation) && !observation ? Observations{} : Observations{}; };
  const auto atTheEnd = [](const ObservationPtr& observation) -> Observations
  { return observation ? Observations{} : Observations{mrpt::obs::CObservationComment::Create()}; };
  edited(in, chained(atTheEnd, unchanged), out);
  EXPECT_EQ(observationsIn(out).size(), 1u);
  edited(in, chained(last, unchanged), out);
  EXPECT_EQ(observationsIn(out).size(), 0u);
}

TEST_F(RawlogEdit, cutsByTimeWithBothEndsAndTheHeader)
{
  RawlogSpan span;
  span.from_time = kSmallStart + 60ms;
  span.to_time = kSmallStart + 200ms;
  edited(in, cutTo(span), out);
  EXPECT_THAT(labelsOf(out), ElementsAre("", "imu", "imu", "imu_right", "imu", "lidar", "lidar"))
      << "60, 110, 150, 160 ms; scans from 100 and 200 ms, which come after the samples of their time";
}

TEST_F(RawlogEdit, cutsByPlace)
{
  RawlogSpan span;
  span.from_index = 4;
  span.to_index = 5;
  edited(in, cutTo(span), out);
  EXPECT_THAT(labelsOf(out), ElementsAre("", "lidar", "imu"));
}

TEST_F(RawlogEdit, keepsAndRemovesLabels)
{
  edited(in, keepLabels({"imu_right"}), out);
  EXPECT_THAT(labelsOf(out), ElementsAre("", "imu_right", "imu_right", "imu_right", "imu_right"));
  edited(in, removeLabels({"imu", "lidar"}), out);
  EXPECT_THAT(labelsOf(out), ElementsAre("", "imu_right", "imu_right", "imu_right", "imu_right"));
}

TEST_F(RawlogEdit, aLabelThatDoesNotOccurIsAMistake)
{
  EXPECT_THAT(messageOf<UsageError>([&] { edited(in, removeLabels({"imu_rihgt"}), out); }),
              HasSubstr("did you mean 'imu_right'?"));
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(RawlogEdit, keepsEverySecondScanAndAllElse)
{
  edited(in, keepEvery(2), out);
  EXPECT_THAT(millisecondsOf(observationsIn(out, "lidar")), ElementsAre(0, 200));
  EXPECT_EQ(observationsIn(out, "imu").size(), 8u);
}

TEST_F(RawlogEdit, shiftedStampsComeWhereTheyBelong)
{
  edited(in, addTimeOffset("imu_right", -150ms, 100ms), out);

  EXPECT_THAT(millisecondsOf(observationsIn(out, "imu_right")), ElementsAre(-100, 0, 100, 200));
  EXPECT_THAT(labelsOf(out), ElementsAre("", "imu_right", "imu_right", "imu", "imu", "lidar", "imu_right", "imu", "imu",
                                         "lidar", "imu_right", "imu", "imu", "lidar", "imu", "imu", "lidar"))
      << "the scan from 0 ms is due at 100 ms, like the third sample";
}

TEST_F(RawlogEdit, aShiftBackGivesTheSameBytes)
{
  edited(in, addTimeOffset("imu", 250ms, 100ms), out);
  edited(out, addTimeOffset("imu", -250ms, 100ms), out);
  EXPECT_TRUE(uncompressed(out) == uncompressed(in));
}

TEST_F(RawlogEdit, clocksOfDifferentEpochsAreBroughtTogether)
{
  const auto epoch = Duration{kSmallStart.time_since_epoch()};
  edited(in, addTimeOffset("imu", -epoch, 100ms), out);
  EXPECT_EQ(fromMrpt(observationsIn(out, "imu").front()->timestamp), fromNanoseconds(10'000'000));
  edited(out, addTimeOffset("imu", epoch, 100ms), out);
  EXPECT_TRUE(uncompressed(out) == uncompressed(in));
}
}  // namespace
}  // namespace scanloom::rawlog_edit_unittest
