#pragma once
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>

namespace scanloom
{
/**
 * Calls `apply` with 0 to count - 1 on several threads, at least `grain` numbers at a time on one of them: some 20 us
 * of work. What is applied to one number must not depend on that to another.
 */
template <typename Apply>
void forAll(std::size_t count, std::size_t grain, const Apply& apply)
{
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                    [&](const tbb::blocked_range<std::size_t>& range)
                    {
                      for (std::size_t i = range.begin(); i != range.end(); ++i) apply(i);
                    });
}
}  // namespace scanloom
