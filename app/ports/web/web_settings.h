// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/certificates/dates.h"
#include "app/model/command/command_path.h"
#include "app/model/fleet/appliance_notice.h"
#include "app/model/machine/machine_state.h"
#include "app/model/sink/listening_port.h"
#include "app/model/sink/published.h"
#include "app/model/sink/sink.h"
#include "app/model/status/status_report.h"
#include "app/pictures/jpeg_quality.h"
#include "hal/host.h"
#include "hal/network.h"
#include "hal/thread/shared_threads.h"
#include "proc/settings/settings.h"

namespace orbwatch::app {

class Fleet;
struct PageContext;

/// The [web] part of the site file.
struct WebSettings {
  static constexpr std::string_view kName = "web", kText = "Web page and HTTP interface";

  bool enabled = false;
  /// Numeric IPv4 or IPv6 address to listen on; default: this computer only.
  std::string address = "127.0.0.1";
  int port = 8080;                  ///< HTTP port, for this computer only; 0: any free port
  std::optional<int> https_port{};  ///< 0: any free port; see https_port_of()
  /// Certificate in PEM, followed by those of its issuers; empty: made and kept by the appliance
  /// itself.
  std::filesystem::path certificate{};
  std::filesystem::path key{};
  /// Host names of this appliance. A request under any other name is refused, so that a foreign
  /// page cannot reach it by the page's own name (DNS rebinding). Numeric addresses and localhost
  /// are always accepted.
  std::vector<std::string> names;
  /// Addresses and networks of reverse proxies whose Forwarded or X-Forwarded-* headers, which
  /// state the client, are trusted.
  std::vector<std::string> trusted_proxies;

  int max_connections = 128;
  int max_connections_per_address = 16;
  int max_streams = 32;
  std::size_t max_body_bytes = 65536;
  /// Limit from the connection, or from the previous answer, to the end of a request; and again for
  /// its answer. Longer answers: see web::Connections.
  std::chrono::milliseconds request_timeout{10000};
  JpegSettings jpeg;

  /// Idle time after which a session ends; an open stream or file counts as use.
  std::chrono::seconds session_idle{60 * 60};
  /// Limit of a session's age; afterwards the user must log in again.
  std::chrono::seconds session_longest{12 * 60 * 60};

  /// Silence of the pipeline, which reports ten times a second, after which it counts as unhealthy.
  std::chrono::milliseconds status_timeout{2000};
};

/// Addresses for HTTP; an address in a single network is complemented by loopback for this
/// computer's own programs.
inline std::vector<std::string> http_addresses_of(const WebSettings& web) {
  if (hal::is_unspecified(web.address) || hal::is_loopback(web.address)) return {web.address};
  return {web.address, web.address.find(':') == std::string::npos ? "127.0.0.1" : "::1"};
}

/// Port of HTTPS; nullopt: no HTTPS, and only this computer and clients behind trusted proxies are
/// served.
inline std::optional<int> https_port_of(const WebSettings& web) {
  constexpr int kHttpsPort = 8443;
  const bool is_needed = !hal::is_loopback(web.address) || !web.certificate.empty();
  return web.https_port || !is_needed ? web.https_port : kHttpsPort;
}

/// Checks trusted_proxies; every address is refused, because a trusted proxy can claim any client's
/// address.
template <class Visitor>
void require_proxies(Visitor& v, const std::vector<std::string>& texts) {
  constexpr const char* kKey = "trusted_proxies";
  hal::require_networks(v, kKey, texts);
  for (const std::string& text : texts) {
    const auto network = hal::parse_network(text);
    v.require(!network || !hal::is_everybody(*network), kKey,
              "'" + text + "' is every address; name those of the proxies, as 10.0.0.7");
  }
}

template <class Visitor>
void visit(Visitor& v, WebSettings& web) {
  using Minutes = DurationRange<std::ratio<60>>;
  v.optional("enabled", web.enabled, "Serve the page and the HTTP interface");
  v.optional("address", web.address,
             "Numeric address to listen on; 0.0.0.0 or :: for every network, then over HTTPS only");
  // The network interface of a zone (fe80::1%eth0) may be plugged in later.
  const std::string host = web.address.substr(0, web.address.find('%'));
  v.require(hal::parse_host(host).has_value(), "address",
            "is not a numeric address such as 192.168.1.20, 0.0.0.0 or ::1");
  v.optional("port", web.port, Range::between(0, 65535),
             "HTTP port, served to this computer only; other clients are redirected to HTTPS. 0: "
             "any free port");
  v.optional("https_port", web.https_port, Range::between(0, 65535),
             "HTTPS port; default: 8443 if `address` is not a loopback address or `certificate` is "
             "set, else no HTTPS");
  v.require(web.port == 0 || https_port_of(web) != web.port, "https_port",
            "is also the HTTP port; set another, as https_port = 8443");
  v.optional("certificate", web.certificate,
             "HTTPS certificate in PEM, followed by those of its issuers; default: the appliance "
             "makes its own, whose fingerprint `orbwatch password --show` prints");
  v.optional(
      "key", web.key,
      "The certificate's private key, in PEM without a password; must not be world-readable");
  v.require(web.certificate.empty() == web.key.empty(), "certificate",
            "set both `certificate` and `key`, or neither");
  v.optional("names", web.names,
             "Host names under which browsers reach the appliance, besides numeric addresses and "
             "localhost; its own certificate contains them. Numeric addresses listed here are "
             "added to that certificate");
  v.optional("trusted_proxies", web.trusted_proxies,
             "Numeric addresses or prefixes (10.0.0.0/24) of reverse proxies whose statement of "
             "the client's address is trusted; see [reverse proxies](../ports/web/PROXIES.md)");
  require_proxies(v, web.trusted_proxies);
  v.optional("max_connections", web.max_connections, Range::between(4, 1000),
             "Limit for HTTP and, separately, for HTTPS; further connections wait");
  v.optional("max_connections_per_address", web.max_connections_per_address,
             Range::between(1, 1000),
             "Limit per host, or per IPv6 /64 network; further connections are closed at once");
  v.optional("max_streams", web.max_streams, Range::between(1, 1000),
             "Limit of picture streams; further ones are refused");
  v.optional("max_body_bytes", web.max_body_bytes, Range::between(1024, 1e7),
             "Largest body of a request, bytes; larger ones are refused");
  v.optional("request_timeout_ms", web.request_timeout, Milliseconds{Range::between(100, 60000)},
             "Time limit for a request to arrive completely, and for its answer to be read; a "
             "longer answer needs 64 KiB in each such time, a file also 64 KiB/s on average");
  v.optional("session_idle_min", web.session_idle, Minutes{Range::between(1, 1e5)},
             "Idle time after which a user without an open stream or download is logged out");
  v.optional("session_longest_min", web.session_longest, Minutes{Range::between(1, 1e5)},
             "Time after which a user is logged out in any case");
  v.table("jpeg", web.jpeg, "JPEG encoding of snapshots and streams");
}

/// Clients that may command over HTTP, in words; empty: none. Reentrant.
inline std::string commanders(const WebSettings& settings) {
  if (!settings.enabled) return "";
  std::string where = "over HTTP from this host";
  if (!hal::is_loopback(settings.address)) where += " and over HTTPS on " + settings.address;
  if (!settings.trusted_proxies.empty()) {
    where += " and through trusted proxies";
  } else if (hal::is_loopback(settings.address)) {
    where += " only";
  }
  return where + ", by role once there are users";
}

/// The page for other computers; without an address: it is off, or for its own computer only.
inline PageAddress page_address(const WebSettings& settings) {
  const auto port = https_port_of(settings);
  if (!settings.enabled || !port || hal::is_loopback(settings.address)) return {};
  return {settings.address, static_cast<std::uint16_t>(*port)};
}

/// The ports of an enabled server.
inline std::vector<ListeningPort> listening_ports(const WebSettings& settings) {
  std::vector<ListeningPort> ports;
  if (!settings.enabled) return ports;
  for (const std::string& address : http_addresses_of(settings)) {
    ports.push_back({WebSettings::kName, "port", address, settings.port});
  }
  if (const auto https = https_port_of(settings)) {
    ports.push_back({WebSettings::kName, "https_port", settings.address, *https});
  }
  return ports;
}

/// True: it shows the appliances of the DDS domain.
inline bool shows_fleet(const WebSettings& settings) { return settings.enabled; }

/// Checks certificate and key of an enabled server, as far as they are named. Error: as
/// web::named_certificate(). Reentrant.
Result<> check_keys(const WebSettings& settings, Dates dates);

std::unique_ptr<Sink> make_sink(const WebSettings& settings, const StatusNames& names,
                                const std::vector<PublishedView>& views,
                                const CommandPath& commands,
                                const std::shared_ptr<hal::SharedThreads>& background,
                                const std::shared_ptr<Fleet>& fleet, const PageContext& page,
                                const MachinePath& machine);

}  // namespace orbwatch::app
