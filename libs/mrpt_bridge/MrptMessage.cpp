#include "mrpt_bridge/MrptMessage.h"

namespace scanloom
{
std::string messageOf(const std::exception& e)
{
  const std::string what = e.what();
  const auto message = what.find("Message: ");
  const auto start = message == std::string::npos ? 0 : what.find_first_not_of(' ', message + 9);
  return what.substr(start, what.find('\n', start) - start);
}
}  // namespace scanloom
