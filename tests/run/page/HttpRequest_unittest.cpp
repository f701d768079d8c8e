#include "run/page/internal/HttpRequest.h"

#include <gtest/gtest.h>

namespace scanloom::http_request_unittest
{
namespace
{
HttpStatus refusalOf(const std::string& head)
{
  try
  {
    HttpRequest request = parseHead(head);
    request.bodyBytes();
    refuseForeign(request, 8080);
  }
  catch (const BadRequest& refused)
  {
    return refused.status;
  }
  return kHttpOk;
}

std::string asked(const std::string& host, const std::string& rest = "")
{
  return "GET / HTTP/1.1\r\nHost: " + host + "\r\n" + rest + "\r\n";
}

std::string posted(const std::string& origin)
{
  return "POST /mark HTTP/1.1\r\nHost: 127.0.0.1:8080\r\n" + origin + "Content-Length: 2\r\n\r\n";
}
}  // namespace

TEST(HttpRequest, hasAPathAndAQuery)
{
  const HttpRequest request = parseHead("GET /points?from=12&x HTTP/1.1\r\nHost: a\r\n\r\n");
  EXPECT_EQ(request.path, "/points");
  EXPECT_EQ(request.number("from"), 12U);
  EXPECT_EQ(request.number("to"), 0U);
}

TEST(HttpRequest, hostIsAnAddressOrLocalhost)
{
  for (const char* host : {"127.0.0.1:8080", "localhost:8080", "[::1]:8080", "192.168.1.7:8080"})
    EXPECT_EQ(refusalOf(asked(host)), kHttpOk) << host;
  for (const char* host : {"evil.example:8080", "127.0.0.1:8081", "", "localhost", "127.0.0.1.evil.example:8080"})
    EXPECT_EQ(refusalOf(asked(host)), kHttpForbidden) << host;
}

TEST(HttpRequest, onlyThePageItselfMayPost)
{
  EXPECT_EQ(refusalOf(posted("Origin: http://127.0.0.1:8080\r\n")), kHttpOk);
  EXPECT_EQ(refusalOf(posted("Origin: http://evil.example\r\n")), kHttpForbidden);
  EXPECT_EQ(refusalOf(posted("")), kHttpForbidden);
}

TEST(HttpRequest, isBoundedInEachPart)
{
  std::string many;
  for (std::size_t i = 0; i <= HttpRequest::kMostHeaders; ++i) many += "X" + std::to_string(i) + ": 1\r\n";
  EXPECT_EQ(refusalOf(asked("localhost:8080", many)), kHttpHeadTooLarge);
  EXPECT_EQ(refusalOf(asked("localhost:8080", "X: " + std::string(9000, 'x') + "\r\n")), kHttpHeadTooLarge);
  EXPECT_EQ(refusalOf(asked("localhost:8080", "Content-Length: 1025\r\n")), kHttpTooLarge);
  EXPECT_EQ(refusalOf(asked("localhost:8080", "Content-Length: 99999999999999999999\r\n")), kHttpBadRequest);
  EXPECT_EQ(refusalOf(asked("localhost:8080", "Transfer-Encoding: chunked\r\n")), kHttpBadRequest);
}

TEST(HttpRequest, isRefusedIfItIsAmbiguous)
{
  EXPECT_EQ(refusalOf(asked("localhost:8080", "Host: evil.example\r\n")), kHttpBadRequest);
  EXPECT_EQ(refusalOf("DELETE / HTTP/1.1\r\nHost: localhost:8080\r\n\r\n"), kHttpNotAllowed);
  EXPECT_EQ(refusalOf("GET / HTTP/9\r\n\r\n"), kHttpBadRequest);
  EXPECT_EQ(refusalOf("GET http://evil.example/ HTTP/1.1\r\n\r\n"), kHttpBadRequest);
  EXPECT_EQ(refusalOf(std::string("GET /\0 HTTP/1.1\r\n\r\n", 20)), kHttpBadRequest);
  EXPECT_EQ(refusalOf(""), kHttpBadRequest);
}
}  // namespace scanloom::http_request_unittest
