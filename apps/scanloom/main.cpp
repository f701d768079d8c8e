#include "Program.h"
#include "Verb.h"

namespace scanloom
{
Verb configVerb();
Verb infoVerb();
Verb recordVerb();
Verb slamVerb();

const std::vector<Verb>& verbs()
{
  static const std::vector<Verb> table{
      recordVerb(),
      infoVerb(),
      configVerb(),
      slamVerb(),
  };
  return table;
}
}  // namespace scanloom

int main(int argc, char** argv) { return scanloom::runProgram(argc, argv); }
