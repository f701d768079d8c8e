/** Programs as a person starts them: through the shell. */
#pragma once
#include <sys/wait.h>

#include <cstdio>
#include <string>

namespace scanloom
{
struct Ended
{
  int status;
  std::string output;  // of the streams that the command leaves open
};

inline Ended runProgram(const std::string& command)
{
  std::FILE* pipe = ::popen(command.c_str(), "r");
  std::string output;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) output += static_cast<char>(c);
  return {WEXITSTATUS(::pclose(pipe)), output};
}
}  // namespace scanloom
