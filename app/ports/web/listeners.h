// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "app/ports/web/http/server.h"
#include "app/ports/web/tls/server_certificate.h"
#include "app/ports/web/web_settings.h"
#include "hal/clock.h"
#include "proc/image/result.h"

namespace orbwatch::app::web {

/// Servers of HTTP and HTTPS. HTTP serves only this computer and trusted proxies; other clients are
/// redirected to HTTPS if it is enabled. Thread-safe; handlers called by a server may call only
/// ports and certificate_days.
class Listeners {
 public:
  /// `settings` and `counts` outlive the listeners.
  Listeners(const WebSettings& settings, std::filesystem::path state_folder,
            Server::Handler handler, ServerCounts& counts);

  /// Opens servers that are not open yet; HTTP does not wait for a certificate. Errors: those of
  /// Server::open(), named_certificate() and self_made_certificate().
  Result<> open();
  /// Ends all connections.
  void close();

  /// Ends connections that are overdue; to be called several times a second. Does not wait: while
  /// a server starts or stops, the next call ends them.
  void watch();
  /// Replaces a self-made certificate before it expires, which closes HTTPS connections; to be
  /// called at least every few seconds. Waits for the disk and for a key to be made, during which
  /// the servers go on and watch() has its turn.
  void renew_certificate();

  int port() const { return port_; }
  int https_port() const { return https_port_; }  ///< 0: not open
  /// Days until the certificate expires, negative afterwards; NaN: no certificate.
  double certificate_days() const;

 private:
  Result<ServerCertificate> certificate() const;
  Result<> open_http();
  Result<> open_https(ServerCertificate certificate);
  bool is_certificate_due();
  void serve_http(const ExchangePtr& exchange) const;

  const WebSettings& settings_;
  const std::filesystem::path state_folder_;
  const Server::Handler handler_;
  ServerCounts& counts_;
  std::atomic<int> port_{0}, https_port_{0};
  std::atomic<std::int64_t> certificate_ends_{0};  ///< s since 1970; 0: none

  /// Held while a certificate is read or made, so that there is one at a time, that of the file.
  /// Locked before mutex_; close() and watch() do without it.
  std::mutex making_mutex_;
  hal::TimePoint next_renewal_;  ///< earliest time of the next attempt; under making_mutex_

  /// Guards the following members, also while a server starts or stops; during a renewal not while
  /// the certificate is made.
  std::mutex mutex_;
  std::vector<std::unique_ptr<Server>> http_;
  std::unique_ptr<Server> https_;
  std::optional<ServerCertificate> certificate_;  ///< certificate of https_, present or last
};

}  // namespace orbwatch::app::web
