#include "dataset/RawlogFromCaptures.h"

#include "mrpt_bridge/RawlogWriter.h"
#include "mrpt_bridge/RigObservations.h"

namespace scanloom
{
RigAccount rawlogFromCaptures(const Rig& rig, const DriverOptions& driver, const std::filesystem::path& output,
                              const KeepBatching& keep_batching)
{
  const std::unique_ptr<RigInput> input = openRig(rig);
  RawlogWriter writer(output, recordingHeader(rig));
  while (const std::optional<SensorEvent> event = input->next())
  {
    writer.write(*toObservation(*event, rig, driver));
    if (!keep_batching(input->progress())) input->stop();
  }
  writer.close();
  return input->account();
}
}  // namespace scanloom
