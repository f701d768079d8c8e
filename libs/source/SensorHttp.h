/** One sensor's web interface: short answers, asked for in bounded time and memory. */
#pragma once
#include "core/Time.h"
#include "source/SensorAddress.h"

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

namespace scanloom
{
enum class SensorFault
{
  Unreachable,    // nobody listens at the address
  TimedOut,       // not answered, or not to the end, within the time limit; or given up by cancel()
  Interrupted,    // the connection ended before the answer did
  Refused,        // an HTTP status other than 200
  TooLarge,       // more than the size limit
  Malformed,      // answered, but not what the endpoint promises
  WrongFirmware,  // a version without these endpoints
  NotRunning,     // it starts, stands by or has an error
};

/** The one exception of these functions: address, endpoint, what happened and how to mend it. */
class SensorHttpError : public std::runtime_error
{
 public:
  SensorHttpError(SensorFault fault_kind, const std::string& message) : std::runtime_error(message), fault(fault_kind)
  {
  }

  SensorFault fault;
};

struct SensorHttpLimits
{
  Duration time = 2s;               // for the whole conversation, connecting included
  std::size_t bytes = 1024 * 1024;  // of one answer; metadata of 128 beams have 20 kB
};

/** A conversation with one sensor; its time limit runs from the construction. Redirects are not followed. */
class SensorHttp
{
 public:
  SensorHttp(const SensorAddress&, const SensorHttpLimits&);
  ~SensorHttp();

  SensorHttp(const SensorHttp&) = delete;
  SensorHttp& operator=(const SensorHttp&) = delete;

  /** The answer's body. Throws SensorHttpError. */
  std::string get(const std::string& endpoint);

  /** Nothing where the sensor has no such endpoint (404 or 405). Throws SensorHttpError. */
  std::optional<std::string> find(const std::string& endpoint);

  /** Sends JSON; true if the sensor took it, false if it has no such endpoint. Throws SensorHttpError. */
  bool post(const std::string& endpoint, const std::string& json);

  /** For another thread: lets the request under way, and all later ones, fail with TimedOut at once. */
  void cancel();

  /** The error that a request about `endpoint` throws: "sensor 10.5.6.101: GET /api/...: `problem`". */
  SensorHttpError error(SensorFault, const std::string& endpoint, const std::string& problem) const;

  const SensorAddress& address() const { return address_; }

 private:
  class Connection;
  std::optional<std::string> request(const char* method, const std::string& endpoint, const std::string& body);
  SensorHttpError failure(const std::string& request, SensorFault, const std::string& problem) const;

  SensorAddress address_;
  SensorHttpLimits limits_;
  std::unique_ptr<Connection> connection_;
};
}  // namespace scanloom
