#pragma once
#include <exception>
#include <string>

namespace scanloom
{
/** What the exception says by which the action ends; "" if it ends without one. Other exceptions than these pass. */
template <typename Exception = std::exception, typename Action>
std::string messageOf(const Action& action)
try
{
  action();
  return "";
}
catch (const Exception& e)
{
  return e.what();
}
}  // namespace scanloom
