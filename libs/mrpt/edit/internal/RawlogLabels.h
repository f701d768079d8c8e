/** Chooses observations by their labels. */
#pragma once
#include "mrpt/edit/RawlogEdit.h"

#include <set>
#include <string>

namespace scanloom
{
/** A set of labels that remembers which labels occurred, so that a label that never occurs is reported as a mistake. */
class WantedLabels
{
 public:
  explicit WantedLabels(std::set<std::string> labels) : wanted_(std::move(labels)) {}

  bool contain(const mrpt::obs::CObservation&);

  /** Throws UsageError that names a label that did not occur and the nearest one that did. */
  void requireAllSeen() const;

 private:
  std::set<std::string> wanted_;
  std::set<std::string> seen_;
};

/** The header stays, whatever its label. */
RawlogOperation keepLabels(const std::set<std::string>&);
RawlogOperation removeLabels(const std::set<std::string>&);
}  // namespace scanloom
