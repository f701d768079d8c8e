#pragma once
#include "base/core/Bytes.h"

#include <string>

namespace scanloom
{
/** MD5 as 32 hexadecimal digits: to compare with reference decoders, not for security. */
std::string md5(Bytes);
}  // namespace scanloom
