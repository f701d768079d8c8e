#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace scanloom
{
using Guid = std::array<std::uint8_t, 16>;  // of a participant, reader or writer in DDS

/** What `ros2 node list` and `ros2 topic info` show: rmw_dds_common/msg/ParticipantEntitiesInfo., with its
 * encapsulation. Identifiers have 24 bytes if `long_ids`. */
std::vector<std::uint8_t> nodeMessage(bool long_ids, const std::string& name_space, const std::string& name,
                                      const Guid& participant, const std::vector<Guid>& readers,
                                      const std::vector<Guid>& writers);
}  // namespace scanloom
