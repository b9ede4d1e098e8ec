// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/web_sink.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

#include "app/ports/web/api/router.h"
#include "app/ports/web/page/page_routes.h"
#include "app/ports/web/routes.h"

namespace orbwatch::app {
namespace {

constexpr auto kWatchPeriod = std::chrono::milliseconds(250);
/// Requests that a browser makes at the same time: a list has a picture per event.
constexpr std::size_t kMostOfBrowser = 6;

}  // namespace

WebSink::WebSink(WebSettings settings, const WebContext& context)
    : settings_(std::move(settings)),
      threads_(context.background),
      audit_(context.state_folder),
      access_(context.state_folder, {settings_.session_idle, settings_.session_longest}),
      access_changes_(access_, audit_, "web access",
                      "too many logins or changes of users at present; try again"),
      file_changes_(access_, audit_, "web files",
                    "other users are changing the configuration at present; try again"),
      recording_changes_(access_, audit_, "web recordings",
                         "recordings are being read for other users at present; try again",
                         kMostOfBrowser),
      device_changes_(access_, audit_, "web device",
                      "another file of the whole device is being made or restored; try again"),
      list_(context),
      pixels_(context),
      status_(context.names, {[this] { return statistics(); }, context.metrics},
              version_of(context.program), settings_.status_timeout),
      balls_(context),
      streams_(
          context.names.views, context.views, balls_.sources(), settings_.jpeg,
          settings_.max_streams, threads_, status_.feed(),
          [this](const ViewPtr& view, std::uint64_t number) { pixels_.show(view, number); },
          access_, server_counts_),
      commands_(context.commands, list_, access_, audit_),
      machine_(context.machine),
      look_around_(context.names, context.views, balls_.all(), context.background),
      alignment_(context.names.cameras, context.alignment),
      recipe_(context.recipes, {context.ball, context.scene}, [this] { return status_.recipe(); }),
      history_(context.names, context.recipes, context.state_folder),
      log_(context.program.log),
      desk_(access_, audit_, access_changes_, settings_.session_longest),
      configuration_(context.program.files, audit_, file_changes_),
      interfaces_(context.tables, context.program),
      fleet_(context.fleet),
      recordings_(context.events, context.regions, recording_changes_),
      exports_(context.exports, recording_changes_),
      replays_(context.replays, [this] { return status_.recipe(); }),
      device_(
          context.program.device, context.program.update, context.program.files,
          [this] { return figures(); }, device_changes_),
      routes_(make_routes()),
      listeners_(
          settings_, context.state_folder,
          [this](const web::ExchangePtr& exchange) { pass_on(exchange); }, server_counts_) {}

WebSink::~WebSink() { stop(); }

std::vector<web::Route> WebSink::make_routes() {
  std::vector<web::Route> routes = web::routes_of({&status_,
                                                   &streams_,
                                                   &list_,
                                                   &pixels_,
                                                   &desk_,
                                                   &access_changes_,
                                                   &look_around_,
                                                   &configuration_,
                                                   &file_changes_,
                                                   &log_,
                                                   &alignment_,
                                                   &recipe_,
                                                   &history_,
                                                   &interfaces_,
                                                   &fleet_,
                                                   &commands_,
                                                   &machine_,
                                                   &recordings_,
                                                   &recording_changes_,
                                                   &exports_,
                                                   &replays_,
                                                   &device_,
                                                   &device_changes_});
  std::ranges::move(web::page_routes(), std::back_inserter(routes));
  return routes;
}

/// Texts for a support file.
DeviceFiles::Figures WebSink::figures() const {
  DeviceFiles::Figures texts{{"status.json", *status_.status().body},
                             {"metrics.txt", *status_.metrics().body},
                             {"figures.csv", *history_.table().body},
                             {"alarms.json", *history_.alarms({web::AlarmHistory::kMost}).body}};
  constexpr std::size_t kLines = 1000;
  if (auto log = log_.lines({{kLines}})) {
    texts.emplace_back("log.json", web::json_text(web::json_of(*log)));
  }
  return texts;
}

Result<> WebSink::start() {
  if (!settings_.enabled) return {};
  if (!is_running_) begin();
  return listeners_.open();
}

void WebSink::begin() {
  commands_.runner().start();
  access_.start(https_port_of(settings_) || !settings_.trusted_proxies.empty());
  access_changes_.start();
  file_changes_.start();
  recording_changes_.start();
  exports_.start();
  replays_.start();
  device_changes_.start();
  is_running_ = true;
  thread_.start("web", [this] { watch(); });
  files_thread_.start("web records", hal::ThreadRole::Background, [this] { follow_files(); });
}

void WebSink::pass_on(const web::ExchangePtr& exchange) {
  const auto caller_of = [&](const web::Request& request, const web::Route& route) {
    const web::Credentials credentials =
        route.takes_password ? web::player_credentials_of(request) : web::credentials_of(request);
    exchange->send_file_while([this, credentials, role = route.role] {
      return access_.caller(credentials).role >= role;
    });
    return access_.player(credentials).map_error(web::refused);
  };
  web::serve(routes_, caller_of, exchange);
}

void WebSink::watch() {
  while (thread_.wait_until(hal::Clock::now() + kWatchPeriod)) {
    listeners_.watch();
    pixels_.release_unwanted(hal::Clock::now());
    balls_.follow();
    history_.advance(hal::Clock::now());
    status_.publish();
  }
}

/// Waits for the disk, for which neither the live status nor overdue connections may wait.
void WebSink::follow_files() {
  while (files_thread_.wait_until(hal::Clock::now() + kWatchPeriod)) {
    access_.refresh();
    listeners_.renew_certificate();
    commands_.note_others();
    audit_.write_due(std::chrono::system_clock::now());
    history_.keep(hal::Clock::now());
  }
}

/// Stops work in progress first, for example a restart, so that its answer is still sent.
void WebSink::stop() {
  const bool was_running = is_running_.exchange(false);
  thread_.stop();
  files_thread_.stop();
  commands_.runner().stop();
  file_changes_.stop();
  recording_changes_.stop();
  exports_.stop();
  replays_.stop();
  if (was_running) device_.cancel();
  device_changes_.stop();
  access_changes_.stop();
  listeners_.close();
  look_around_.stop();
  access_.stop();
  commands_.note_others();  // of interfaces that stopped before
  audit_.write_all();
  if (was_running) history_.keep_all();
  streams_.stop();
  pixels_.stop();
}

std::chrono::nanoseconds WebSink::cpu_time() const {
  return thread_.cpu_time() + files_thread_.cpu_time() + commands_.runner().cpu_time() +
         look_around_.cpu_time() + access_changes_.cpu_time() + file_changes_.cpu_time() +
         recording_changes_.cpu_time() + exports_.cpu_time() + replays_.cpu_time() +
         device_changes_.cpu_time() + streams_.cpu_time();
}

PictureNeeds WebSink::needs(std::size_t view, hal::TimePoint stamp) {
  const bool is_pointed = pixels_.wants(view, stamp);
  PictureNeeds needs;
  needs.jpeg = is_running_ && streams_.wants(view, stamp, is_pointed);
  needs.counts = needs.jpeg && is_pointed;
  return needs;
}

/// One picture of each view waits, one per thread is being compressed, and some are kept.
KeptViews WebSink::keeps() const { return {1, threads_->count() + web::RecentViews::kMost}; }

void WebSink::accept(const ViewPtr& view) {
  list_.accept(*view);
  if (is_running_) streams_.accept(view);
}

void WebSink::accept(const Status& status) {
  history_.accept(status);
  status_.accept(status);
}

web::WebStatistics WebSink::statistics() const {
  web::WebStatistics all;
  all.connections = server_counts_.connections;
  all.streams = server_counts_.streams;
  all.requests = server_counts_.requests;
  all.refused = server_counts_.refused;
  all.overdue = server_counts_.overdue;
  all.turned_away = server_counts_.turned_away;
  all.certificate_days = listeners_.certificate_days();
  all.streams_refused = server_counts_.full;
  all.logins_failed = access_.failures();
  all.commands_done = commands_.runner().done();
  all.commands_refused = commands_.runner().refused();
  all.alarm_events = history_.alarm_events();
  streams_.count(all);
  return all;
}

std::unique_ptr<Sink> make_sink(const WebSettings& settings, const StatusNames& names,
                                const std::vector<PublishedView>& views,
                                const CommandPath& commands,
                                const std::shared_ptr<hal::SharedThreads>& background,
                                const std::shared_ptr<Fleet>& fleet, const PageContext& page,
                                const MachinePath& machine) {
  if (!settings.enabled) return nullptr;
  return std::make_unique<WebSink>(
      settings, WebContext{page, names, views, commands, background, fleet, machine});
}

}  // namespace orbwatch::app
