#include "input/rig/InputDisplay.h"

#include <gmock/gmock.h>

#include <utility>

namespace scanloom::input_display_unittest
{
namespace
{
class WarningInput : public SensorInput
{
 public:
  std::optional<SensorEvent> next(Duration) override { return std::nullopt; }
  bool ended() const override { return false; }
  void stop() override {}
  SensorSetup setup() const override { return {}; }
  std::vector<std::string> takeWarnings() override { return std::exchange(warnings, {}); }

  std::vector<std::string> warnings;
};

std::size_t countOf(const std::string& word, const std::string& text)
{
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}
}  // namespace

TEST(InputDisplay, saysTheWarningsOfARecordingWhileItIsReadAndCountsThoseThatComeAgain)
{
  WarningInput input;
  testing::internal::CaptureStderr();
  {
    InputDisplay display("slam", input, 100, "MB");
    auto now = InputDisplay::Clock::now();
    for (int second = 0; second < 60; ++second, now += 1s)
    {
      input.warnings = {"lidar 'left' is silent for 3 s"};
      display.warn("the IMU 'body' is silent", now);
      display.update(0.5, 0, {}, now);
    }
  }
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_EQ(countOf("warning: lidar 'left' is silent", said), 2U) << said;  // once, and the count at the end
  EXPECT_EQ(countOf("warning: the IMU 'body' is silent", said), 2U) << said;
  EXPECT_THAT(said, testing::HasSubstr("59 times"));
}
}  // namespace scanloom::input_display_unittest
