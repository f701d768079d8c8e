/** The lists in the texts of [experiment]. */
#pragma once
#include "base/config/Configuration.h"

#include <cstdint>
#include <string>
#include <vector>

namespace scanloom
{
/** Separated by blanks. */
std::vector<std::string> wordsOf(const std::string& text);

/** Separated by |, without the blanks around them. */
std::vector<std::string> valuesOf(const std::string& text);

/** "1 3" or "1:10". Throws ConfigError with the place of `seeds`. */
std::vector<std::uint64_t> seedsOf(const std::string& text, const Configuration&);

/** Whole numbers from 1 on. Throws ConfigError with the place of `every_nth`. */
std::vector<int> countsOf(const std::string& text, const Configuration&);
}  // namespace scanloom
