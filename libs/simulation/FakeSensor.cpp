#include "simulation/FakeSensor.h"

#include <fmt/format.h>
#include <httplib.h>

#include <condition_variable>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>

#include "simulation/OusterEndpoints.h"
#include "simulation/SensorSections.h"
#include "source/SensorAddress.h"

namespace scanloom
{
namespace
{
using nlohmann::json;

constexpr auto kDelay = 5s;
constexpr auto kTrickle = 100ms;
constexpr std::size_t kHuge = 64 * 1024 * 1024, kPiece = 64 * 1024;
constexpr int kOk = 200, kNotFound = 404, kServerError = 500;
const char* const kJson = "application/json";
}  // namespace

class FakeSensor::WebPage
{
 public:
  WebPage(const std::string& metadata, const FakeSensorOptions& options)
    : host_(options.host), endpoints_(sensorSections(metadata), options.old_endpoints, options.initialising)
  {
    server_.set_tcp_nodelay(true);
    // The library's own choice, SO_REUSEPORT, would let two sensors share a port in silence.
    server_.set_socket_options(
        [](socket_t socket)
        {
          const int yes = 1;
          setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
        });
    server_.Get(".*", [this](const auto& request, auto& response) { answer(request, response); });
    server_.Post(".*", [this](const auto& request, auto& response) { answer(request, response); });
    port_ = options.port ? options.port : server_.bind_to_any_port(options.host);
    if (port_ < 0 || (options.port && !server_.bind_to_port(options.host, options.port)))
      throw std::runtime_error(fmt::format("{}:{} is taken: a fake sensor can't listen there", options.host, port_));
    thread_ = std::thread([this] { server_.listen_after_bind(); });
    while (!server_.is_running()) std::this_thread::sleep_for(1ms);
  }

  ~WebPage()
  {
    set(FakeFault::None);
    server_.stop();
    thread_.join();
  }

  WebPage(const WebPage&) = delete;
  WebPage& operator=(const WebPage&) = delete;

  void set(FakeFault fault)
  {
    const std::lock_guard lock(mutex_);
    fault_ = {fault, fault_.changes + 1};
    changed_.notify_all();
  }

  /** Calls `change` with the endpoints, between two answers. */
  template <typename Change>
  void alter(Change&& change)
  {
    const std::lock_guard lock(mutex_);
    change(endpoints_);
  }

  std::string metadata() const
  {
    const std::lock_guard lock(mutex_);
    return endpoints_.sections().dump(2);
  }

  std::vector<std::string> requests() const
  {
    const std::lock_guard lock(mutex_);
    return requests_;
  }

  std::string address() const
  {
    return SensorAddress{IpAddress::parse(host_), static_cast<std::uint16_t>(port_)}.text();
  }

 private:
  /** The fault that a request meets. A fault that takes its time is over as soon as another one is set. */
  struct Fault
  {
    FakeFault kind = FakeFault::None;
    std::uint64_t changes = 0;
  };

  /** False if something else was set meanwhile. */
  bool wait(const Fault& fault, std::chrono::nanoseconds time)
  {
    std::unique_lock lock(mutex_);
    return !changed_.wait_for(lock, time, [&] { return fault_.changes != fault.changes; });
  }

  void answer(const httplib::Request& request, httplib::Response& response)
  {
    Fault fault;
    std::optional<json> content;
    {
      const std::lock_guard lock(mutex_);
      requests_.push_back(request.method + " " + request.target);
      fault = fault_;
      content = contentFor(request);
    }
    response.status = content ? kOk : kNotFound;
    send(fault, content ? content->dump() : R"({"error": {"code": "not found"}})", response);
  }

  std::optional<json> contentFor(const httplib::Request& request)
  {
    if (fault_.kind == FakeFault::OldFirmware && request.path == "/api/v1/system/firmware")
      return json{{"fw", "ousteros-image-prod-aries-v1.14.0"}};
    if (request.method == "GET") return endpoints_.get(request.path, request.get_param_value("args"));
    if (request.path != "/api/v1/sensor/config") return std::nullopt;
    return endpoints_.postConfig(request.body, request.get_param_value("reinit") == "true");
  }

  void send(const Fault& fault, const std::string& text, httplib::Response& response)
  {
    const FakeFault kind = fault.kind;
    if (kind == FakeFault::Silence) wait(fault, 1h);
    if (kind == FakeFault::Delay) wait(fault, kDelay);
    if (kind == FakeFault::NotFound) response.status = kNotFound;
    if (kind == FakeFault::ServerError) response.status = kServerError;
    if (kind == FakeFault::MalformedJson) return response.set_content("<html>It works!</html>", "text/html");
    if (kind == FakeFault::PartialJson) return response.set_content(text.substr(0, text.size() / 2), kJson);
    if (kind == FakeFault::ForeignJson) return response.set_content(R"({"hello": "world"})", kJson);
    if (kind == FakeFault::HugeAnswer) return sendMuch(response);
    if (kind == FakeFault::Disconnect) return sendHalf(text, response);
    if (kind == FakeFault::Trickle) return sendSlowly(fault, text, response);
    response.set_content(text, kJson);
  }

  void sendHalf(const std::string& text, httplib::Response& response)
  {
    response.set_content_provider(text.size(), kJson,
                                  [text](std::size_t offset, std::size_t, httplib::DataSink& sink)
                                  {
                                    if (offset > 0) return false;
                                    return sink.write(text.data(), text.size() / 2);
                                  });
  }

  void sendMuch(httplib::Response& response)
  {
    response.set_content_provider(kHuge, kJson,
                                  [piece = std::string(kPiece, ' ')](std::size_t, std::size_t, httplib::DataSink& sink)
                                  { return sink.write(piece.data(), piece.size()); });
  }

  void sendSlowly(const Fault& fault, const std::string& text, httplib::Response& response)
  {
    response.set_content_provider(text.size(), kJson,
                                  [this, fault, text](std::size_t offset, std::size_t, httplib::DataSink& sink)
                                  { return wait(fault, kTrickle) && sink.write(text.data() + offset, 1); });
  }

  std::string host_;
  int port_ = 0;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Fault fault_;
  OusterEndpoints endpoints_;
  std::vector<std::string> requests_;
  httplib::Server server_;
  std::thread thread_;
};

FakeSensor::FakeSensor(const std::string& metadata, const FakeSensorOptions& options)
  : host_(options.host), page_(std::make_unique<WebPage>(metadata, options))
{
}

FakeSensor::~FakeSensor() = default;

std::string FakeSensor::address() const { return page_->address(); }
void FakeSensor::set(FakeFault fault) { page_->set(fault); }

void FakeSensor::setStatus(const std::string& status)
{
  page_->alter([&](OusterEndpoints& endpoints) { endpoints.setStatus(status); });
}

void FakeSensor::restart(std::uint32_t init_id)
{
  page_->alter([&](OusterEndpoints& endpoints) { endpoints.restart(init_id); });
}

void FakeSensor::restart(std::uint32_t init_id, const std::string& metadata)
{
  page_->alter(
      [&, sections = sensorSections(metadata)](OusterEndpoints& endpoints)
      {
        endpoints.replace(sections);
        endpoints.restart(init_id);
      });
}

std::string FakeSensor::metadata() const { return page_->metadata(); }
std::vector<std::string> FakeSensor::requests() const { return page_->requests(); }

void FakeSensor::stream(std::vector<Datagram> datagrams, const StreamOptions& options)
{
  stream_.reset();
  stream_ = std::make_unique<DatagramStream>(std::move(datagrams), IpAddress::parse(host_), options);
}

void FakeSensor::waitForStream()
{
  if (stream_) stream_->wait();
}
}  // namespace scanloom
