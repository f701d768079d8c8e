/**
 * A recording as a folder: recording.pcap, left.json, right.json, imu.csv (EuRoC), groundtruth.tum (100 Hz),
 * total_station.csv, extrinsics.txt, objects.csv (nothing moves here: only its heading) and summary.json.
 */
#pragma once
#include "simulation/Scene.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace scanloom
{
/** What writeRecording() writes. */
const std::vector<std::string>& recordingFileNames();

/**
 * The same scene gives the same bytes, on any number of threads. `progress` is called with the share done and may throw
 * to stop. Throws std::runtime_error if a file cannot be written; the folder must exist.
 */
void writeRecording(const Scene&, const std::filesystem::path& folder, const std::function<void(double)>& progress);
}  // namespace scanloom
