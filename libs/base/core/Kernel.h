/** The same work compiled for several instruction sets: chosen at run time, results equal to the bit. */
#pragma once
#include <string_view>
#include <vector>

// Before a function: compile it for a kernel. Elsewhere than on x86 it is compiled as the rest, and never called.
#ifdef __x86_64__
#define SCANLOOM_AVX2 [[gnu::target("avx2")]]
#define SCANLOOM_AVX512 [[gnu::target("avx512f,avx512dq")]]
#else
#define SCANLOOM_AVX2
#define SCANLOOM_AVX512
#endif

namespace scanloom
{
enum class Kernel
{
  Portable,  // what every machine has that the build is for
  Avx2,      // AVX2 and POPCNT: Intel since 2013, AMD since 2015
  Avx512,    // AVX-512 F and DQ
};

std::string_view nameOf(Kernel);

/** Those that this machine can run, narrowest first. */
const std::vector<Kernel>& runnableKernels();

bool isRunnable(Kernel);

/** The last of runnableKernels(). */
Kernel widestKernel();
}  // namespace scanloom
