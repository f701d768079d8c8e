/** A program beside the test, to be interrupted or killed. */
#pragma once
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

extern char** environ;

namespace scanloom
{
class ChildProcess
{
 public:
  /** `command` as for a shell; what it prints on both streams goes to the file `log`. */
  ChildProcess(const std::string& command, std::filesystem::path log) : log_(std::move(log))
  {
    std::string script = "exec " + command + " > " + log_.string() + " 2>&1";
    char shell[] = "/bin/sh", option[] = "-c";
    char* arguments[] = {shell, option, script.data(), nullptr};
    if (posix_spawn(&process_, shell, nullptr, nullptr, arguments, environ) != 0)
      throw std::runtime_error("cannot start: " + command);
  }
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess()
  {
    if (process_ <= 0) return;
    send(SIGKILL);
    wait();
  }

  void send(int signal) const { ::kill(process_, signal); }

  /** Its exit status, or 128 + the signal that ended it. */
  int wait()
  {
    int status = 0;
    ::waitpid(process_, &status, 0);
    process_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  std::string log() const
  {
    std::ifstream file(log_);
    return {std::istreambuf_iterator<char>(file), {}};
  }

 private:
  std::filesystem::path log_;
  pid_t process_ = 0;
};
}  // namespace scanloom
