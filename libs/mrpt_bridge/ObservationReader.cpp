#include "mrpt_bridge/ObservationReader.h"

#include "config/MrptMessage.h"
#include "mrpt_bridge/registerClasses.h"

#include <fmt/format.h>
#include <mrpt/obs/CSensoryFrame.h>

namespace scanloom
{
ObservationReader::ObservationReader(const std::filesystem::path& path) : archive_(GzipArchive::reading(path))
{
  registerClasses();
}

mrpt::obs::CObservation::Ptr ObservationReader::next()
{
  while (waiting_.empty() && !ended_) readObject();
  if (waiting_.empty()) return nullptr;
  auto observation = waiting_.front();
  waiting_.pop_front();
  return observation;
}

void ObservationReader::readObject()
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
      waiting_.insert(waiting_.end(), frame->begin(), frame->end());
    else
      passed_over_++;
  }
  catch (const std::exception& e)
  {
    ended_ = true;
    damage_ = fmt::format("after {} objects: {}", objects_, messageIn(e.what()));
  }
}
}  // namespace scanloom
