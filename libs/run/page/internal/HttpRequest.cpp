#include "run/page/internal/HttpRequest.h"

#include "base/core/Text.h"
#include "input/packets/SensorAddress.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace scanloom
{
namespace
{
/** The text up to `end`, which is taken out of `text` with it. Everything if `end` is not there. */
std::string_view cut(std::string_view& text, std::string_view end)
{
  const std::size_t at = text.find(end);
  const std::string_view first = text.substr(0, at);
  text = at == std::string_view::npos ? std::string_view() : text.substr(at + end.size());
  return first;
}

bool isPrintable(std::string_view text)
{
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; });
}

std::uint64_t numberIn(const std::string& text)
{
  std::uint64_t number = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (text.empty() || error != std::errc() || rest != end) throw BadRequest(kHttpBadRequest, "a number is expected");
  return number;
}

void readTarget(std::string_view target, HttpRequest& request)
{
  if (target.empty() || target.front() != '/') throw BadRequest(kHttpBadRequest, "the path must begin with /");
  request.path = cut(target, "?");
  while (!target.empty())
  {
    std::string_view value = cut(target, "&");
    const std::string_view name = cut(value, "=");
    request.query[std::string(name)] = value;
  }
}

void readHeader(std::string_view line, HttpRequest& request)
{
  const std::size_t colon = line.find(':');
  if (colon == 0 || colon == std::string_view::npos) throw BadRequest(kHttpBadRequest, "a header without a name");
  const std::string name = lowerCase(line.substr(0, colon));
  // Two lengths or hosts: which one counts is what attacks on proxies live on.
  if (!request.headers.emplace(name, trimmed(line.substr(colon + 1))).second)
    throw BadRequest(kHttpBadRequest, "a header is there twice");
  if (request.headers.size() > HttpRequest::kMostHeaders) throw BadRequest(kHttpHeadTooLarge, "too many headers");
}

bool isThisComputer(const std::string& host, std::uint16_t port)
{
  const std::string suffix = fmt::format(":{}", port);
  if (host == "localhost" + suffix || (port == SensorAddress::kHttpPort && host == "localhost")) return true;
  try
  {
    return SensorAddress::parse(host).port == port && host.find_first_not_of("0123456789.:[]abcdefABCDEF") == host.npos;
  }
  catch (const std::invalid_argument&)
  {
    return false;
  }
}
}  // namespace

std::string HttpRequest::header(const std::string& name) const
{
  const auto found = headers.find(name);
  return found == headers.end() ? "" : found->second;
}

std::uint64_t HttpRequest::number(const std::string& name) const
{
  const auto found = query.find(name);
  return found == query.end() ? 0 : numberIn(found->second);
}

std::size_t HttpRequest::bodyBytes() const
{
  if (headers.count("transfer-encoding")) throw BadRequest(kHttpBadRequest, "a body must come with its length");
  if (!headers.count("content-length")) return 0;
  const std::uint64_t bytes = numberIn(header("content-length"));
  if (bytes > kMostBodyBytes) throw BadRequest(kHttpTooLarge, "the body is too large");
  return static_cast<std::size_t>(bytes);
}

HttpRequest parseHead(std::string_view head)
{
  if (head.size() > HttpRequest::kMostHeadBytes) throw BadRequest(kHttpHeadTooLarge, "the head is too large");
  HttpRequest request;
  std::string_view first = cut(head, "\r\n");
  if (!isPrintable(first)) throw BadRequest(kHttpBadRequest, "the request line is no text");
  request.method = cut(first, " ");
  const std::string_view target = cut(first, " ");
  if (first != "HTTP/1.1" && first != "HTTP/1.0") throw BadRequest(kHttpBadRequest, "HTTP/1.1 is expected");
  if (request.method != "GET" && request.method != "POST")
    throw BadRequest(kHttpNotAllowed, "only GET and POST are answered");
  readTarget(target, request);
  while (!head.empty())
  {
    const std::string_view line = cut(head, "\r\n");
    if (line.empty()) break;
    if (!isPrintable(line)) throw BadRequest(kHttpBadRequest, "a header is no text");
    readHeader(line, request);
  }
  return request;
}

void refuseForeign(const HttpRequest& request, std::uint16_t port)
{
  const std::string host = request.header("host");
  if (!isThisComputer(host, port))
    throw BadRequest(kHttpForbidden,
                     "ask by IP address or localhost: the Host of this request is another computer's name");
  const std::string origin = request.header("origin");
  if (request.method == "POST" && origin != "http://" + host)
    throw BadRequest(kHttpForbidden, "only the page itself may send this");
}
}  // namespace scanloom
