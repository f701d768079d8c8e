/**
 * Any bytes as the head of a request: a request within its bounds, or BadRequest; and a request that is not refused as
 * foreign names an address or localhost. The first byte chooses lines to begin with; the rest as a player's command.
 * fuzz options: -max_len=1024
 * fuzz sources: run/page/internal/HttpRequest.cpp run/page/internal/PlayerCommand.cpp
 * fuzz libs: scanloom_packets
 */
#include <array>
#include <cstdint>
#include <string>

#include "require.h"
#include "run/page/internal/HttpRequest.h"
#include "run/page/internal/PlayerCommand.h"

using namespace scanloom;

namespace
{
const std::array<std::string, 4> kBeginnings{"", "GET /points?", "POST /mark HTTP/1.1\r\nHost: 127.0.0.1:8080\r\n",
                                             "GET / HTTP/1.1\r\nHost: "};

void use(const HttpRequest& request)
{
  require(request.method == "GET" || request.method == "POST");
  require(request.headers.size() <= HttpRequest::kMostHeaders);
  require(!request.path.empty() && request.path.front() == '/');
  require(request.bodyBytes() <= HttpRequest::kMostBodyBytes);
  for (const auto& [name, value] : request.headers) require(!name.empty() && value.find('\n') == std::string::npos);
  refuseForeign(request, 8080);
  require(request.header("host").find_first_not_of("0123456789abcdefABCDEF.:[]localhost") == std::string::npos);
  for (const auto& [name, value] : request.query) request.number(name);
}
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  if (size == 0) return 0;
  const std::string rest(data + 1, data + size);
  try
  {
    use(parseHead(kBeginnings[data[0] % kBeginnings.size()] + rest));
  }
  catch (const BadRequest& refused)
  {
    require(refused.status >= 400 && refused.status < 600);
  }
  if (const auto command = parsePlayerCommand(rest)) require(command->value >= 0 && command->value < 1e300);
  return 0;
}
