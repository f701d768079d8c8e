#include "run/page/internal/HttpServer.h"

#include "input/packets/SocketAddress.h"
#include "run/page/internal/yieldToAll.h"

#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>

#include <cerrno>
#include <cstring>
#include <optional>
#include <system_error>
#include <utility>

namespace scanloom
{
namespace
{
using Clock = std::chrono::steady_clock;

// What the kernel keeps of an answer for a reader that does not read.
constexpr int kSendBuffer = 128 * 1024;

FileDescriptor listenAt(const SensorAddress& address)
{
  const SocketAddress where = SocketAddress::of(address.ip, address.port);
  FileDescriptor listener(::socket(where.storage.ss_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  const int yes = 1;
  ::setsockopt(listener.number(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  ::setsockopt(listener.number(), SOL_SOCKET, SO_SNDBUF, &kSendBuffer, sizeof kSendBuffer);
  ::setsockopt(listener.number(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
  constexpr int kWaiting = 16;
  if (!listener.isOpen() || ::bind(listener.number(), where.get(), where.length) != 0 ||
      ::listen(listener.number(), kWaiting) != 0)
    throw std::runtime_error(fmt::format("{}: cannot listen there ({}): choose another --web ADDRESS:PORT",
                                         address.text(), std::strerror(errno)));
  return listener;
}

std::uint16_t portOf(const FileDescriptor& listener)
{
  SocketAddress where;
  where.length = sizeof where.storage;
  ::getsockname(listener.number(), reinterpret_cast<sockaddr*>(&where.storage), &where.length);
  return where.port();
}

/** Reads on until there are `bytes`, or, for 0, an empty line. False if that did not come in time. */
bool receive(int socket, std::size_t bytes, Clock::time_point deadline, const std::atomic<bool>& stopping,
             std::string& text)
{
  const auto enough = [&] { return bytes > 0 ? text.size() >= bytes : text.find("\r\n\r\n") != std::string::npos; };
  while (!enough())
  {
    if (stopping || Clock::now() > deadline) return false;
    if (text.size() > HttpRequest::kMostHeadBytes + HttpRequest::kMostBodyBytes)
      throw BadRequest(kHttpHeadTooLarge, "the head is too large");
    char part[2048];
    const ssize_t received = ::recv(socket, part, sizeof part, MSG_DONTWAIT);
    if (received == 0) return false;
    if (received > 0)
      text.append(part, static_cast<std::size_t>(received));
    else if (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR)
      return false;
    else
    {
      pollfd readable{socket, POLLIN, 0};
      ::poll(&readable, 1, 50);
    }
  }
  return true;
}

std::optional<HttpRequest> receiveRequest(int socket, const std::atomic<bool>& stopping)
{
  const Clock::time_point deadline = Clock::now() + HttpServer::kLongestAsk;
  std::string text;
  if (!receive(socket, 0, deadline, stopping, text)) return std::nullopt;
  const std::size_t head = text.find("\r\n\r\n") + 4;
  HttpRequest request = parseHead(std::string_view(text).substr(0, head));
  const std::size_t body = request.bodyBytes();
  if (!receive(socket, head + body, deadline, stopping, text)) return std::nullopt;
  request.body = text.substr(head, body);
  return request;
}
}  // namespace

HttpServer::HttpServer(const SensorAddress& address, Answer answer)
  : address_(address), answer_(std::move(answer)), listener_(listenAt(address))
{
  address_.port = portOf(listener_);
  thread_ = std::thread([this] { accept(); });
}

std::string HttpServer::url() const
{
  return fmt::format(address_.ip.isV4() ? "http://{}:{}" : "http://[{}]:{}", address_.ip.text(), address_.port);
}

HttpServer::~HttpServer()
{
  stopping_ = true;
  thread_.join();
  for (const auto& connection : connections_) connection->thread.join();
}

void HttpServer::accept()
{
  yieldToAll();
  while (!stopping_)
  {
    pollfd asked{listener_.number(), POLLIN, 0};
    ::poll(&asked, 1, 50);
    forgetEnded();
    FileDescriptor socket(::accept4(listener_.number(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
    if (!socket.isOpen()) continue;
    if (connections_.size() >= kMostConnections)
    {
      HttpReply(socket.number(), stopping_).send(kHttpBusy, "text/plain", "too many connections");
      continue;
    }
    auto connection = std::make_unique<Connection>();
    connection->socket = std::move(socket);
    try
    {
      connection->thread = std::thread(
          [this, c = connection.get()]
          {
            yieldToAll();
            serve(c->socket.number());
            c->done = true;
          });
    }
    catch (const std::system_error&)  // no thread to be had: the run goes on, the browser asks again
    {
      continue;
    }
    connections_.push_back(std::move(connection));
  }
}

void HttpServer::forgetEnded()
{
  for (auto it = connections_.begin(); it != connections_.end();)
  {
    if (!(*it)->done)
    {
      ++it;
      continue;
    }
    (*it)->thread.join();
    it = connections_.erase(it);
  }
}

void HttpServer::serve(int socket)
{
  HttpReply reply(socket, stopping_);
  try
  {
    const std::optional<HttpRequest> request = receiveRequest(socket, stopping_);
    if (!request) return;
    refuseForeign(*request, address_.port);
    answer_(*request, reply);
  }
  catch (const BadRequest& refused)
  {
    reply.send(refused.status, "text/plain", std::string(refused.what()) + "\n");
  }
  catch (const std::exception&)  // out of memory, say: the browser asks again
  {
    reply.send(kHttpFailed, "text/plain", "this failed\n");
  }
  ::shutdown(socket, SHUT_WR);
}
}  // namespace scanloom
