#include "base/core/Kernel.h"

namespace scanloom
{
namespace
{
std::vector<Kernel> findRunnable()
{
  std::vector<Kernel> kernels{Kernel::Portable};
#ifdef __x86_64__
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("popcnt")) return kernels;
  kernels.push_back(Kernel::Avx2);
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) kernels.push_back(Kernel::Avx512);
#endif
  return kernels;
}
}  // namespace

std::string_view nameOf(Kernel kernel)
{
  switch (kernel)
  {
    case Kernel::Avx512:
      return "avx512";
    case Kernel::Avx2:
      return "avx2";
    case Kernel::Portable:
      break;
  }
  return "portable";
}

const std::vector<Kernel>& runnableKernels()
{
  static const std::vector<Kernel> kernels = findRunnable();
  return kernels;
}

bool isRunnable(Kernel kernel) { return kernel <= widestKernel(); }

Kernel widestKernel() { return runnableKernels().back(); }
}  // namespace scanloom
