#include "Web.h"

#include "base/core/ConfigError.h"

#include <fmt/format.h>

namespace scanloom
{
namespace
{
constexpr const char* kDefaultAddress = "127.0.0.1:8080";
constexpr std::uint16_t kDefaultPort = 8080;

bool isLoopback(const IpAddress& ip)
{
  const std::string text = SensorAddress{ip}.text();
  return text.rfind("127.", 0) == 0 || text == "::1";
}
}  // namespace

void addWeb(CLI::App& app, WebArguments& arguments)
{
  addOption(app, "--web", arguments.address,
            fmt::format("show the run on a page for browsers; default: http://{}. Other computers reach it at an "
                        "address of this one, or 0.0.0.0:8080 for all",
                        kDefaultAddress))
      .optionalValue(kDefaultAddress)
      .typeName("ADDRESS:PORT");
}

SensorAddress webAddress(const WebArguments& arguments)
{
  const std::string text = arguments.given() ? arguments.address : kDefaultAddress;
  try
  {
    SensorAddress address = SensorAddress::parse(text);
    const std::string web_port = fmt::format(":{}", SensorAddress::kHttpPort);
    const bool has_web_port =
        text.size() > web_port.size() && text.compare(text.size() - web_port.size(), web_port.size(), web_port) == 0;
    if (address.port == SensorAddress::kHttpPort && !has_web_port) address.port = kDefaultPort;
    return address;
  }
  catch (const std::invalid_argument& error)
  {
    throw UsageError(fmt::format("--web {}: {}; without an address write --web last, or --web={}", text, error.what(),
                                 kDefaultAddress));
  }
}

void announcePage(const std::string& url, const SensorAddress& address)
{
  fmt::print(stderr, "{}\n", url);
  if (!isLoopback(address.ip))
    fmt::print(stderr, "warning: everyone who reaches {} sees the map and may mark events\n", address.text());
}

Web::Web(const WebArguments& arguments, const ViewedWork& work, SensorInput& input, const std::filesystem::path& folder)
  : feed_(exchange_, work),
    input_(input, feed_),
    server_(webAddress(arguments), exchange_, LiveServerOptions{5e6, 8, folder})
{
  announcePage(server_.url(), webAddress(arguments));
}

void Web::update(const FeedProgress& progress)
{
  constexpr auto kAccountEvery = 200ms;  // the account is copied whole
  const auto now = LiveFeed::Clock::now();
  if (now - accounted_ >= kAccountEvery)
  {
    feed_.update(input_.account(), progress, now);
    accounted_ = now;
  }
  feed_.offer(now);
}

std::unique_ptr<Web> openWeb(const WebArguments& arguments, const ViewedWork& work, SensorInput& input,
                             const std::filesystem::path& folder)
{
  if (!arguments.given()) return nullptr;
  return std::make_unique<Web>(arguments, work, input, folder.empty() ? "." : folder);
}
}  // namespace scanloom
