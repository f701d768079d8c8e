/** The version of the program. */
#pragma once

namespace scanloom
{
/** `0.1.0+4350a2f1c0`; with `-dirty` if files differed from the commit; `0.1.0` if there was no repository. */
const char* programVersion();
}  // namespace scanloom
