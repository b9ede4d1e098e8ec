// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/web_sink.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "app/log.h"
#include "app/model/condition.h"
#include "app/ports/web/commands/command_body.h"
#include "app/ports/web/fleet/fleet_routes.h"
#include "app/ports/web/interfaces/interface_routes.h"
#include "app/ports/web/log/log_routes.h"
#include "app/ports/web/page/page_files.h"
#include "app/ports/web/status/metrics_text.h"
#include "app/ports/web/status/openapi.h"
#include "app/ports/web/status/status_text.h"
#include "app/ports/web/streams/live_stream.h"

namespace orbwatch::app {

using web::ExchangePtr;

namespace {

constexpr std::string_view kMetrics = "text/plain; version=0.0.4; charset=utf-8";
constexpr auto kWatchPeriod = std::chrono::milliseconds(250);

double seconds_between(hal::TimePoint from, hal::TimePoint to) {
  return std::chrono::duration<double>(to - from).count();
}

/// Makes a route usable for programs that can send only a name and a password, and no other header.
web::Route for_players(web::Route route) {
  route.takes_password = true;
  return route;
}

/// Routes of the page's files; index.html is also the root.
std::vector<web::Route> page_routes() {
  std::vector<web::Route> routes;
  routes.reserve(web::kPageFiles.size());
  for (const web::PageFile& file : web::kPageFiles) {
    const std::string type(web::page_type(file.name));
    const auto serve = [type, content = std::make_shared<const std::string>(file.content)](
                           const ExchangePtr& exchange) {
      web::Response response;
      response.type = type;
      response.body = content;
      exchange->answer(std::move(response));
    };
    web::Route route;
    route.method = "GET";
    route.role = Role::Nobody;
    route.path = "/";
    if (file.name != "index.html") route.path += file.name;
    route.description = "Of the page";
    route.type = type;
    route.serve = serve;
    route.is_page = true;
    routes.push_back(std::move(route));
  }
  return routes;
}

}  // namespace

WebSink::WebSink(WebSettings settings, const WebContext& context)
    : settings_(std::move(settings)),
      names_(context.names),
      threads_(context.background),
      list_(context),
      pixels_(context),
      asked_(names_.views.size()),
      commands_(context.commands.handler, context.commands.record),
      look_around_(context.names, context.views, context.background),
      align_(context.names.cameras, context.alignment),
      recipe_(context.recipes, {context.ball, context.scene},
              [this] { return newest().status.recipe; }),
      history_(context.names, context.recipes),
      audit_(context.state_folder),
      access_(context.state_folder, {settings_.session_idle, settings_.session_longest}),
      desk_(access_, audit_, settings_.session_longest),
      configuration_(context.program.files, access_, audit_),
      program_(context.program),
      fleet_(context.fleet),
      tables_(context.tables),
      metrics_(context.metrics),
      routes_(make_routes()),
      listeners_(
          settings_, context.state_folder,
          [this](const ExchangePtr& exchange) { pass_on(exchange); }, server_counts_) {
  const auto show = [this](const ViewPtr& view, std::uint64_t number) {
    pixels_.show(view, number);
  };
  views_.reserve(names_.views.size());
  for (std::size_t i = 0; i < names_.views.size(); ++i) {
    views_.push_back(std::make_unique<web::ViewEncoder>(settings_.jpeg, threads_, show));
  }
}

WebSink::~WebSink() { stop(); }

Result<> WebSink::start() {
  if (!settings_.enabled) return {};
  if (!is_running_) begin();
  return listeners_.open();
}

void WebSink::begin() {
  commands_.start();
  access_.start(https_port_of(settings_) || !settings_.trusted_proxies.empty());
  desk_.start();
  configuration_.start();
  is_running_ = true;
  thread_.start("web", [this] { watch(); });
}

void WebSink::pass_on(const ExchangePtr& exchange) {
  const auto caller_of = [this](const web::Request& request, const web::Route& route) {
    return access_
        .player(route.takes_password ? web::player_credentials_of(request)
                                     : web::credentials_of(request))
        .map_error(web::refused);
  };
  web::serve(routes_, caller_of, exchange);
}

void WebSink::watch() {
  while (thread_.wait_until(hal::Clock::now() + kWatchPeriod)) {
    listeners_.watch();
    access_.refresh();
    audit_.write_due(std::chrono::system_clock::now());
    pixels_.release_unwanted(hal::Clock::now());
    history_.advance(hal::Clock::now());
    if (!status_feed_->is_wanted()) continue;
    status_feed_->publish(std::make_shared<const std::string>(newest_as_json()), hal::Clock::now());
  }
}

/// Stops work in progress first, for example a restart, so that its answer is still sent.
void WebSink::stop() {
  is_running_ = false;
  thread_.stop();
  commands_.stop();
  configuration_.stop();
  desk_.stop();
  listeners_.close();
  look_around_.stop();
  access_.stop();
  audit_.write_all();
  for (const auto& view : views_) view->stop();
  pixels_.stop();
}

std::chrono::nanoseconds WebSink::cpu_time() const {
  std::chrono::nanoseconds time = thread_.cpu_time() + commands_.cpu_time() +
                                  look_around_.cpu_time() + desk_.cpu_time() +
                                  configuration_.cpu_time();
  for (const auto& view : views_) time += view->cpu_time();
  return time;
}

PictureNeeds WebSink::needs(std::size_t view, hal::TimePoint stamp) {
  if (view >= views_.size()) return {};
  const bool is_pointed = pixels_.wants(view, stamp);
  asked_[view] = is_running_ && views_[view]->wants(stamp, is_pointed);
  PictureNeeds needs;
  needs.jpeg = asked_[view];
  needs.counts = asked_[view] && is_pointed;
  return needs;
}

/// One picture of each view waits, one per thread is being compressed, and some are kept.
KeptViews WebSink::keeps() const { return {1, threads_->count() + web::RecentViews::kMost}; }

void WebSink::accept(const ViewPtr& view) {
  list_.accept(*view);
  if (view->index < views_.size() && asked_[view->index]) views_[view->index]->accept(view);
}

void WebSink::accept(const Status& status) {
  const auto now = hal::Clock::now();
  const auto utc = hal::to_utc(status.stamp);
  history_.accept(status);
  const std::lock_guard lock(mutex_);
  // Converted once per frame set, because conversions of the clocks differ by about a microsecond.
  if (status.frame_set != newest_.status.frame_set) newest_.utc = utc;
  newest_.status = status;
  newest_.received = now;
}

WebSink::NewestStatus WebSink::newest() const {
  const std::lock_guard lock(mutex_);
  return newest_;
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
  all.pictures_sent = stream_counts_.sent;
  all.pictures_skipped = stream_counts_.skipped;
  all.commands_done = commands_.done();
  all.commands_refused = commands_.refused();
  all.alarm_events = history_.alarm_events();
  for (const auto& view : views_) all.pictures_replaced += view->replaced();
  return all;
}

std::vector<web::Route> WebSink::make_routes() {
  const std::string text(web::kText), json(web::kJson);
  const auto by = [this](auto serve) {
    return [this, serve](const ExchangePtr& exchange) { (this->*serve)(exchange); };
  };
  std::vector<web::Route> routes{
      {"GET", "/healthz", Role::Nobody,
       "Returns 200 while the pipeline reports, else 503; the text is its state", text,
       by(&WebSink::serve_health)},
      {"GET", "/api/v1/status", Role::Viewer, "Returns the complete status", json,
       by(&WebSink::serve_status)},
      {"GET", "/api/v1/openapi.json", Role::Viewer, "Returns this description", json,
       by(&WebSink::serve_description)},
      for_players({"GET", "/metrics", Role::Viewer, "Returns the status for Prometheus",
                   std::string(kMetrics), by(&WebSink::serve_metrics)}),
      for_players({"GET", "/snapshot.jpg", Role::Viewer, "Returns the view's next picture",
                   std::string(web::kJpeg), by(&WebSink::serve_snapshot), web::ViewArgument::One}),
      for_players({"GET", "/stream.mjpg", Role::Viewer,
                   "Streams the view's pictures as MJPEG, for players and recorders",
                   std::string(web::MjpegStream::kType), by(&WebSink::serve_stream),
                   web::ViewArgument::One}),
      {"GET", "/api/v1/live", Role::Viewer,
       "Streams status and views over one connection. Each message begins with a line of JSON that "
       "states its kind and the number of bytes that follow",
       std::string(web::LiveStream::kType), by(&WebSink::serve_live), web::ViewArgument::Any},
  };
  routes.push_back(list_.route());
  routes.push_back(pixels_.route());
  std::ranges::move(desk_.routes(), std::back_inserter(routes));
  std::ranges::move(look_around_.routes(), std::back_inserter(routes));
  std::ranges::move(configuration_.routes(), std::back_inserter(routes));
  std::ranges::move(web::log_routes(program_.log), std::back_inserter(routes));
  std::ranges::move(align_.routes(), std::back_inserter(routes));
  std::ranges::move(recipe_.routes(), std::back_inserter(routes));
  std::ranges::move(history_.routes(), std::back_inserter(routes));
  std::ranges::move(web::interface_routes(tables_, program_), std::back_inserter(routes));
  std::ranges::move(web::fleet_routes(fleet_), std::back_inserter(routes));
  std::ranges::move(make_command_routes(), std::back_inserter(routes));
  std::ranges::move(page_routes(), std::back_inserter(routes));
  return routes;
}

/// One route for each of kCommands.
std::vector<web::Route> WebSink::make_command_routes() {
  std::vector<web::Route> routes;
  routes.reserve(kCommands.size());
  for (const CommandInfo& info : kCommands) {
    const auto serve = [this, &info](const ExchangePtr& exchange) { run_command(info, exchange); };
    routes.push_back({"POST", "/api/v1/command/" + std::string(info.name), info.role,
                      std::string(info.description), std::string(web::kJson), serve,
                      web::ViewArgument::None, &info});
  }
  return routes;
}

void WebSink::run_command(const CommandInfo& info, const ExchangePtr& exchange) {
  const web::Request& request = exchange->request();
  auto command = web::parse_command(info, request.body);
  if (!command) {
    exchange->answer(web::error_response(400, command.error().message));
    return;
  }
  const auto before = list_.at_present(*command);
  const std::string who = access_.caller(web::credentials_of(request)).name;
  command->giver = Giver(who.empty() ? "over HTTP" : who);
  const web::Audit::Entry entry{{},
                                who,
                                web::client_address(request),
                                std::string(info.name),
                                before ? web::arguments_text(info, *before) : "",
                                web::arguments_text(info, *command),
                                {}};
  commands_.run(*command, exchange, [this, entry](CommandResult result) {
    web::Audit::Entry noted = entry;
    noted.time = std::chrono::system_clock::now();
    noted.result = operator_text(result);
    audit_.note(noted);
  });
}

void WebSink::serve_description(const ExchangePtr& exchange) const {
  exchange->answer(web::json_response(web::openapi_json(routes_)));
}

void WebSink::serve_health(const ExchangePtr& exchange) const {
  const NewestStatus newest = this->newest();
  const bool is_stale = hal::Clock::now() - newest.received > settings_.status_timeout;
  web::Response response;
  response.status = is_stale ? 503 : 200;
  response.type = web::kText;
  const Condition condition = condition_of(static_cast<const SystemStatus&>(newest.status));
  response.body = std::make_shared<const std::string>(
      (is_stale ? "the pipeline does not report" : condition.text) + "\n");
  exchange->answer(std::move(response));
}

std::string WebSink::newest_as_json() const {
  const NewestStatus newest = this->newest();
  const auto now = hal::Clock::now();
  const bool has_status = newest.received != hal::TimePoint{};
  const double age = has_status ? seconds_between(newest.received, now) : signals::kNotValid;
  return web::status_json({newest.status, names_, now, newest.utc}, statistics(), age);
}

void WebSink::serve_status(const ExchangePtr& exchange) const {
  exchange->answer(web::json_response(newest_as_json()));
}

void WebSink::serve_metrics(const ExchangePtr& exchange) const {
  const NewestStatus newest = this->newest();
  web::Response response;
  response.type = kMetrics;
  const auto interfaces = metrics_ ? metrics_() : std::vector<InterfaceMetric>();
  response.body = std::make_shared<const std::string>(
      web::metrics_text({newest.status, names_, hal::Clock::now(), newest.utc}, statistics(),
                        interfaces, version_of(program_)));
  exchange->answer(std::move(response));
}

/// Finds a view; null: answered with the list of views. `name`: null if none was given.
const web::ViewEncoder* WebSink::find_view(const std::string* name,
                                           const ExchangePtr& exchange) const {
  std::string refusal = name ? "unknown view" : "no view; pass ?view=NAME";
  refusal += "; there are:";
  for (std::size_t i = 0; i < views_.size(); ++i) {
    if (name && *name == names_.views[i]) return views_[i].get();
    refusal += (i == 0 ? " " : ", ") + names_.views[i];
  }
  exchange->answer(web::error_response(404, refusal));
  return nullptr;
}

void WebSink::serve_snapshot(const ExchangePtr& exchange) const {
  const auto* view = find_view(exchange->request().argument("view"), exchange);
  if (view) view->feed()->answer_next(exchange);
}

void WebSink::serve_stream(const ExchangePtr& exchange) {
  const auto* view = find_view(exchange->request().argument("view"), exchange);
  if (!view) return;
  start_stream(exchange, web::player_credentials_of(exchange->request()), web::MjpegStream::kType,
               std::make_shared<web::MjpegStream>(view->feed(), stream_counts_));
}

/// Serves each view once, however often it is named.
void WebSink::serve_live(const ExchangePtr& exchange) {
  std::vector<web::LiveStream::Source> sources{{"", status_feed_}};
  for (const auto& [argument, name] : exchange->request().query) {
    if (argument != "view") continue;
    const auto* view = find_view(&name, exchange);
    if (!view) return;
    if (std::ranges::find(sources, name, &web::LiveStream::Source::name) == sources.end()) {
      sources.push_back({name, view->feed()});
    }
  }
  start_stream(exchange, web::credentials_of(exchange->request()), web::LiveStream::kType,
               std::make_shared<web::LiveStream>(std::move(sources), stream_counts_));
}

void WebSink::start_stream(const ExchangePtr& exchange, web::Credentials credentials,
                           std::string_view type, std::shared_ptr<web::Stream> stream) {
  if (server_counts_.streams >= static_cast<std::uint64_t>(settings_.max_streams)) {
    ++server_counts_.full;
    exchange->answer(
        web::error_response(503, "all streams are in use; raise max_streams of [web]"));
    return;
  }
  web::Response response;
  response.type = type;
  response.stream = std::move(stream);
  response.may_go_on = [this, credentials = std::move(credentials)] {
    return access_.caller(credentials).role >= Role::Viewer;
  };
  exchange->answer(std::move(response));
}

std::unique_ptr<Sink> make_sink(const WebSettings& settings, const StatusNames& names,
                                const std::vector<PublishedView>& views,
                                const CommandPath& commands,
                                const std::shared_ptr<hal::SharedThreads>& background,
                                const std::shared_ptr<Fleet>& fleet, const PageContext& page) {
  if (!settings.enabled) return nullptr;
  return std::make_unique<WebSink>(settings,
                                   WebContext{page, names, views, commands, background, fleet});
}

}  // namespace orbwatch::app
