#include "support/FakeSensor.h"

#include "lab/simulation/internal/LocalHttpServer.h"
#include "lab/simulation/internal/OusterEndpoints.h"
#include "support/SensorSections.h"

#include <httplib.h>
#include <nlohmann/json.hpp>

#include <condition_variable>
#include <mutex>
#include <optional>

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
    : old_(options.old_endpoints), initialising_(options.initialising), endpoints_(sensorSections(metadata))
  {
    server_.emplace(options.host, options.port,
                    [this](const auto& request, auto& response) { answer(request, response); });
  }

  ~WebPage() { set(FakeFault::None); }

  WebPage(const WebPage&) = delete;
  WebPage& operator=(const WebPage&) = delete;

  void set(FakeFault fault)
  {
    const std::lock_guard lock(mutex_);
    fault_ = {fault, fault_.changes + 1};
    changed_.notify_all();
  }

  void setStatus(const std::string& status)
  {
    const std::lock_guard lock(mutex_);
    info()["status"] = status;
  }

  void restart(std::uint32_t init_id, const std::optional<json>& sections)
  {
    const std::lock_guard lock(mutex_);
    if (sections) endpoints_.sections() = *sections;
    endpoints_.restart(init_id);
    noteRestart();
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

  std::string address() const { return server_->address(); }

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
    std::optional<std::string> content;
    {
      const std::lock_guard lock(mutex_);
      requests_.push_back(request.method + " " + request.target);
      fault = fault_;
      content = contentFor(request);
    }
    response.status = content ? kOk : kNotFound;
    send(fault, content.value_or(R"({"error": {"code": "not found"}})"), response);
  }

  json& info() { return endpoints_.sections()["sensor_info"]; }

  void noteRestart()
  {
    running_from_.reset();
    if (initialising_.count() > 0) running_from_ = Clock::now() + initialising_;
    info()["status"] = initialising_.count() > 0 ? "INITIALIZING" : "RUNNING";
  }

  std::optional<std::string> contentFor(const httplib::Request& request)
  {
    if (fault_.kind == FakeFault::OldFirmware && request.path == "/api/v1/system/firmware")
      return R"({"fw": "ousteros-image-prod-aries-v1.14.0"})";
    if (running_from_ && Clock::now() >= *running_from_)
    {
      running_from_.reset();
      info()["status"] = "RUNNING";
    }
    const std::string commands = "/api/v1/sensor/cmd/";
    const bool is_new = request.path == "/api/v1/sensor/metadata" || request.path == "/api/v1/sensor/config";
    if (old_ && request.path.rfind(commands, 0) == 0)
      return command(request.path.substr(commands.size()), request.get_param_value("args"));
    if (old_ && (is_new || request.method == "POST")) return std::nullopt;

    if (request.method == "GET") return endpoints_.get(request.path);
    const bool reinitialise = request.get_param_value("reinit") == "true";
    std::optional<std::string> content = endpoints_.post(request.path, request.body, reinitialise);
    if (content && reinitialise) noteRestart();
    return content;
  }

  /** As firmware 2.1 is configured. */
  std::optional<std::string> command(const std::string& name, const std::string& arguments)
  {
    json& config = endpoints_.sections()["config_params"];
    if (name == "get_config_param" && arguments == "active") return config.dump();
    const std::size_t space = arguments.find(' ');
    if (name == "set_config_param" && space != std::string::npos)
    {
      staged_[arguments.substr(0, space)] = arguments.substr(space + 1);
      return json(name).dump();
    }
    if (name != "reinitialize") return std::nullopt;
    config.update(staged_);
    endpoints_.restart(info().value("initialization_id", 0U) + 1);
    noteRestart();
    return "{}";
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

  using Clock = std::chrono::steady_clock;

  bool old_;
  std::chrono::nanoseconds initialising_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Fault fault_;
  OusterEndpoints endpoints_;
  json staged_ = json::object();
  std::optional<Clock::time_point> running_from_;  // after a restart
  std::vector<std::string> requests_;
  std::optional<LocalHttpServer> server_;  // last: its threads use all of the above
};

FakeSensor::FakeSensor(const std::string& metadata, const FakeSensorOptions& options)
  : host_(options.host), page_(std::make_unique<WebPage>(metadata, options))
{
}

FakeSensor::~FakeSensor() = default;

std::string FakeSensor::address() const { return page_->address(); }
void FakeSensor::set(FakeFault fault) { page_->set(fault); }

void FakeSensor::setStatus(const std::string& status) { page_->setStatus(status); }
void FakeSensor::restart(std::uint32_t init_id) { page_->restart(init_id, std::nullopt); }
void FakeSensor::restart(std::uint32_t init_id, const std::string& metadata)
{
  page_->restart(init_id, sensorSections(metadata));
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
