#include "lab/simulation/internal/SensorPage.h"

#include "lab/simulation/internal/LocalHttpServer.h"
#include "lab/simulation/internal/OusterEndpoints.h"

#include <httplib.h>

#include <mutex>
#include <optional>

namespace scanloom
{
struct SensorPage::State
{
  std::mutex mutex;
  OusterEndpoints endpoints;
  std::optional<LocalHttpServer> server;  // last: its threads use the others

  explicit State(const std::string& metadata) : endpoints(metadata) {}

  void answer(const httplib::Request& request, httplib::Response& response)
  {
    const std::lock_guard lock(mutex);
    const std::optional<std::string> content =
        request.method == "GET"
            ? endpoints.get(request.path)
            : endpoints.post(request.path, request.body, request.get_param_value("reinit") == "true");
    response.status = content ? 200 : 404;
    response.set_content(content.value_or("{}"), "application/json");
  }
};

SensorPage::SensorPage(const std::string& metadata, const std::string& host) : state_(std::make_unique<State>(metadata))
{
  state_->server.emplace(
      host, 0, [state = state_.get()](const auto& request, auto& response) { state->answer(request, response); });
}

SensorPage::~SensorPage() = default;

std::string SensorPage::address() const { return state_->server->address(); }

void SensorPage::restart(std::uint32_t init_id)
{
  const std::lock_guard lock(state_->mutex);
  state_->endpoints.restart(init_id);
}
}  // namespace scanloom
