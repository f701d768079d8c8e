/**
 * A recording as a folder: recording.pcap, <lidar>.json, imu.csv (EuRoC), groundtruth.tum (100 Hz), total_station.csv,
 * extrinsics.txt, objects.csv (10 Hz), trees.csv and summary.json.
 */
#pragma once
#include "lab/simulation/internal/Scene.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace scanloom
{
/** The files that writeRecording() writes. */
std::vector<std::string> recordingFileNames(const SimulationSettings&);

/**
 * The same scene gives the same bytes on any number of threads. Memory does not grow with the length of the recording.
 * `progress` is called with the share done, 0 to 1, and may throw to stop. The folder must exist. Throws
 * std::runtime_error if a file cannot be written.
 */
void writeRecording(const Scene&, const std::filesystem::path& folder, const std::function<void(double)>& progress);
}  // namespace scanloom
