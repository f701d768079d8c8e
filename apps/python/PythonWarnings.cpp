#include "PythonWarnings.h"

#include "base/core/Text.h"

#include <pybind11/pybind11.h>

namespace scanloom
{
void warnInPython(const std::vector<std::string>& warnings, WarnedLine line)
{
  for (const std::string& warning : warnings)
  {
    const pybind11::object category = pybind11::module_::import("scanloom._scanloom").attr("ScanloomWarning");
    if (PyErr_WarnEx(category.ptr(), printableLines(warning).c_str(), static_cast<int>(line)) != 0)
      throw pybind11::error_already_set();
  }
}

void throwIfSignalled()
{
  if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
}
}  // namespace scanloom
