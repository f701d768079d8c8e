/** The operations of `scanloom edit` that stream a rawlog, made from the values of the command line. */
#pragma once
#include "input/rig/RecordingHeader.h"
#include "mrpt/edit/RawlogEdit.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/** One member for each option of the command line, and therefore many; an empty one was not given. */
struct EditOptions
{
  std::string from_time, to_time;
  std::optional<std::uint64_t> from_index, to_index;
  std::vector<std::string> keep_label, remove_label, keep_lidars;
  bool split_lidars = false, merge_lidars = false;
  std::optional<std::uint64_t> keep_every;
  std::string time_offset, crop_box;
  std::string ranges;
  std::optional<double> voxel, rebatch;
  std::filesystem::path apply_extrinsics;
  std::string convert_clouds;
  std::string export_as;
  std::filesystem::path to_mcap;
  std::string deskew;
  std::filesystem::path trajectory;
};

/** What an operation writes instead of a rawlog. */
struct EditOutputs
{
  std::vector<std::filesystem::path> files;
  std::filesystem::path folder;  // or the folder for files whose names depend on the input

  bool empty() const { return files.empty() && folder.empty(); }
};

struct EditOperation
{
  std::string option;  // "--split-lidars"; "cut" for --from-... and --to-...
  EditOutputs outputs;
  std::vector<std::filesystem::path> inputs;  // that it reads beside the rawlog
  std::function<RawlogOperation(const std::optional<RecordingHeader>&, const EditOutputs&)> make;

  bool writesRawlog() const { return outputs.empty(); }
};

/**
 * The operations that the options ask for, the cut first. Throws UsageError for a value that cannot be used, and what
 * the readers of the named files throw.
 * @param notice receives what a person should know, one line each.
 */
std::vector<EditOperation> editOperations(const EditOptions&, const std::filesystem::path& input,
                                          const std::function<void(const std::string&)>& notice);

/**
 * At least one operation, each one receiving what the one before returns, for the rawlog `input`.
 * @param outputs where the last operation writes, in place of its own outputs.
 */
RawlogOperation chained(const std::vector<EditOperation>&, const std::filesystem::path& input,
                        const EditOutputs& outputs);
}  // namespace scanloom
