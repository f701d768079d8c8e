#include "LimitedRun.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <thread>

namespace scanloom
{
namespace
{
constexpr const char* kErrors = "stderr.txt";

void limit(int resource, std::uint64_t most)
{
  const rlimit value{most, most};
  if (setrlimit(static_cast<__rlimit_resource>(resource), &value) != 0) _exit(126);
}

using EntryPoint = int (*)(int, char**);

/** Of the library with the verbs, which stays loaded; null for a program, which is to be executed. */
EntryPoint entryPointOf(const std::string& program)
{
  if (std::filesystem::path(program).extension() != ".so") return nullptr;
  void* const library = dlopen(program.c_str(), RTLD_NOW | RTLD_GLOBAL);
  void* const run = library ? dlsym(library, "runScanloom") : nullptr;
  if (!run) throw std::runtime_error(dlerror());
  return reinterpret_cast<EntryPoint>(run);
}

/** In the child. */
[[noreturn]] void become(const std::vector<std::string>& command, EntryPoint run, const std::filesystem::path& folder,
                         const RunLimits& limits)
{
  if (chdir(folder.c_str()) != 0) _exit(126);
  dup2(open("/dev/null", O_RDWR), STDIN_FILENO);
  dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
  dup2(open(kErrors, O_WRONLY | O_CREAT | O_TRUNC, 0666), STDERR_FILENO);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, static_cast<std::uint64_t>(std::ceil(limits.cpu_seconds)));
  if (limits.address_space > 0) limit(RLIMIT_AS, limits.address_space);
  std::vector<char*> arguments;
  for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  // Without the destructors of 200 libraries, which take longer than most verbs.
  if (run) _exit(run(static_cast<int>(command.size()), arguments.data()));
  execv(arguments.front(), arguments.data());
  _exit(127);
}

double secondsOf(const timeval& time)
{
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

std::string beginningOf(const std::filesystem::path& file)
{
  constexpr std::size_t kMost = 4000;
  std::ifstream stream(file, std::ios::binary);
  std::string text(kMost, '\0');
  stream.read(text.data(), kMost);
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return text;
}
}  // namespace

RunResult limitedRun(const std::vector<std::string>& command, const std::filesystem::path& folder,
                     const RunLimits& limits)
{
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  const EntryPoint run = entryPointOf(command.front());
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) become(command, run, folder, limits);

  int status = 0;
  rusage usage{};
  while (wait4(child, &status, WNOHANG, &usage) == 0)
  {
    if (seconds() > limits.wall_seconds) kill(child, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  RunResult result;
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
  result.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (result.status == 126 || result.status == 127) throw std::runtime_error("cannot start " + command.front());
  result.seconds = seconds();
  result.cpu_seconds = secondsOf(usage.ru_utime) + secondsOf(usage.ru_stime);
  result.peak_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
  result.errors = beginningOf(folder / kErrors);
  return result;
}
}  // namespace scanloom
