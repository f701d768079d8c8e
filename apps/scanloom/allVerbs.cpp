/** The table of all verbs. */
#include "Verb.h"

namespace scanloom
{
Verb calibrateVerb();
Verb configVerb();
Verb doctorVerb();
Verb editVerb();
Verb evaluateVerb();
Verb experimentVerb();
Verb infoVerb();
Verb mapVerb();
Verb recordVerb();
Verb registerVerb();
Verb reportVerb();
Verb simulateVerb();
Verb siteVerb();
Verb slamVerb();
Verb viewVerb();

const std::vector<Verb>& verbs()
{
  static const std::vector<Verb> table{
      recordVerb(), infoVerb(), editVerb(),     doctorVerb(),     calibrateVerb(),
      configVerb(), slamVerb(), siteVerb(),     evaluateVerb(),   registerVerb(),
      mapVerb(),    viewVerb(), simulateVerb(), experimentVerb(), reportVerb(),
  };
  return table;
}
}  // namespace scanloom
