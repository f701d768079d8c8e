#include "input/rig/internal/LiveStatus.h"

#include <gtest/gtest.h>

#include <sstream>
#include <utility>

namespace scanloom::live_status_unittest
{
namespace
{
/** An input of which only the account matters. */
class StubInput : public SensorInput
{
 public:
  std::optional<SensorEvent> next(Duration) override { return std::nullopt; }
  bool ended() const override { return false; }
  void stop() override {}
  SensorSetup setup() const override { return {}; }
  RigAccount account() const override { return current; }
  std::vector<std::string> takeWarnings() override { return std::exchange(warnings, {}); }

  RigAccount current;
  std::vector<std::string> warnings;
};

RigAccount accountOf(std::uint64_t left_packets, std::uint64_t right_packets, std::uint64_t lost = 0)
{
  RigAccount account;
  account.lidars.resize(2);
  account.lidars[0].name = "left";
  account.lidars[1].name = "right";
  account.lidars[0].counters.packets = left_packets;
  account.lidars[1].counters.packets = right_packets;
  account.lidars[1].counters.lost = lost;
  return account;
}
}  // namespace

TEST(LiveStatus, tellsPacketsPerSecondAndWhatIsMissing)
{
  RigAccount now = accountOf(1280, 640, 16);
  now.input["scans_dropped"] = 3;
  now.scans_waiting = 2;
  EXPECT_EQ(
      LiveStatus::line(accountOf(640, 640), now, 0.5),
      "left 1280/s, right 0/s packets; columns: 16 lost, 0 late, 0 dropped; datagrams: 0 dropped; scans: 2 waiting, 3 "
      "dropped");
}

TEST(LiveStatus, theLineOfATerminalFits80Columns)
{
  RigAccount now = accountOf(640, 640, 123456789);
  now.lidars[0].counters.late = now.lidars[0].counters.dropped = 123456789;
  EXPECT_EQ(LiveStatus::shortLine(accountOf(0, 0), accountOf(640, 640), 1, 60), "left 640/s, right 640/s");
  EXPECT_EQ(LiveStatus::shortLine(accountOf(0, 0), accountOf(640, 640, 16), 1, 60), "left 640/s, right 640/s; 16 lost");
  for (int i = 0; i < 30; ++i) now.lidars.push_back(now.lidars[0]);
  std::ostringstream out;
  {
    StubInput input;
    input.current = now;
    LiveStatus status("record", out, true);
    status.update(input, {1000, 1}, LiveStatus::Clock::now() + 100h);
  }
  EXPECT_LE(out.str().size(), std::string("\r\033[K").size() + 80);
}

TEST(LiveStatus, showsALineASecondOnATerminalAndOnePerTenSecondsElsewhere)
{
  for (const auto& [terminal, lines] : {std::pair(true, 30), std::pair(false, 3)})
  {
    std::ostringstream out;
    {
      StubInput input;
      LiveStatus status("record", out, terminal);
      const auto start = LiveStatus::Clock::now();
      for (Duration t = 0s; t <= 30500ms; t += 100ms) status.update(input, {}, start + t);
    }
    const std::string text = out.str();
    std::size_t shown = 0;
    for (std::size_t at = text.find("record:"); at != std::string::npos; at = text.find("record:", at + 1)) ++shown;
    EXPECT_EQ(shown, static_cast<std::size_t>(lines));
    EXPECT_EQ(text.back(), '\n');
  }
}

TEST(LiveStatus, tellsHowManyTimesFasterThanTheSensorsTheWorkWasSinceTheLastLine)
{
  EXPECT_EQ(LiveStatus::pace({100, 90}, {110, 94}), "; 2.5 times real time");
  EXPECT_EQ(LiveStatus::pace({100, 90}, {110, 110}), "; 0.5 times real time");
  EXPECT_EQ(LiveStatus::pace({100, 90}, {100, 90}), "") << "nothing was done";
}

TEST(LiveStatus, showsWarningsAtOnce)
{
  std::ostringstream out;
  StubInput input;
  LiveStatus status("record", out, false);
  input.warnings = {"lidar 'left': silent"};
  status.update(input);
  status.update(input);
  EXPECT_EQ(out.str(), "warning: lidar 'left': silent\n");
}
}  // namespace scanloom::live_status_unittest
