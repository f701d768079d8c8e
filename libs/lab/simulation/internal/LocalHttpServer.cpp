#include "lab/simulation/internal/LocalHttpServer.h"

#include "input/packets/SensorAddress.h"

#include <fmt/format.h>
#include <httplib.h>

#include <chrono>
#include <stdexcept>

namespace scanloom
{
LocalHttpServer::LocalHttpServer(const std::string& host, int port, const Answer& answer)
  : host_(host), server_(std::make_unique<httplib::Server>())
{
  server_->set_tcp_nodelay(true);
  // The library's default is SO_REUSEPORT, with which two servers could share a port without an error.
  server_->set_socket_options(
      [](socket_t socket)
      {
        const int yes = 1;
        setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
      });
  server_->Get(".*", answer);
  server_->Post(".*", answer);
  port_ = port ? port : server_->bind_to_any_port(host);
  if (port_ < 0 || (port && !server_->bind_to_port(host, port)))
    throw std::runtime_error(fmt::format("{}:{} is taken: no simulated sensor can listen there", host, port_));
  thread_ = std::thread([this] { server_->listen_after_bind(); });
  while (!server_->is_running()) std::this_thread::sleep_for(std::chrono::milliseconds{1});
}

LocalHttpServer::~LocalHttpServer()
{
  server_->stop();
  thread_.join();
}

std::string LocalHttpServer::address() const
{
  return SensorAddress{IpAddress::parse(host_), static_cast<std::uint16_t>(port_)}.text();
}
}  // namespace scanloom
