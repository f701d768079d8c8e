#include "lab/simulation/internal/Machine.h"

#include <fmt/format.h>

#include <sstream>
#include <stdexcept>

namespace scanloom
{
namespace
{
Eigen::AlignedBox3d boxFrom(const char* name, const std::string& text)
{
  std::istringstream stream(text);
  Eigen::Vector3d min, max;
  std::string rest;
  const bool complete(stream >> min.x() >> min.y() >> min.z() >> max.x() >> max.y() >> max.z());
  if (complete && !(stream >> rest) && (min.array() < max.array()).all()) return {min, max};
  throw std::invalid_argument(fmt::format(
      "[simulated_machine] {} = {}: must be six numbers, xmin ymin zmin xmax ymax zmax, each min below its max", name,
      text));
}
}  // namespace

Machine::Machine(const MachineOptions& options, const Boom& boom) : boom_(boom)
{
  MachineOptions::fields(options,
                         [&](const std::string& text, const Field& field)
                         {
                           if (!text.empty()) body_.push_back(boxFrom(field.name.c_str(), text));
                         });
}
}  // namespace scanloom
