#pragma once
#include <string>

namespace scanloom
{
/** Whether `a` comes before `b` for a person: like in a dictionary, but numbers by their value, 2.bin before 10.bin. */
bool inNaturalOrder(const std::string& a, const std::string& b);
}  // namespace scanloom
