#include "base/core/ConfigError.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace scanloom
{
ConfigError::ConfigError(std::vector<std::string> all_problems)
  : UsageError(fmt::format("{}", fmt::join(all_problems, "\n"))), problems(std::move(all_problems))
{
}
}  // namespace scanloom
