/** Compares names without regard to case, as MRPT does, and finds the one that was probably meant. */
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace scanloom
{
struct CaseInsensitiveLess
{
  using is_transparent = void;
  bool operator()(std::string_view, std::string_view) const;
};

/** Without regard to case. */
bool sameName(std::string_view, std::string_view);

/** Levenshtein: insertions, deletions and replacements of one character each, without regard to case. */
std::size_t editDistance(std::string_view, std::string_view);

/**
 * `did you mean 'cell_size'?` if a candidate is a few typing errors away from `name`, also with its words in another
 * order, or if candidates contain it. Otherwise `known are 'a', 'b' and 'c'`, or of more than ten the nearest; empty if
 * there are no candidates.
 */
std::string suggestion(std::string_view name, const std::vector<std::string>& candidates);
}  // namespace scanloom
