/** The extension scanloom._scanloom; scanloom/__init__.py gives its parts the names and arguments that users see. */
#include "Version.h"
#include "base/config/MrptMessage.h"
#include "base/core/ConfigError.h"
#include "base/core/Text.h"
#include "bindings.h"
#include "keepFreedMemory.h"

#include <string>

namespace
{
namespace py = pybind11;

/** Of a library's exception; its message in the program's words. */
void raise(PyObject* type, const std::exception& error)
{
  PyErr_SetString(type, scanloom::printableLines(error.what()).c_str());
}

/** pybind11 calls the newest translator first, and the next one with what this one does not catch. */
void translate(const std::exception_ptr& thrown, PyObject* usage_error)
try
{
  if (thrown) std::rethrow_exception(thrown);
}
catch (const scanloom::UsageError& error)
{
  raise(usage_error, error);
}
catch (const py::builtin_exception&)  // is a std::runtime_error, too
{
  throw;
}
catch (const py::error_already_set&)
{
  throw;
}
catch (const std::runtime_error& error)
{
  PyErr_SetString(PyExc_RuntimeError, scanloom::printableLines(scanloom::messageIn(error.what())).c_str());
}
}  // namespace

PYBIND11_MODULE(_scanloom, m)
{
  scanloom::keepFreedMemory();
  static PyObject* const usage_error = PyErr_NewExceptionWithDoc(
      "scanloom.UsageError",
      "Wrong input, settings or arguments. The message tells what was given, what is wrong and how to mend it.",
      PyExc_ValueError, nullptr);
  static PyObject* const warning = PyErr_NewExceptionWithDoc(
      "scanloom.ScanloomWarning", "What the program prints as a warning, and results that may be wrong.",
      PyExc_UserWarning, nullptr);
  m.add_object("UsageError", usage_error);
  m.add_object("ScanloomWarning", warning);
  py::register_exception_translator([](std::exception_ptr thrown) { translate(thrown, usage_error); });
  m.attr("__version__") = scanloom::programVersion();

  scanloom::bindScans(m);
  scanloom::bindPoses(m);
  scanloom::bindOdometry(m);
  scanloom::bindRegistration(m);
  scanloom::bindSite(m);
  scanloom::bindEvaluation(m);
}
