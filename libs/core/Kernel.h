/** The same work for the instruction sets that machines have: chosen at run time, equal to the bit. */
#pragma once
#include <string_view>
#include <vector>

namespace scanloom
{
enum class Kernel
{
  Portable,  // what every machine of the build's target has
  Avx2,      // AVX2, BMI2, PCLMULQDQ: Intel since 2013, AMD since 2015
  Avx512,    // F, BW, DQ, VL, VBMI, VPCLMULQDQ: Intel servers since 2021, AMD since 2022
};

std::string_view nameOf(Kernel);

/** Those that this machine can run, narrowest first. */
const std::vector<Kernel>& runnableKernels();

bool isRunnable(Kernel);

/** The last of runnableKernels(). */
Kernel widestKernel();
}  // namespace scanloom
