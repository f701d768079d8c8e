/**
 * A recording as a folder: recording.pcap, <lidar>.json, imu.csv (EuRoC), groundtruth.tum (100 Hz), total_station.csv,
 * extrinsics.txt, objects.csv (10 Hz) and summary.json.
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
std::vector<std::string> recordingFileNames(const SimulationSettings&);

/**
 * The same scene gives the same bytes, on any number of threads. Everything is written as it is simulated: memory does
 * not grow with the recording. `progress` is called with the share done and may throw to stop. Throws
 * std::runtime_error if a file cannot be written; the folder must exist.
 */
void writeRecording(const Scene&, const std::filesystem::path& folder, const std::function<void(double)>& progress);

/** What writeTruth() writes. */
std::vector<std::string> truthFileNames();

/** What a trajectory is evaluated by, without the packets: groundtruth.tum, total_station.csv and extrinsics.txt. */
void writeTruth(const Scene&, const std::filesystem::path& folder);
}  // namespace scanloom
