#pragma once
#include <exception>
#include <string>

namespace scanloom
{
/** MRPT puts source file, line and a call stack around its messages: the first line of the innermost is the message. */
std::string messageOf(const std::exception&);
}  // namespace scanloom
