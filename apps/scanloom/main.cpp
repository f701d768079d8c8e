#include "Program.h"
#include "Verb.h"

namespace scanloom
{
Verb configVerb();

const std::vector<Verb>& verbs()
{
  static const std::vector<Verb> table{
      configVerb(),
  };
  return table;
}
}  // namespace scanloom

int main(int argc, char** argv) { return scanloom::runProgram(argc, argv); }
