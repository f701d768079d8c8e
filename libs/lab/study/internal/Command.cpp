#include "lab/study/internal/Command.h"

#include "base/core/ExitCode.h"
#include "base/core/Interruption.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <thread>

namespace scanloom
{
namespace
{
using namespace std::chrono_literals;

std::string quoted(const std::string& word)
{
  constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,:/@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::vector<char*> pointersTo(std::vector<std::string>& words)
{
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

/** The given variables come first: of two with the same name getenv() finds the first. */
std::vector<std::string> withOwnEnvironment(std::vector<std::string> environment)
{
  for (char** variable = environ; *variable; ++variable) environment.emplace_back(*variable);
  return environment;
}

/** stdin is empty; stdout and stderr go to the end of the log. */
class Streams
{
 public:
  explicit Streams(const std::filesystem::path& log)
  {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
    posix_spawn_file_actions_adddup2(&actions_, STDOUT_FILENO, STDERR_FILENO);
  }
  Streams(const Streams&) = delete;
  Streams& operator=(const Streams&) = delete;
  ~Streams() { posix_spawn_file_actions_destroy(&actions_); }

  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

/** Polls, because a signal interrupts only one of the threads that may wait here. */
int statusOf(pid_t process)
{
  int status = 0;
  bool sent = false;
  while (::waitpid(process, &status, WNOHANG) == 0)
  {
    if (interrupted() && !sent)
    {
      ::kill(process, SIGTERM);
      sent = true;
    }
    std::this_thread::sleep_for(20ms);
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::string lastLineOf(const std::filesystem::path& log)
{
  std::ifstream file(log);
  std::string last;
  for (std::string line; std::getline(file, line);)
    if (!line.empty()) last = line;
  return last;
}
}  // namespace

std::string toText(const Command& command)
{
  std::string text;
  for (const auto* words : {&command.environment, &command.words})
    for (const std::string& word : *words) text += (text.empty() ? "" : " ") + quoted(word);
  return text;
}

void addSettings(std::vector<std::string>& words, const std::vector<std::pair<std::string, std::string>>& settings)
{
  for (const auto& [name, value] : settings)
  {
    words.emplace_back("--set");
    words.push_back(name + '=' + value);
  }
}

std::filesystem::path ownExecutable() { return std::filesystem::read_symlink("/proc/self/exe"); }

int runCommand(const Command& command, const std::filesystem::path& log)
{
  std::vector<std::string> words = command.words, environment = withOwnEnvironment(command.environment);
  const Streams streams(log);
  pid_t process = 0;
  const int error = ::posix_spawnp(&process, words.front().c_str(), streams.get(), nullptr, pointersTo(words).data(),
                                   pointersTo(environment).data());
  if (error != 0) throw std::runtime_error(fmt::format("cannot start {}: {}", words.front(), std::strerror(error)));
  return statusOf(process);
}

void runVerb(const Command& command, const std::filesystem::path& log)
{
  const int status = runCommand(command, log);
  if (status != kDone && status != kQualityGate)
    throw std::runtime_error(fmt::format("{} ended with status {}: {}", command.words.at(1), status, lastLineOf(log)));
}
}  // namespace scanloom
