/** The operations of `scanloom edit` that pass a rawlog object by object: their options, and what they do. */
#pragma once
#include "dataset/RawlogEdit.h"
#include "mrpt_bridge/RecordingHeader.h"

#include <CLI/CLI.hpp>

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
  std::optional<double> min_range, max_range, voxel;
};
void addEditOptions(CLI::App&, EditOptions&);

struct EditOperation
{
  std::string option;  // "--split-lidars"
  std::function<RawlogOperation(const std::optional<RecordingHeader>&)> make;
};

/** In no order, but for the cut, which comes first. Throws UsageError for values that are none. */
std::vector<EditOperation> chosenOperations(const EditOptions&);
}  // namespace scanloom
