#include "mrpt/observations/RigRecording.h"

#include "mrpt/observations/RawlogWriter.h"
#include "mrpt/observations/RigObservations.h"

namespace scanloom
{
Recorded recordRig(SensorInput& input, const DriverOptions& options, RawlogWriter& writer,
                   const KeepRecording& keep_recording)
{
  Recorded recorded;
  while (!input.ended())
  {
    if (const std::optional<SensorEvent> event = input.next(100ms))
    {
      writer.write(*toObservation(*event, input.setup(), options));
      if (std::holds_alternative<Scan>(*event)) ++recorded.scans;
      if (std::holds_alternative<SensorImu>(*event)) ++recorded.imu_samples;
      if (std::holds_alternative<EventMark>(*event)) ++recorded.marks;
    }
    writer.secure();
    if (!keep_recording(recorded)) input.stop();
  }
  return recorded;
}
}  // namespace scanloom
