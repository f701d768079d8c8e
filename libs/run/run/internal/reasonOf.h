#pragma once
#include <exception>
#include <string>

namespace scanloom
{
/** Why a run or a map ended, for a person: the message of the exception, or that memory did not suffice. */
std::string reasonOf(const std::exception&);
}  // namespace scanloom
