/** The program `scanloom`: libscanloom_program.so, but for --version: MRPT and what it needs take 0.1 s to load. */
#include "Version.h"
#include "base/core/ExitCode.h"

#include <dlfcn.h>

#include <cstdio>
#include <string_view>

int main(int argc, char** argv)
{
  if (argc == 2 && argv[1] == std::string_view("--version"))
  {
    std::printf("scanloom %s\n", scanloom::programVersion());
    return std::fflush(stdout) == 0 ? scanloom::kDone : scanloom::kFailed;
  }

  void* const program = ::dlopen("libscanloom_program.so", RTLD_NOW | RTLD_GLOBAL);
  void* const run = program ? ::dlsym(program, "runScanloom") : nullptr;
  if (!run)
  {
    std::fprintf(stderr, "scanloom: %s\n", ::dlerror());
    return scanloom::kFailed;
  }
  return reinterpret_cast<int (*)(int, char**)>(run)(argc, argv);
}
