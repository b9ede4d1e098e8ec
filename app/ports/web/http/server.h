// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/ports/web/http/connections.h"
#include "app/ports/web/http/exchange.h"
#include "app/ports/web/http/pem_pair.h"
#include "app/ports/web/http/request_form.h"
#include "app/ports/web/web_settings.h"
#include "proc/image/result.h"

struct MHD_Daemon;

namespace orbwatch::app::web {

/// Counters of clients since the start.
struct ServerCounts {
  std::atomic<std::uint64_t> requests{0};  ///< complete requests received
  std::atomic<std::uint64_t> refused{0};   ///< requests refused for their form, size or host name
  std::atomic<std::uint64_t> overdue{0};   ///< connections ended because the client was too slow
  std::atomic<std::uint64_t> turned_away{0};  ///< connections of addresses beyond their limit
  std::atomic<std::uint64_t> connections{0};  ///< open now
  std::atomic<std::uint64_t> streams{0};      ///< open now
  std::atomic<std::uint64_t> full{0};         ///< streams refused because of max_streams
};

/// Address, port and TLS of a server.
struct Endpoint {
  std::string address;         ///< numeric
  int port = 0;                ///< 0: any free port
  std::optional<PemPair> pem;  ///< credentials for HTTPS; nullopt: HTTP
  Values headers;              ///< further headers of every answer
};

/// HTTP/1.1, plain or within TLS 1.2 or 1.3, by libmicrohttpd on two threads of its own, which wait
/// only for sockets. Thread rule: one owner; end_overdue on any thread.
class Server {
 public:
  /// Called on a thread of the server with each complete request. Must not wait: it answers at
  /// once, or keeps the exchange and answers later.
  using Handler = std::function<void(const ExchangePtr&)>;

  /// Starts listening. `settings` and `counts` outlive the server. Errors: the address cannot be
  /// used, with the reason; a trusted proxy is neither an address nor a network.
  static Result<std::unique_ptr<Server>> open(const WebSettings& settings, Endpoint endpoint,
                                              Handler handler, ServerCounts& counts);
  /// Ends all connections by Connections::end_all().
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  int port() const { return port_; }

  /// Ends connections that are overdue or whose client has disconnected; to be called about once a
  /// second.
  void end_overdue();

 private:
  struct Callbacks;

  Server(const WebSettings& settings, Endpoint endpoint, Handler handler, ServerCounts& counts);
  Result<> listen();
  std::size_t most_of_an_address() const;

  const WebSettings& settings_;
  Endpoint endpoint_;
  ServerNames own_;
  const Handler handler_;
  ServerCounts& counts_;
  Connections connections_;
  MHD_Daemon* daemon_ = nullptr;
  int port_ = 0;
};

}  // namespace orbwatch::app::web
