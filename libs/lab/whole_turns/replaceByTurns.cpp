#include "lab/whole_turns/replaceByTurns.h"

#include "input/rig/RecognisedRig.h"
#include "mrpt/observations/RawlogWriter.h"
#include "mrpt/observations/RigObservations.h"
#include "mrpt/observations/openInput.h"

namespace scanloom
{
namespace
{
void writeTurns(SensorInput& input, TurnGrouping grouping, const std::filesystem::path& rawlog)
{
  RecordingHeader header = input.setup().header;
  header.scan_rate = 0;
  WholeTurns turns(header.lidars.size(), grouping);
  RawlogWriter writer(rawlog, header);
  const auto write = [&](const SensorEvent& event) { writer.write(*toObservation(event, input.setup(), {})); };
  while (const std::optional<SensorEvent> event = input.next())
    if (const auto* scan = std::get_if<Scan>(&*event))
      for (const Scan& of_turns : turns.push(*scan)) write(of_turns);
    else
      write(*event);
  for (const Scan& of_turns : turns.finish()) write(of_turns);
  writer.close();
}
}  // namespace

void replaceByTurns(const std::filesystem::path& folder, TurnGrouping grouping)
{
  const RecordingFiles files = filesOf({folder});
  const Configuration configuration = Configuration::fromText(recogniseRig(files).ini, "recognised");
  writeTurns(*openInput(sourceOf(files, configuration)), grouping, folder / "recording.rawlog");
  for (const auto& capture : files.captures) std::filesystem::remove(capture);
}
}  // namespace scanloom
