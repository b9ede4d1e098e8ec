// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/listeners.h"

#include <limits>
#include <utility>

#include "app/log.h"
#include "app/ports/web/tls/redirect.h"
#include "hal/host.h"
#include "hal/network.h"
#include "hal/synchronised_clock.h"

namespace orbwatch::app::web {
namespace {

constexpr std::chrono::seconds kRenewalPause{60}, kReopeningPause{5};

std::chrono::sys_seconds utc_now() { return *now_for(Dates::Checked); }

ClockState clock_state() {
  return hal::is_clock_synchronised() ? ClockState::Synchronised : ClockState::Unsure;
}

}  // namespace

Listeners::Listeners(const WebSettings& settings, std::filesystem::path state_folder,
                     Server::Handler handler, ServerCounts& counts)
    : settings_(settings),
      state_folder_(std::move(state_folder)),
      handler_(std::move(handler)),
      counts_(counts) {}

Result<> Listeners::open() {
  const std::lock_guard making(making_mutex_);
  const std::lock_guard lock(mutex_);
  if (http_.empty()) {
    if (auto opened = open_http(); !opened) return opened;
  }
  if (!https_port_of(settings_) || https_) return {};
  return certificate().and_then(
      [this](ServerCertificate shown) { return open_https(std::move(shown)); });
}

Result<> Listeners::open_http() {
  std::vector<std::unique_ptr<Server>> servers;
  for (const std::string& address : http_addresses_of(settings_)) {
    auto server = Server::open(
        settings_, {address, settings_.port, std::nullopt, {}},
        [this](const ExchangePtr& exchange) { serve_http(exchange); }, counts_);
    if (!server) return tl::unexpected(server.error());
    servers.push_back(std::move(*server));
  }
  http_ = std::move(servers);
  port_ = http_.back()->port();
  log_line(LogLevel::Info, "web: serves HTTP for this computer on port " + std::to_string(port_));
  return {};
}

Result<ServerCertificate> Listeners::certificate() const {
  return settings_.certificate.empty()
             ? self_made_certificate(state_folder_, own_hosts(settings_), utc_now(), clock_state())
             : named_certificate(settings_, now_for(Dates::Checked));
}

/// Opens HTTPS again on the same port, even if the kernel chose it.
Result<> Listeners::open_https(ServerCertificate certificate) {
  const int chosen = https_port_;
  auto server = Server::open(settings_,
                             {settings_.address, chosen > 0 ? chosen : *https_port_of(settings_),
                              certificate.pem, https_headers(settings_)},
                             handler_, counts_);
  if (!server) return tl::unexpected(server.error());
  https_ = std::move(*server);
  https_port_ = https_->port();
  certificate_ends_ = certificate.validity.until.time_since_epoch().count();
  certificate_ = std::move(certificate);
  log_line(LogLevel::Info, "web: serves HTTPS on " + settings_.address + " port " +
                               std::to_string(https_port_) + ": " +
                               certificate_text(*certificate_));
  return {};
}

void Listeners::close() {
  const std::lock_guard lock(mutex_);
  https_.reset();
  http_.clear();
  https_port_ = 0;
  certificate_.reset();
}

void Listeners::watch() {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock.owns_lock()) return;
  for (const auto& server : http_) server->end_overdue();
  if (https_) https_->end_overdue();
}

bool Listeners::is_certificate_due() {
  const ClockState clock = clock_state();
  const std::lock_guard lock(mutex_);
  return certificate_ && is_due(*certificate_, utc_now(), clock);
}

/// Without a new certificate the old server stays; when the port cannot be opened, HTTPS is closed.
/// Both are attempted again.
void Listeners::renew_certificate() {
  const std::lock_guard making(making_mutex_);
  const hal::TimePoint now = hal::Clock::now();
  if (now < next_renewal_ || !is_certificate_due()) return;
  auto made = certificate();
  const std::lock_guard lock(mutex_);
  if (!certificate_) return;  // close() was called meanwhile
  const auto opened = std::move(made).and_then([this](ServerCertificate renewed) {
    https_.reset();
    return open_https(std::move(renewed));
  });
  if (!opened) log_line(LogLevel::Error, opened.error().message);
  next_renewal_ = now + (https_ ? kRenewalPause : kReopeningPause);
}

void Listeners::serve_http(const ExchangePtr& exchange) const {
  const auto https = https_port_of(settings_);
  const Request& request = exchange->request();
  const bool is_here = request.passage == Passage::Direct && hal::is_loopback(request.peer);
  if (!https || is_here || request.passage == Passage::TrustedProxy) return handler_(exchange);
  const int open = https_port_;
  exchange->answer(to_https(request, open > 0 ? open : *https));
}

double Listeners::certificate_days() const {
  const std::int64_t ends = certificate_ends_;
  if (ends == 0) return std::numeric_limits<double>::quiet_NaN();
  constexpr double kSecondsOfDay = 86400;
  return static_cast<double>(ends - utc_now().time_since_epoch().count()) / kSecondsOfDay;
}

}  // namespace orbwatch::app::web
