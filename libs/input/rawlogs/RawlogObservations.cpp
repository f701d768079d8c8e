#include "input/rawlogs/RawlogObservations.h"

#include "base/config/MrptMessage.h"
#include "base/core/Text.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace scanloom
{
namespace
{
/** The class of a map, without its namespace; empty for other objects. */
std::string mapIn(const mrpt::serialization::CSerializable& object)
{
  std::string name = object.GetRuntimeClass()->className;
  name.erase(0, name.rfind(':') + 1);
  return name.find("Map") == std::string::npos ? "" : name;
}
}  // namespace

mrpt::obs::CObservation::Ptr RawlogObservations::next()
{
  while (waiting_.empty() && !ended_) readObject();
  if (waiting_.empty()) return nullptr;
  auto observation = waiting_.front();
  waiting_.pop_front();
  observation->sensorLabel = printable(observation->sensorLabel);  // it ends in messages and JSON
  return observation;
}

void RawlogObservations::readObject()
{
  try
  {
    ended_ = archive_.atEnd();
    if (ended_) return;
    const auto object = archive_.ReadObject();
    objects_++;
    if (auto observation = std::dynamic_pointer_cast<mrpt::obs::CObservation>(object))
      waiting_.push_back(observation);
    else if (auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(object))
      takeFrame(*frame);
    else if (const std::string map = objects_ == 1 ? mapIn(*object) : ""; !map.empty())
      endBecause(
          fmt::format("a {}, which is a map and no recording: 'scanloom map' and 'view' take a .simplemap", map));
    else
      passed_over_++;
  }
  catch (const std::exception& e)
  {
    endBecause(archive_.refused().empty() ? messageIn(e.what()) : archive_.refused());
  }
}

/** An object of a frame that is no observation has become null. */
void RawlogObservations::takeFrame(const mrpt::obs::CSensoryFrame& frame)
{
  std::copy_if(frame.begin(), frame.end(), std::back_inserter(waiting_),
               [](const auto& observation) { return observation != nullptr; });
  passed_over_ += frame.size() - waiting_.size();
}

void RawlogObservations::endBecause(const std::string& why)
{
  ended_ = true;
  waiting_.clear();
  damage_ = fmt::format("after {} objects: {}", objects_, printable(why));  // it may quote the file
}
}  // namespace scanloom
