// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/tls/server_certificate.h"

#include <algorithm>

#include "app/certificates/certificate_file.h"
#include "app/log.h"
#include "app/state/private_file.h"
#include "hal/host.h"
#include "hal/regular_file.h"

namespace orbwatch::app::web {
namespace {

namespace fs = std::filesystem;
using std::chrono::sys_seconds;

/// Tolerance for clocks of browsers.
constexpr std::chrono::days kClockDifference{1};
/// Limit of a common name in RFC 5280.
constexpr std::size_t kLongestName = 64;

/// Key and certificate in one file, so that they are replaced together.
fs::path self_made_file(const fs::path& folder) { return folder / "certificate.pem"; }

Result<ServerCertificate> server_certificate(PemPair pem, const Certificate& certificate) {
  return validity_of(certificate).map([&](const ValidityPeriod& validity) {
    return ServerCertificate{std::move(pem), validity, fingerprint_of(certificate), false};
  });
}

Result<ServerCertificate> parse(const std::string& pem) {
  const auto certificate = certificate_from_pem(pem);
  if (!certificate) return tl::unexpected(certificate.error());
  const auto key = key_from_pem(pem);
  if (!key) return tl::unexpected(key.error());
  if (!is_key_of(*key, *certificate)) return fail("the key does not match the certificate");
  return server_certificate({pem, pem}, *certificate).map([](ServerCertificate made) {
    made.is_self_made = true;
    return made;
  });
}

/// Returns whether `text` has only characters of DNS names and addresses.
bool is_host(const std::string& text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '-' || c == '_' || c == ':';
  });
}

bool is_for_all(const ServerCertificate& kept, const std::vector<std::string>& hosts) {
  const auto certificate = certificate_from_pem(kept.pem.certificate);
  return certificate && std::ranges::all_of(hosts, [&](const std::string& host) {
           return is_for_host(*certificate, host);
         });
}

Result<ServerCertificate> make(const fs::path& file, const std::vector<std::string>& hosts,
                               sys_seconds now) {
  const ValidityPeriod validity{now - kClockDifference, now - kClockDifference + kSelfMadeDays};
  const std::string host = hal::host_name();
  const auto made = make_credential(host.empty() ? "orbwatch" : host.substr(0, kLongestName),
                                    CertificateUse::Serve, validity, nullptr, hosts);
  if (!made) return tl::unexpected(made.error());
  const auto certificate = to_pem(made->certificate), key = to_pem(made->key);
  if (!certificate) return tl::unexpected(certificate.error());
  if (!key) return tl::unexpected(key.error());
  const std::string text = *certificate + *key;
  return write_private(file, text).and_then([&] { return parse(text); });
}

}  // namespace

Result<ServerCertificate> named_certificate(const WebSettings& settings, const Now& now) {
  const auto key = read_key(settings.key);
  if (!key) return tl::unexpected(key.error());
  const auto key_pem = to_pem(*key);
  if (!key_pem) return tl::unexpected(key_pem.error());
  auto pem = hal::read_regular_file(settings.certificate);
  if (!pem) return tl::unexpected(pem.error());
  const auto certificate = of_file(settings.certificate, certificate_from_pem(*pem));
  if (!certificate) return tl::unexpected(certificate.error());
  return check_pair(settings.key, *key, settings.certificate, *certificate)
      .and_then([&] { return check_dates(settings.certificate, *certificate, now); })
      .and_then([&] {
        return server_certificate({std::move(*pem), *key_pem}, *certificate);
      })
      .map_error([](const Error& error) { return Error{"web: " + error.message}; });
}

Result<std::optional<ServerCertificate>> kept_certificate(const fs::path& folder) {
  const fs::path file = self_made_file(folder);
  const auto text = read_private(file);
  if (!text) return tl::unexpected(text.error());
  if (!*text) return std::nullopt;
  return of_file(file, parse(**text)).map([](ServerCertificate kept) {
    return std::optional(std::move(kept));
  });
}

Result<ServerCertificate> self_made_certificate(const fs::path& folder,
                                                const std::vector<std::string>& hosts,
                                                sys_seconds now, ClockState clock) {
  if (folder.empty()) return fail("web: there is no state folder for a certificate");
  auto kept = kept_certificate(folder);
  if (!kept) log_line(LogLevel::Warning, "web: creates a new certificate: " + kept.error().message);
  if (kept && *kept && !is_due(**kept, now, clock) && is_for_all(**kept, hosts)) {
    return std::move(**kept);
  }
  return make(self_made_file(folder), hosts, now).map_error([](const Error& error) {
    return Error{"web: no certificate: " + error.message};
  });
}

bool is_due(const ServerCertificate& certificate, sys_seconds now, ClockState clock) {
  const bool is_early = clock == ClockState::Synchronised && now < certificate.validity.from;
  return certificate.is_self_made &&
         (is_early || now >= certificate.validity.until - kRenewedBefore);
}

std::vector<std::string> own_hosts(const WebSettings& settings) {
  std::vector<std::string> hosts{"localhost", "127.0.0.1", "::1"};
  const auto add = [&hosts](const std::string& host) {
    if (is_host(host) && std::ranges::find(hosts, host) == hosts.end()) hosts.push_back(host);
  };
  if (!hal::is_unspecified(settings.address)) add(settings.address);
  for (const std::string& name : settings.names) add(name);
  if (const std::string name = hal::host_name(); !name.empty()) {
    add(name);
    // Name in multicast DNS.
    if (name.find('.') == std::string::npos) add(name + ".local");
  }
  return hosts;
}

std::string certificate_text(const ServerCertificate& certificate) {
  return std::string(certificate.is_self_made ? "self-made" : "own") +
         " certificate, valid until " + date_text(certificate.validity.until, "%Y-%m-%d") +
         ", SHA-256 fingerprint " + certificate.fingerprint;
}

}  // namespace orbwatch::app::web

namespace orbwatch::app {

Result<> check_keys(const WebSettings& settings, Dates dates) {
  if (!settings.enabled || settings.certificate.empty()) return {};
  return web::named_certificate(settings, now_for(dates)).map([](const auto&) {});
}

}  // namespace orbwatch::app
