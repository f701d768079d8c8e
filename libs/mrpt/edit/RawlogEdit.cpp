#include "mrpt/edit/RawlogEdit.h"

#include "base/core/OutputFile.h"
#include "mrpt/observations/GzipArchive.h"
#include "mrpt/observations/ObservationReader.h"
#include "mrpt/observations/readByAll.h"

#include <mrpt/obs/CObservation.h>

#include <utility>

namespace scanloom
{
namespace
{
constexpr int kCompressionLevel = 1;  // half of the size of level 0; higher ones save little more

using Sink = std::function<void(const mrpt::obs::CObservation&)>;

RawlogEdited stream(const std::filesystem::path& input, const RawlogOperation& operation, const Sink& sink,
                    const KeepReading& keep_reading)
{
  ObservationReader reader(input);
  RawlogEdited edited;
  const auto pass = [&](const ObservationPtr& observation)
  {
    for (const ObservationPtr& result : operation(observation))
    {
      ++edited.labels[result->sensorLabel].written;
      sink(*result);
    }
  };
  while (const ObservationPtr observation = reader.next())
  {
    ++edited.labels[observation->sensorLabel].read;
    pass(observation);
    edited.stopped = !keep_reading(reader.bytesRead());
    if (edited.stopped) break;
  }
  pass(nullptr);
  edited.passed_over = reader.passedOver();
  edited.damage = reader.damage();
  return edited;
}
}  // namespace

RawlogOperation chained(RawlogOperation first, RawlogOperation second)
{
  return [first = std::move(first), second = std::move(second)](const ObservationPtr& observation)
  {
    Observations results;
    const auto pass = [&](const ObservationPtr& passed)
    {
      for (ObservationPtr& result : second(passed)) results.push_back(std::move(result));
    };
    for (const ObservationPtr& between : first(observation)) pass(between);
    if (!observation) pass(nullptr);
    return results;
  };
}

RawlogOperation readOnly(std::function<void(const ObservationPtr&)> add, std::function<void()> close)
{
  return [add = std::move(add), close = std::move(close)](const ObservationPtr& observation)
  {
    if (observation)
      add(observation);
    else
      close();
    return Observations{};
  };
}

std::uint64_t RawlogEdited::read() const
{
  std::uint64_t sum = 0;
  for (const auto& [label, count] : labels) sum += count.read;
  return sum;
}

std::uint64_t RawlogEdited::written() const
{
  std::uint64_t sum = 0;
  for (const auto& [label, count] : labels) sum += count.written;
  return sum;
}

RawlogEdited readRawlog(const std::filesystem::path& input, const RawlogOperation& operation,
                        const KeepReading& keep_reading)
{
  return stream(
      input, operation, [](const mrpt::obs::CObservation&) {}, keep_reading);
}

RawlogEdited editRawlog(const std::filesystem::path& input, const RawlogOperation& operation,
                        const std::filesystem::path& output, const KeepReading& keep_reading)
{
  OutputFile file(output);
  GzipArchive archive(file.temporary(), kCompressionLevel);
  RawlogEdited edited = stream(
      input, operation, [&](const mrpt::obs::CObservation& observation) { writeForAll(observation, archive); },
      keep_reading);
  archive.close();
  edited.output = file.commit(edited.stopped ? Completeness::Partial : Completeness::Whole);
  return edited;
}
}  // namespace scanloom
