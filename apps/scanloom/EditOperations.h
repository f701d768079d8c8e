/** The operations of `scanloom edit` that pass a rawlog object by object: their options, and what they do. */
#pragma once
#include "dataset/RawlogEdit.h"
#include "mrpt_bridge/RecordingHeader.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/** As given on the command line; what is empty was not. */
struct EditOptions
{
  std::string from_time, to_time;
  std::optional<std::uint64_t> from_index, to_index;
  std::vector<std::string> keep_label, remove_label, keep_lidars;
  bool split_lidars = false, merge_lidars = false;
  std::optional<std::uint64_t> keep_every;
  std::string time_offset, crop_box;
  std::optional<double> min_range, max_range, voxel, rebatch;
  std::filesystem::path apply_extrinsics;
  std::string convert_clouds;
  std::filesystem::path export_ply, export_pcd, export_kitti, export_csv, export_tum;
  std::string deskew, imu;
  std::filesystem::path to_simplemap, to_octomap, trajectory;
  double keyframe_distance = 4;
  std::string octomap_preset = "inventory";
};
void addEditOptions(CLI::App&, EditOptions&);

struct EditOperation
{
  std::string option;                        // "--split-lidars"
  std::vector<std::filesystem::path> files;  // that it writes in place of a rawlog
  std::filesystem::path folder;              // or where it writes files that only the input can name
  std::function<RawlogOperation(const std::optional<RecordingHeader>&)> make;
};

/** The cut comes first. Throws UsageError for values that are none, and what the readers of files throw. */
std::vector<EditOperation> chosenOperations(const EditOptions&, const std::filesystem::path& input);
}  // namespace scanloom
