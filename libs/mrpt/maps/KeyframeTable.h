/**
 * keyframes.csv, beside keyframes.simplemap: how well each keyframe's pose relative to the ones before it is known,
 * which the map of MRPT has no place for. A row for each keyframe:
 * stamp_ns,begins_map,c00,c10,c11,c20,...,c55: the lower triangle, row by row, of the covariance.
 */
#pragma once
#include "base/core/OutputFile.h"
#include "base/core/Rigid.h"
#include "base/core/Time.h"

#include <filesystem>
#include <vector>

namespace scanloom
{
struct KeyframeRow
{
  Timestamp stamp;
  /** The body was lost since the keyframe before: the pose relative to that one is worth little. */
  bool begins_map = false;
  /** Of the pose in the map of the keyframes before it: boxMinus(truth, estimate), translation (m), rotation (rad),
   * along the body's axes. */
  Matrix6d covariance = Matrix6d::Zero();
};

class KeyframeTableWriter
{
 public:
  explicit KeyframeTableWriter(const std::filesystem::path&);

  void add(const KeyframeRow&);
  void close() { file_.commit(); }

 private:
  OutputFile file_;
};

/** Throws std::runtime_error with file and line for what is no such row. */
std::vector<KeyframeRow> readKeyframeTable(const std::filesystem::path&);
}  // namespace scanloom
