#pragma once
#include "core/Bytes.h"

#include <string>

namespace scanloom
{
/** MD5 as 32 hexadecimal digits: a checksum against reference decodes, not a protection against anybody. */
std::string md5(Bytes);
}  // namespace scanloom
