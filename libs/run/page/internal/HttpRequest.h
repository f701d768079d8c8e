/** What a browser asks, read from bytes that anyone may have sent. */
#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

namespace scanloom
{
/** Of RFC 9110, section 15. */
enum HttpStatus : int
{
  kHttpOk = 200,
  kHttpBadRequest = 400,
  kHttpForbidden = 403,
  kHttpNotFound = 404,
  kHttpNotAllowed = 405,
  kHttpConflict = 409,
  kHttpTooLarge = 413,
  kHttpHeadTooLarge = 431,
  kHttpFailed = 500,
  kHttpBusy = 503
};

/** A request that is refused, with the status of the answer. */
struct BadRequest : std::runtime_error
{
  BadRequest(HttpStatus answer, const std::string& why) : std::runtime_error(why), status(answer) {}
  HttpStatus status;
};

struct HttpRequest
{
  static constexpr std::size_t kMostHeadBytes = 8192, kMostHeaders = 64, kMostBodyBytes = 1024;

  std::string method;                          // GET or POST
  std::string path;                            // "/points": as it was sent, without the query
  std::map<std::string, std::string> query;    // "?scan=3" -> {scan, 3}: as it was sent
  std::map<std::string, std::string> headers;  // names in lower case
  std::string body;

  /** "" if there is none. */
  std::string header(const std::string& name) const;

  /** A decimal number of the query, 0 if there is none. Throws BadRequest for any other text. */
  std::uint64_t number(const std::string& name) const;

  /** Throws BadRequest if it is no number, larger than kMostBodyBytes, or if the body comes in chunks. */
  std::size_t bodyBytes() const;
};

/** From the request line to the empty line, without a body. Throws BadRequest. */
HttpRequest parseHead(std::string_view head);

/**
 * Against pages of others in the same browser. Throws BadRequest unless the header Host is an IP address or localhost,
 * with `port`: a name that an attacker lets point here (DNS rebinding) is neither. A POST also needs an Origin that is
 * this host.
 */
void refuseForeign(const HttpRequest&, std::uint16_t port);
}  // namespace scanloom
