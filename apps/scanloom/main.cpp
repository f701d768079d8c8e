#include "Program.h"
#include "Verb.h"

namespace scanloom
{
Verb configVerb();
Verb doctorVerb();
Verb editVerb();
Verb evaluateVerb();
Verb infoVerb();
Verb recordVerb();
Verb registerVerb();
Verb simulateVerb();
Verb slamVerb();

const std::vector<Verb>& verbs()
{
  static const std::vector<Verb> table{
      recordVerb(), infoVerb(),     editVerb(),     doctorVerb(),   configVerb(),
      slamVerb(),   evaluateVerb(), registerVerb(), simulateVerb(),
  };
  return table;
}
}  // namespace scanloom

int main(int argc, char** argv) { return scanloom::runProgram(argc, argv); }
