#include "run/page/Player.h"

#include <gtest/gtest.h>

#include <thread>

namespace scanloom::player_unittest
{
namespace
{
/** Ten scans a second without points. */
class Recording : public SensorInput
{
 public:
  explicit Recording(int scans) : scans_(scans) {}

  std::optional<SensorEvent> next(Duration) override
  {
    if (next_ >= scans_)
    {
      ended_ = true;
      return std::nullopt;
    }
    Scan scan;
    scan.start = fromNanoseconds(100000000LL * next_++);
    scan.period = 100ms;
    return scan;
  }
  bool ended() const override { return ended_; }
  void stop() override { ended_ = true; }
  SensorSetup setup() const override { return {}; }
  double progress() const override { return static_cast<double>(next_) / scans_; }

 private:
  int scans_, next_ = 0;
  bool ended_ = false;
};

/** A player of 20 s, in a thread of its own. */
struct Playing
{
  explicit Playing(Trajectory poses = {})
    : player([] { return std::make_unique<Recording>(200); }, std::move(poses), exchange),
      thread([this] { player.run([this] { return !ended; }); })
  {
  }
  ~Playing()
  {
    ended = true;
    thread.join();
  }

  void command(const std::string& text)
  {
    const std::lock_guard lock(exchange.mutex);
    exchange.commands.push_back(text);
  }

  PlayerStatus status()
  {
    const std::lock_guard lock(exchange.mutex);
    return exchange.status.player.value_or(PlayerStatus{});
  }

  /** The status once it is so, or after 20 s. */
  template <typename IsSo>
  PlayerStatus once(const IsSo& isSo)
  {
    for (int i = 0; i < 2000 && !isSo(status()); ++i) std::this_thread::sleep_for(10ms);
    return status();
  }

  PlayerStatus onceAt(double position)
  {
    return once([&](const PlayerStatus& s) { return std::abs(s.position - position) < 0.01; });
  }

  LiveExchange exchange;
  Player player;
  std::atomic<bool> ended{false};
  std::thread thread;
};
}  // namespace

TEST(Player, playsNoFasterThanTheSensors)
{
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  Playing playing;
  const double position = playing.once([](const PlayerStatus& s) { return s.position > 1; }).position;
  EXPECT_GT(position, 1);
  EXPECT_LT(position, std::chrono::duration<double>(Clock::now() - begin).count() + 0.2);
}

TEST(Player, pausesStepsAndGoesBothWays)
{
  Playing playing;
  playing.once([](const PlayerStatus& s) { return s.position > 0; });
  playing.command("pause");
  const double at = playing.once([](const PlayerStatus& s) { return !s.playing; }).position;
  std::this_thread::sleep_for(300ms);
  EXPECT_EQ(playing.status().position, at);
  playing.command("step");
  EXPECT_NEAR(playing.once([&](const PlayerStatus& s) { return s.position != at; }).position, at + 0.1, 1e-9);
  playing.command("seek 15");
  EXPECT_NEAR(playing.onceAt(15).position, 15, 0.01);
  playing.command("seek 2");
  EXPECT_NEAR(playing.onceAt(2).position, 2, 0.01);
  EXPECT_NEAR(playing.status().length, 20, 0.3);
}

TEST(Player, waitsAtTheEndAndPlaysAgain)
{
  Playing playing;
  playing.command("seek 100");
  EXPECT_FALSE(playing.once([](const PlayerStatus& s) { return s.position > 19 && !s.playing; }).playing);
  playing.command("play");
  const PlayerStatus again = playing.once([](const PlayerStatus& s) { return s.playing; });
  EXPECT_TRUE(again.playing);
  EXPECT_LT(again.position, 19);
}

TEST(Player, tellsTheSpeedThatThePosesShow)
{
  Trajectory poses;
  for (int i = 0; i <= 40; ++i)
    poses.push_back({Timestamp{i * 500ms}, Rigid::fromXyzYawPitchRoll(1.25 * i, 0, 0, 0, 0, 0)});
  Playing playing(poses);
  playing.once([](const PlayerStatus& s) { return s.position > 0; });
  const std::lock_guard lock(playing.exchange.mutex);
  EXPECT_NEAR(playing.exchange.status.speed, 2.5, 1e-6);
}

TEST(PlayerCommand, isOneOfAFew)
{
  EXPECT_EQ(parsePlayerCommand("speed 2.5")->value, 2.5);
  EXPECT_EQ(parsePlayerCommand("seek 0")->value, 0);
  for (const char* text : {"", "Play", "speed", "speed 0", "speed 1e9", "speed nan", "seek -1", "seek 1 2", "seek  1"})
    EXPECT_FALSE(parsePlayerCommand(text)) << text;
}
}  // namespace scanloom::player_unittest
