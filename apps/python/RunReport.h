/** What Python learns of a run beside its poses. */
#pragma once
#include "PythonWarnings.h"
#include "SlamThread.h"

#include <pybind11/stl.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace scanloom
{
/** Warnings so far, and at the end how the run went, as the program says it by its exit status. */
class RunReport
{
 public:
  /** `sensors_not_used` of the recording: then the result is not good. */
  explicit RunReport(std::size_t sensors_not_used) : sensors_not_used_(sensors_not_used) {}

  /** By warnings.warn(). The GIL must be held. */
  void warn(const std::vector<std::string>&, WarnedLine = WarnedLine::Calling);

  /** Throws std::runtime_error with what ended the run before its end. The GIL must be held. */
  void end(const std::optional<SlamRunResult>&);

  const std::vector<std::string>& warnings() const { return warnings_; }

  /** None before the end. */
  std::optional<std::string> outcome() const;
  std::optional<bool> good() const;
  std::map<std::string, std::uint64_t> counts() const;

 private:
  std::vector<std::string> warnings_;
  std::size_t sensors_not_used_;
  std::optional<SlamRunResult> result_;
};

/** The properties of a class whose `report()` is a RunReport. */
template <typename Run>
void bindReport(pybind11::class_<Run>& run)
{
  run.def_property_readonly(
         "warnings", [](const Run& r) { return r.report().warnings(); }, "list of str: so far.")
      .def_property_readonly(
          "outcome", [](const Run& r) { return r.report().outcome(); },
          "str: OK, or what is wrong with the result; None before the end.")
      .def_property_readonly(
          "good", [](const Run& r) { return r.report().good(); },
          "bool: the program would end with status 0, not 3; None before the end.")
      .def_property_readonly(
          "counts", [](const Run& r) { return r.report().counts(); },
          "dict: of scans, poses and packets, as in summary.json; empty before the end.");
}
}  // namespace scanloom
