#include "nodeMessage.h"

#include "input/bags/MessageWriter.h"

namespace scanloom
{
std::vector<std::uint8_t> nodeMessage(bool long_ids, const std::string& name_space, const std::string& name,
                                      const Guid& participant, const std::vector<Guid>& readers,
                                      const std::vector<Guid>& writers)
{
  MessageWriter message;
  const auto id = [&](const Guid& guid)
  {
    std::vector<std::uint8_t> bytes(guid.begin(), guid.end());
    bytes.resize(long_ids ? 24 : guid.size());
    message.byteArray(bytes);
  };
  const auto ids = [&](const std::vector<Guid>& guids)
  {
    message.number(static_cast<std::uint32_t>(guids.size()));
    for (const Guid& guid : guids) id(guid);
  };
  id(participant);
  message.number(std::uint32_t{1});  // nodes
  message.string(name_space);
  message.string(name);
  ids(readers);
  ids(writers);
  return message.bytes();
}
}  // namespace scanloom
