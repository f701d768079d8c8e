#include "input/ros2/Ros2Node.h"

#include "base/core/ConfigError.h"
#include "base/core/Text.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <stdexcept>

namespace scanloom
{
namespace
{
constexpr std::string_view kTopicPrefix = "rt", kTypeSeparator = "::dds_::";

std::string variable(const char* name)
{
  const char* const value = std::getenv(name);
  return value ? value : "";
}

/** Ports of DDS are computed from the domain: above 232 they would exceed 65535. */
int domainOf(const std::string& text)
{
  constexpr int kMost = 232;
  if (text.empty()) return 0;
  const bool digits = std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c); });
  const int domain = digits && text.size() < 4 ? std::stoi(text) : kMost + 1;
  if (domain > kMost) throw ConfigError(fmt::format("ROS_DOMAIN_ID = {}: a number from 0 to {}", text, kMost));
  return domain;
}

Ros2Network::Range rangeOf(const std::string& text, const std::string& localhost_only)
{
  if (text.empty()) return localhost_only == "1" ? Ros2Network::Range::Localhost : Ros2Network::Range::Subnet;
  if (text == "SUBNET") return Ros2Network::Range::Subnet;
  if (text == "LOCALHOST") return Ros2Network::Range::Localhost;
  if (text == "OFF") return Ros2Network::Range::Off;
  if (text == "SYSTEM_DEFAULT") return Ros2Network::Range::Default;
  throw ConfigError(fmt::format("ROS_AUTOMATIC_DISCOVERY_RANGE = {}: SUBNET, LOCALHOST, OFF or SYSTEM_DEFAULT", text));
}

/** They become a part of Cyclone's XML: what is no host's name or address is refused. */
std::vector<std::string> peersOf(const std::string& list)
{
  std::vector<std::string> peers;
  for (std::size_t begin = 0; begin < list.size();)
  {
    const std::size_t end = std::min(list.find(';', begin), list.size());
    const std::string peer(trimmed(std::string_view(list).substr(begin, end - begin)));
    begin = end + 1;
    if (peer.empty()) continue;
    const auto is_allowed = [](unsigned char c) { return std::isalnum(c) || c == '.' || c == ':' || c == '-'; };
    if (!std::all_of(peer.begin(), peer.end(), is_allowed))
      throw ConfigError(fmt::format("ROS_STATIC_PEERS: '{}' is no host's name or address", peer));
    peers.push_back(peer);
  }
  return peers;
}

std::string replaced(std::string text, const std::string& what, const std::string& by)
{
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
  return text;
}
}  // namespace

Ros2Network ros2NetworkOfEnvironment()
{
  Ros2Network network;
  network.domain = domainOf(variable("ROS_DOMAIN_ID"));
  network.range = rangeOf(variable("ROS_AUTOMATIC_DISCOVERY_RANGE"), variable("ROS_LOCALHOST_ONLY"));
  network.peers = peersOf(variable("ROS_STATIC_PEERS"));
  network.configuration = variable("CYCLONEDDS_URI");
  const std::string distribution = variable("ROS_DISTRO");
  network.long_ids = distribution == "foxy" || distribution == "galactic" || distribution == "humble";
  return network;
}

std::unique_ptr<Ros2Node> openRos2Node(const Ros2Network& network, const std::string& name_space,
                                       const std::string& name)
{
  using Open = Ros2Node* (*)(const Ros2Network&, const std::string&, const std::string&);
  static void* const library = ::dlopen("libscanloom_dds.so", RTLD_NOW);
  void* const open = library ? ::dlsym(library, "scanloomRos2Node") : nullptr;
  if (!open)
  {
    const char* const error = ::dlerror();
    throw std::runtime_error(
        fmt::format("--ros2: Cyclone DDS cannot be loaded ({}); Debian's package is libddsc0debian, and "
                    "cyclonedds-dev where scanloom is built",
                    error ? error : "libscanloom_dds.so"));
  }
  return std::unique_ptr<Ros2Node>(reinterpret_cast<Open>(open)(network, name_space, name));
}

std::string ddsTopicOf(const std::string& ros_topic) { return std::string(kTopicPrefix) + ros_topic; }

std::string ddsTypeOf(const std::string& ros_type)
{
  const std::size_t name = ros_type.rfind('/');
  if (name == std::string::npos) throw std::invalid_argument(ros_type + " is no type of ROS 2 (package/msg/Name)");
  return replaced(ros_type.substr(0, name), "/", "::") + std::string(kTypeSeparator) + ros_type.substr(name + 1) + "_";
}

std::optional<Ros2Topic> rosTopicOf(const std::string& dds_topic, const std::string& dds_type)
{
  const std::size_t separator = dds_type.find(kTypeSeparator);
  if (!beginsWith(dds_topic, std::string(kTopicPrefix) + "/") || separator == std::string::npos ||
      dds_type.back() != '_')
    return std::nullopt;
  const std::size_t name = separator + kTypeSeparator.size();
  return Ros2Topic{dds_topic.substr(kTopicPrefix.size()), replaced(dds_type.substr(0, separator), "::", "/") + "/" +
                                                              dds_type.substr(name, dds_type.size() - name - 1)};
}

bool isRosName(const std::string& name)
{
  if (name.size() < 2 || name.front() != '/' || name.back() == '/') return false;
  for (std::size_t i = 0; i < name.size(); ++i)
  {
    const auto c = static_cast<unsigned char>(name[i]);
    if (!std::isalnum(c) && c != '_' && c != '/') return false;
    if (i > 0 && name[i - 1] == '/' && (c == '/' || std::isdigit(c))) return false;
  }
  return true;
}
}  // namespace scanloom
