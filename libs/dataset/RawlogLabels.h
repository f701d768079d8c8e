/** Observations by their labels. */
#pragma once
#include "dataset/RawlogEdit.h"

#include <set>
#include <string>

namespace scanloom
{
/** What an observation's label is compared with. At the end of input a label that none had is a mistake. */
class WantedLabels
{
 public:
  explicit WantedLabels(std::set<std::string> labels) : wanted_(std::move(labels)) {}

  bool contain(const mrpt::obs::CObservation&);

  /** Throws UsageError naming a label that did not occur, and the nearest that did. */
  void requireAllSeen() const;

 private:
  std::set<std::string> wanted_;
  std::set<std::string> seen_;
};

/** The header stays, whatever its label. */
RawlogOperation keepLabels(const std::set<std::string>&);
RawlogOperation removeLabels(const std::set<std::string>&);
}  // namespace scanloom
