// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/log/log_routes.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "app/model/utc_text.h"
#include "proc/image/result.h"
#include "proc/settings/settings.h"

namespace orbwatch::app::web {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kLevels{
    Word{"error", LogLevel::Error},
    Word{"warning", LogLevel::Warning},
    Word{"info", LogLevel::Info},
};

constexpr std::size_t kUsualLines = 200;

/// A whole number of the query; nullopt: present but not a whole number.
template <class Number>
std::optional<Number> number_of(const Request& request, const char* name, Number usual) {
  const std::string* text = request.argument(name);
  if (!text) return usual;
  Number number{};
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), number);
  if (error != std::errc() || end != text->data() + text->size()) return std::nullopt;
  return number;
}

/// Requested lines. Error: an invalid argument, with its allowed values.
Result<RecentLog::Wanted> wanted_of(const Request& request) {
  RecentLog::Wanted wanted;
  const auto most = number_of(request, "lines", kUsualLines);
  if (!most) return fail("lines must be a whole number");
  const auto after = number_of(request, "after", std::uint64_t{0});
  if (!after) return fail("after must be a whole number");
  wanted.most = *most;
  wanted.after = *after;
  const std::string* level = request.argument("level");
  if (!level) return wanted;
  const LogLevel* found = find_word(kLevels, *level);
  if (!found) return fail("level must be error, warning or info");
  wanted.least = *found;
  return wanted;
}

Json line_json(const RecentLog::Line& line) {
  Json json{{"number", line.number},
            {"time", utc_text(line.time).value_or("")},
            {"level", std::string(word_for(kLevels, line.level))},
            {"text", line.text}};
  if (!line.camera.empty()) json["camera"] = line.camera;
  if (!line.fault.empty()) json["fault"] = line.fault;
  if (line.trigger != 0) json["trigger"] = line.trigger;
  return json;
}

void show(const RecentLog& log, const ExchangePtr& exchange) {
  const auto wanted = wanted_of(exchange->request());
  if (!wanted) {
    exchange->answer(error_response(400, wanted.error().message));
    return;
  }
  // Read before the lines, so that no line added meanwhile is skipped.
  std::uint64_t newest = log.newest_number();
  Json lines = Json::array();
  for (const RecentLog::Line& line : log.newest(*wanted)) {
    lines.push_back(line_json(line));
    newest = std::max(newest, line.number);
  }
  // File names may contain any bytes.
  exchange->answer(json_response(Json{{"newest", newest}, {"lines", std::move(lines)}}.dump(
      -1, ' ', false, Json::error_handler_t::replace)));
}

}  // namespace

std::vector<Route> log_routes(std::shared_ptr<const RecentLog> log) {
  if (!log) return {};
  Route route{"GET",
              "/api/v1/log",
              Role::Operator,
              "Returns the newest lines of the log since the start, oldest first",
              std::string(kJson),
              [log = std::move(log)](const ExchangePtr& exchange) { show(*log, exchange); }};
  route.query = {{"lines", "Limit of lines, up to 1000; default: 200"},
                 {"level", "Least severity: error, warning or info", false, false},
                 {"after", "Number of the last line already read; only later lines are returned"}};
  return {route};
}

}  // namespace orbwatch::app::web
