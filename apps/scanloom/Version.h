/** Which program this is. */
#pragma once

namespace scanloom
{
/** `0.1.0+4350a2f1c0`, with `-dirty` if it was built with changes that no commit holds; `0.1.0` without a repository.
 */
const char* programVersion();
}  // namespace scanloom
