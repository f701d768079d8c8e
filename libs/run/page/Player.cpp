#include "run/page/Player.h"

#include <algorithm>
#include <thread>
#include <utility>

namespace scanloom
{
namespace
{
constexpr double kBetweenKeyframes = 2;  // m
}  // namespace

Player::Player(Open open, Trajectory poses, LiveExchange& exchange)
  : open_(std::move(open)), poses_(std::move(poses)), feed_(exchange, {"view", false, !poses_.empty()}), input_(open_())
{
  header_ = input_->setup().header;
  keepPace();
}

void Player::run(const std::function<bool()>& keepGoing)
{
  while (keepGoing())
  {
    feed_.offer();
    for (const std::string& text : feed_.takeCommands())
      if (const auto command = parsePlayerCommand(text)) obey(*command);
    const bool going = status_.playing || one_scan_ || wanted_;
    if (going && !input_->ended() && isDue())
      playNext();
    else
      std::this_thread::sleep_for(5ms);
    showState();
  }
}

void Player::obey(const PlayerCommand& command)
{
  using Kind = PlayerCommand::Kind;
  if (command.kind == Kind::Play || command.kind == Kind::Pause) status_.playing = command.kind == Kind::Play;
  if (command.kind == Kind::Speed) status_.speed = command.value;
  if (command.kind == Kind::Seek) return seek(command.value);
  if (command.kind == Kind::Step)
  {
    status_.playing = false;
    one_scan_ = true;
  }
  if (command.kind == Kind::Play && input_->ended()) return seek(0);
  keepPace();
}

void Player::seek(double position)
{
  wanted_ = position;
  if (position >= status_.position && !input_->ended()) return;
  input_ = open_();
  status_.position = 0;
  first_.reset();
  last_keyframe_.reset();
  feed_.restart();
}

/** The clock begins anew at the place where it is. */
void Player::keepPace()
{
  since_ = Clock::now();
  from_ = status_.position;
}

bool Player::isDue() const
{
  if (wanted_ || one_scan_) return true;
  const double played = std::chrono::duration<double>(Clock::now() - since_).count() * status_.speed;
  return status_.position - from_ <= played;
}

void Player::playNext()
{
  const std::optional<SensorEvent> event = input_->next(20ms);
  for (const std::string& warning : input_->takeWarnings()) feed_.warn(warning);
  if (!event)
  {
    if (input_->ended()) wanted_.reset();
    return;
  }
  if (const auto* sample = std::get_if<SensorImu>(&*event)) feed_.add(*sample, header_);
  if (const auto* mark = std::get_if<EventMark>(&*event)) feed_.add(*mark);
  const auto* scan = std::get_if<Scan>(&*event);
  if (!scan) return;
  if (!first_) first_ = scan->start;
  status_.position = seconds(scan->end() - *first_);
  one_scan_ = false;
  const bool sought = wanted_ && status_.position < *wanted_;
  if (sought && poses_.empty()) return;  // the map is made of what is passed over, too
  if (!sought && std::exchange(wanted_, std::nullopt)) keepPace();
  showScan(*scan);
}

void Player::showScan(const Scan& scan)
{
  feed_.add(scan, header_);
  const std::optional<Rigid> pose = poseAt(poses_, scan.end(), 1s);
  if (!pose) return;
  StateEstimate estimate;
  estimate.stamp = scan.end();
  estimate.map_T_body = *pose;
  if (const std::optional<Rigid> before = poseAt(poses_, scan.start, 1s))
    estimate.velocity = (pose->translation - before->translation) / seconds(scan.end() - scan.start);
  if (!last_keyframe_ || (pose->translation - last_keyframe_->translation).norm() > kBetweenKeyframes)
  {
    estimate.keyframe = Keyframe{scan.end(), *pose, scan.points};
    last_keyframe_ = pose;
  }
  feed_.add(estimate);
}

void Player::showState()
{
  const double share = input_->ended() ? 1 : input_->progress();
  constexpr double kEnoughToKnow = 0.02;
  if (input_->ended())
    status_.length = status_.position;
  else if (share > kEnoughToKnow)
    status_.length = std::max(status_.position, status_.position / share);
  PlayerStatus shown = status_;
  shown.playing = status_.playing && !input_->ended();
  feed_.show(shown);
  feed_.update(input_->account(), {});
}
}  // namespace scanloom
