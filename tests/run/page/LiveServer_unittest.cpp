/** A page as browsers, and others, ask for it: plain sockets of the loopback interface. */
#include "run/page/LiveServer.h"

#include "input/packets/SocketAddress.h"
#include "run/page/Asked.h"
#include "run/page/internal/LiveFeed.h"

#include <gmock/gmock.h>

#include <fmt/format.h>
#include <thread>

namespace scanloom::live_server_unittest
{
namespace
{
using testing::HasSubstr;
using testing::StartsWith;
using Clock = std::chrono::steady_clock;

#define SCANLOOM_NEEDS_THREE \
  if (!pageIsThere()) GTEST_SKIP() << "three.js is not installed (libjs-three)"

struct Served
{
  LiveExchange exchange;
  LiveFeed feed{exchange, {"slam", true, true}};
  LiveServer server{kAnyPort, exchange};

  std::string host() const { return server.url().substr(7); }
  std::string get(const std::string& path, const std::string& headers = "") const
  {
    return fmt::format("GET {} HTTP/1.1\r\nHost: {}\r\n{}\r\n", path, host(), headers);
  }
  std::string post(const std::string& path, const std::string& body, const std::string& origin) const
  {
    return fmt::format("POST {} HTTP/1.1\r\nHost: {}\r\nOrigin: {}\r\nContent-Length: {}\r\n\r\n{}", path, host(),
                       origin, body.size(), body);
  }
};

/** Whether somebody listens there. */
bool isReached(const std::string& address)
{
  const SensorAddress asked = SensorAddress::parse(address);
  const SocketAddress where = SocketAddress::of(asked.ip, asked.port);
  const FileDescriptor socket(::socket(AF_INET, SOCK_STREAM, 0));
  return ::connect(socket.number(), where.get(), where.length) == 0;
}

std::string answerTo(const Served& served, const std::string& request) { return wholeAnswer(served.host(), request); }
}  // namespace

TEST(LiveServer, servesThePageAndItsFilesOnly)
{
  SCANLOOM_NEEDS_THREE;
  const Served served;
  for (const char* path : {"/", "/page.css", "/page.js", "/three.min.js", "/OrbitControls.js"})
    EXPECT_THAT(answerTo(served, served.get(path)), StartsWith("HTTP/1.1 200")) << path;
  for (const char* path : {"/../../../../etc/passwd", "/%2e%2e/etc/passwd", "/CMakeLists.txt", "/page.css/"})
    EXPECT_THAT(answerTo(served, served.get(path)), StartsWith("HTTP/1.1 404")) << path;
}

TEST(LiveServer, listensAtItsAddressOnly)
{
  SCANLOOM_NEEDS_THREE;
  const Served served;
  const std::string port = served.host().substr(served.host().find(':'));
  EXPECT_TRUE(isReached("127.0.0.1" + port));
  EXPECT_FALSE(isReached("127.0.0.2" + port)) << "another address of this computer";
}

TEST(LiveServer, answersNoHostThatIsAName)
{
  SCANLOOM_NEEDS_THREE;
  const Served served;
  for (const char* path : {"/", "/status", "/points"})
    EXPECT_THAT(answerTo(served, fmt::format("GET {} HTTP/1.1\r\nHost: evil.example\r\n\r\n", path)),
                StartsWith("HTTP/1.1 403"))
        << path;
}

TEST(LiveServer, letsNoOtherPageShowItOrLoadFromElsewhere)
{
  SCANLOOM_NEEDS_THREE;
  const Served served;
  const std::string answer = answerTo(served, served.get("/"));
  for (const char* said : {"default-src 'self'", "frame-ancestors 'none'", "X-Content-Type-Options: nosniff"})
    EXPECT_THAT(answer, HasSubstr(said));
  EXPECT_THAT(answer, testing::Not(HasSubstr("Access-Control-Allow")));
}

TEST(LiveServer, onlyItsOwnPageMarksEvents)
{
  SCANLOOM_NEEDS_THREE;
  Served served;
  EXPECT_THAT(answerTo(served, served.post("/mark", "here", "http://evil.example")), StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(answerTo(served, served.get("/mark")), StartsWith("HTTP/1.1 405"));
  EXPECT_THAT(answerTo(served, served.post("/", "x", "http://" + served.host())), StartsWith("HTTP/1.1 405"));
  EXPECT_THAT(answerTo(served, served.post("/player", "play", "http://" + served.host())), StartsWith("HTTP/1.1 404"));
  EXPECT_TRUE(served.exchange.marks.empty());
  EXPECT_THAT(answerTo(served, served.post("/mark", "here\n", "http://" + served.host())), StartsWith("HTTP/1.1 200"));
  ASSERT_EQ(served.exchange.marks.size(), 1U);
  EXPECT_EQ(served.exchange.marks[0], "here?");
}

TEST(LiveServer, statusComesAsEvents)
{
  SCANLOOM_NEEDS_THREE;
  Served served;
  served.feed.warn("the disk is nearly full");
  served.feed.warn("the disk is nearly full");
  std::this_thread::sleep_for(60ms);
  served.feed.offer();
  const std::string events = Browser(served.host(), served.get("/status")).read(20s, "nearly full");
  EXPECT_THAT(events, HasSubstr("text/event-stream"));
  EXPECT_THAT(events, HasSubstr("\"count\":2"));
  EXPECT_THAT(events, HasSubstr("\"word\":\"WAITING\""));
}

TEST(LiveServer, aNinthPageIsToldSo)
{
  SCANLOOM_NEEDS_THREE;
  const Served served;
  std::vector<std::unique_ptr<Browser>> pages;
  for (int i = 0; i < 8; ++i)
  {
    pages.push_back(std::make_unique<Browser>(served.host(), served.get("/points")));
    EXPECT_THAT(pages.back()->read(20s, "\r\n\r\n"), StartsWith("HTTP/1.1 200"));
  }
  EXPECT_THAT(answerTo(served, served.get("/points")), HasSubstr("8 pages are open already"));
  pages.clear();
  std::string answer;
  for (int i = 0; i < 400 && answer.rfind("HTTP/1.1 200", 0) != 0; ++i, std::this_thread::sleep_for(50ms))
    answer = Browser(served.host(), served.get("/points")).read(20s, "\r\n\r\n");
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 200"));
}

TEST(HttpServer, refusesFurtherConnections)
{
  std::atomic<std::size_t> answered{0};
  const HttpServer server(kAnyPort,
                          [&](const HttpRequest&, HttpReply& reply)
                          {
                            ++answered;
                            while (reply.pause(20ms)) continue;
                          });
  const std::string address = server.address().text();
  const std::string request = "GET / HTTP/1.1\r\nHost: " + address + "\r\n\r\n";
  std::vector<std::unique_ptr<Browser>> browsers;
  for (std::size_t i = 0; i < HttpServer::kMostConnections; ++i)
    browsers.push_back(std::make_unique<Browser>(address, request));
  for (int i = 0; i < 6000 && answered < HttpServer::kMostConnections; ++i) std::this_thread::sleep_for(10ms);
  ASSERT_EQ(answered, HttpServer::kMostConnections);
  EXPECT_THAT(Browser(address, request).read(20s), StartsWith("HTTP/1.1 503"));
}

TEST(LiveServer, whoDoesNotReadIsLeft)
{
  int ends[2];
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
  const FileDescriptor own(ends[0]), not_reading(ends[1]);
  const std::atomic<bool> stopping{false};
  HttpReply reply(own.number(), stopping);
  const Clock::time_point begin = Clock::now();
  EXPECT_FALSE(reply.write(std::string(10'000'000, 'x')));
  EXPECT_GE(Clock::now() - begin, HttpReply::kLongest);
  EXPECT_LT(Clock::now() - begin, HttpReply::kLongest + 20s);
}

TEST(LiveServer, marksAreBoundedInSizeAndNumber)
{
  SCANLOOM_NEEDS_THREE;
  Served served;
  const auto mark = [&](const std::string& text)
  { return answerTo(served, served.post("/mark", text, "http://" + served.host())).substr(0, 12); };
  EXPECT_EQ(mark(std::string(LiveServer::kMostMarkBytes + 1, 'x')), "HTTP/1.1 400");
  EXPECT_EQ(mark(std::string(HttpRequest::kMostBodyBytes + 1, 'x')), "HTTP/1.1 413");
  served.exchange.marks.assign(100, "not taken yet");
  EXPECT_EQ(mark("one more"), "HTTP/1.1 503");
  EXPECT_EQ(served.exchange.marks.size(), 100U);
}

TEST(LiveServer, whoAsksTooSlowlyIsLeft)
{
  SCANLOOM_NEEDS_THREE;
  const Served served;
  const Browser browser(served.host(), "GET / HTTP/1.1\r\nHost: ");
  const Clock::time_point begin = Clock::now();
  EXPECT_EQ(browser.read(40s), "");
  EXPECT_LT(Clock::now() - begin, 39s);  // 5 s where the page's thread runs at once
}

TEST(LiveServer, endsAtOnceWithPagesOpen)
{
  SCANLOOM_NEEDS_THREE;
  auto served = std::make_unique<Served>();
  const Browser points(served->host(), served->get("/points")), status(served->host(), served->get("/status")),
      half(served->host(), "GET");
  points.read(20s, "\r\n\r\n");
  const Clock::time_point begin = Clock::now();
  served.reset();
  EXPECT_LT(Clock::now() - begin, 4s);  // less than a request may take
}

TEST(LiveServer, aPageThatDoesNotReadCostsTheFeedNothing)
{
  SCANLOOM_NEEDS_THREE;
  Served served;
  const Browser stalled(served.host(), served.get("/points"));
  StateEstimate estimate;
  estimate.keyframe.emplace();
  estimate.keyframe->points.resize(60000);
  Clock::duration longest{0};
  for (int i = 0; i < 200; ++i)
  {
    estimate.stamp += 100ms;
    estimate.map_T_body.translation.x() = i;
    served.feed.add(estimate);
    const Clock::time_point begin = Clock::now();
    served.feed.offer();
    longest = std::max(longest, Clock::now() - begin);
    std::this_thread::sleep_for(5ms);
  }
  EXPECT_LT(longest, 2s);  // usually some microseconds; a page may stall for 10 s
}
}  // namespace scanloom::live_server_unittest
