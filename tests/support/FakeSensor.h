/** An Ouster sensor that is only a web page with faults and a sender of datagrams, on this computer. */
#pragma once
#include "support/DatagramStream.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace scanloom
{
/** What its web interface does wrong; packets are sent all the same. */
enum class FakeFault
{
  None,
  Silence,        // takes the connection, never answers
  Delay,          // answers 5 s late
  Trickle,        // answers one byte every 100 ms
  Disconnect,     // ends the connection in the middle of the answer
  NotFound,       // 404 to everything
  ServerError,    // 500 to everything
  MalformedJson,  // text that is no JSON
  PartialJson,    // the first half of the answer as if it were all
  ForeignJson,    // valid JSON that is no sensor's
  HugeAnswer,     // 64 MiB
  OldFirmware,    // says that it runs firmware 1.14
};

struct FakeSensorOptions
{
  std::string host = "127.0.0.1";            // any of 127.0.0.0/8 is this computer
  int port = 0;                              // of its web interface; 0: any free one
  bool old_endpoints = false;                // as firmware 2.1: metadata in sections, configuration by commands
  std::chrono::nanoseconds initialising{0};  // how long its status is INITIALIZING after a restart
};

class FakeSensor
{
 public:
  /** `metadata` in either layout. Throws std::invalid_argument if it is no JSON object, std::runtime_error if the port
   * is taken. */
  explicit FakeSensor(const std::string& metadata, const FakeSensorOptions& = {});
  ~FakeSensor();

  FakeSensor(const FakeSensor&) = delete;
  FakeSensor& operator=(const FakeSensor&) = delete;

  /** "127.0.0.2:41233", as the key 'address' takes it. */
  std::string address() const;

  /** From the next request on; requests that hang are let go. */
  void set(FakeFault);

  /** "INITIALIZING", "STANDBY", ...; until the next restart. */
  void setStatus(const std::string&);

  /** It starts again with a new init id, and with other metadata where they are given. */
  void restart(std::uint32_t init_id);
  void restart(std::uint32_t init_id, const std::string& metadata);

  /** The metadata as it tells them, in the nested layout. */
  std::string metadata() const;

  /** Every request so far: "GET /api/v1/sensor/metadata". */
  std::vector<std::string> requests() const;

  /** Sends the datagrams in real time from this sensor's own address, instead of those of an earlier call. */
  void stream(std::vector<Datagram>, const StreamOptions&);

  /** Waits until all datagrams have been sent. */
  void waitForStream();

 private:
  class WebPage;
  std::string host_;
  std::unique_ptr<WebPage> page_;
  std::unique_ptr<DatagramStream> stream_;
};
}  // namespace scanloom
