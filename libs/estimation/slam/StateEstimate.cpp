#include "estimation/slam/StateEstimate.h"

namespace scanloom
{
std::string toString(Health health)
{
  switch (health)
  {
    case Health::Initialising:
      return "INITIALISING";
    case Health::Ok:
      return "OK";
    case Health::Degenerate:
      return "DEGENERATE";
    case Health::Lost:
      return "LOST";
  }
  return "";
}
}  // namespace scanloom
