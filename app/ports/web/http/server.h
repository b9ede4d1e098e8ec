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

/// What happened to clients since start.
struct ServerCounts {
  std::atomic<std::uint64_t> requests{0};     ///< that arrived whole
  std::atomic<std::uint64_t> refused{0};      ///< because of their form, size or host name
  std::atomic<std::uint64_t> overdue{0};      ///< connections ended because they were too slow
  std::atomic<std::uint64_t> turned_away{0};  ///< connections of addresses that had enough
  std::atomic<std::uint64_t> connections{0};  ///< open now
  std::atomic<std::uint64_t> streams{0};      ///< open now
  std::atomic<std::uint64_t> full{0};         ///< streams refused because of max_streams
};

/// Where and how a server listens.
struct Endpoint {
  std::string address;         ///< numeric
  int port = 0;                ///< 0: any free port
  std::optional<PemPair> pem;  ///< of HTTPS; none: HTTP
  Values headers;              ///< of every answer, besides others
};

/// HTTP/1.1, plain or within TLS 1.2 or 1.3, by libmicrohttpd on two threads of its own, which wait
/// for sockets only. Thread rule: one owner; end_overdue on any thread.
class Server {
 public:
  /// Called on a thread of the server with each request that is whole. Must not wait; it answers
  /// at once or keeps the exchange and answers later.
  using Handler = std::function<void(const ExchangePtr&)>;

  /// Listens. `settings` and `counts` outlive it. Errors: address and reason; a trusted proxy is
  /// neither an address nor a network.
  static Result<std::unique_ptr<Server>> open(const WebSettings& settings, Endpoint endpoint,
                                              Handler handler, ServerCounts& counts);
  /// Ends all connections, as Connections::end_all() does.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  int port() const { return port_; }

  /// Ends connections that are overdue or whose client has gone; called about once a second.
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
