#include "core/Kernel.h"

namespace scanloom
{
namespace
{
bool hasAvx2()
{
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("pclmul");
}

bool hasAvx512()
{
  return hasAvx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
         __builtin_cpu_supports("avx512vbmi") && __builtin_cpu_supports("vpclmulqdq");
}

std::vector<Kernel> findRunnable()
{
  std::vector<Kernel> kernels{Kernel::Portable};
  if (hasAvx2()) kernels.push_back(Kernel::Avx2);
  if (hasAvx512()) kernels.push_back(Kernel::Avx512);
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
