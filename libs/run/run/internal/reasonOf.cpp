#include "run/run/internal/reasonOf.h"

#include "base/config/MrptMessage.h"

#include <new>

namespace scanloom
{
std::string reasonOf(const std::exception& error)
{
  if (dynamic_cast<const std::bad_alloc*>(&error))
    return "not enough memory: write no maps ([output] maps = false, no dense_map)";
  return messageIn(error.what());
}
}  // namespace scanloom
