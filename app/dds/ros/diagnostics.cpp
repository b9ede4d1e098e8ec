#include "app/dds/ros/diagnostics.h"

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdio>
#include <optional>

#include "app/dds/ros/ros_node.h"
#include "app/health/throttling.h"
#include "app/json/status_fields.h"

namespace orbwatch::app {
namespace {

std::string value_text(std::string_view text) { return std::string(text); }
std::string value_text(bool truth) { return truth ? "True" : "False"; }
std::string value_text(std::integral auto number) { return std::to_string(number); }
std::string value_text(double number) {
  if (!signals::is_valid(number)) return "not valid";
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.9g", number);
  return text.data();
}
template <class T>
std::string value_text(const std::optional<T>& value) {
  return value ? value_text(*value) : "";
}

/// Collects fields as key and value; a visitor of status_fields.h. Objects and lists are entries of
/// their own.
class Values {
 public:
  explicit Values(Diagnostic& entry) : values_(entry.values) {}

  template <class T>
  void field(std::string_view name, const T& value) {
    values_.emplace_back(name, value_text(value));
  }
  void field(std::string_view name, double value, std::string_view unit) {
    field(unit.empty() ? std::string(name) : std::string(name) + " (" + std::string(unit) + ")",
          value);
  }
  void code(std::string_view name, int, std::string_view text) { field(name, text); }
  template <class Fill>
  void object(std::string_view, const Fill&) {}
  template <class Fill>
  void list(std::string_view, std::size_t, const Fill&) {}

 private:
  std::vector<std::pair<std::string, std::string>>& values_;
};

Diagnostic entry(DiagnosticLevel level, const std::string& name, std::string_view message) {
  return {level, std::string(kNodeName) + ": " + name, std::string(message), {}};
}

/// The name of the entry `index` of a list of `kind`, its number where it has none.
std::string called(const std::string& kind, std::string_view name, std::size_t index) {
  return kind + " " + (name.empty() ? std::to_string(index + 1) : std::string(name));
}

DiagnosticLevel level_of(SystemState state) {
  switch (state) {
    case SystemState::Starting:
      return DiagnosticLevel::Stale;
    case SystemState::Running:
    case SystemState::Stopped:
      return DiagnosticLevel::Ok;
    case SystemState::Degraded:
      return DiagnosticLevel::Warn;
    case SystemState::Fault:
      return DiagnosticLevel::Error;
  }
  return DiagnosticLevel::Error;
}

Diagnostic diagnose_system(const StatusReport& report) {
  Diagnostic system = entry(level_of(report.status.state), "system", name_of(report.status.state));
  if (report.status.recipe_refused) {
    if (system.level == DiagnosticLevel::Ok) system.level = DiagnosticLevel::Warn;
    system.message += "; a camera refused the recipe's settings";
  }
  Values values(system);
  visit(values, report);
  return system;
}

Diagnostic diagnose_camera(const StatusReport& report, std::size_t i) {
  const CameraStatus& camera = report.status.cameras[i];
  const double age_s = report.times.last_frame_age_s[i];
  const std::string name = called("camera", name_at(report.names.cameras, i), i);
  Diagnostic diagnostic = entry(DiagnosticLevel::Ok, name, hal::operator_text(camera.fault));
  if (camera.fault != hal::Fault::None) {
    diagnostic.level = DiagnosticLevel::Error;
  } else if (!signals::is_valid(age_s)) {
    diagnostic.level = DiagnosticLevel::Stale;
    diagnostic.message = "no frame yet";
  }
  Values values(diagnostic);
  visit(values, camera, age_s);
  return diagnostic;
}

Diagnostic diagnose_view(const StatusReport& report, std::size_t i) {
  const ViewStatus& view = report.status.views[i];
  const bool none = view.published == 0;
  Diagnostic diagnostic = entry(none ? DiagnosticLevel::Stale : DiagnosticLevel::Ok,
                                called("view", name_at(report.names.views, i), i),
                                none ? "no picture yet" : "published");
  Values values(diagnostic);
  visit(values, view);
  return diagnostic;
}

Diagnostic diagnose_region(const StatusReport& report, std::size_t i) {
  const RegionStatus& region = report.status.regions[i];
  const bool none = region.quality == Quality::NotMeasured;
  Diagnostic diagnostic = entry(none ? DiagnosticLevel::Stale : DiagnosticLevel::Ok,
                                called("region", report.names.region(report.status.recipe, i), i),
                                name_of(region.quality));
  Values values(diagnostic);
  visit(values, region);
  return diagnostic;
}

/// A standing alarm counts as what was announced: a latched one is within its limits again.
DiagnosticLevel level_of(const signals::Alarm& alarm) {
  if (signals::is_active(alarm.state)) {
    const int worst = std::max(signals::severity(alarm.level), signals::severity(alarm.announced));
    return worst > 1 ? DiagnosticLevel::Error : DiagnosticLevel::Warn;
  }
  return signals::awaits_acknowledgement(alarm.state) ? DiagnosticLevel::Warn : DiagnosticLevel::Ok;
}

Diagnostic diagnose_alarm(const StatusReport& report, std::size_t i) {
  const AlarmStatus& alarm = report.status.alarms[i];
  const std::string region =
      called("region", report.names.region(report.status.recipe, alarm.region), alarm.region);
  const std::string name = "alarm " + std::to_string(i + 1) + ", " + region + ", " +
                           std::string(signals::kSignals[alarm.signal].name);
  Diagnostic diagnostic =
      entry(level_of(alarm.alarm), name, signals::operator_text(alarm.alarm.state));
  Values values(diagnostic);
  visit(values, alarm, report.times.alarm_age_s[i]);
  return diagnostic;
}

Diagnostic diagnose_board(const Health& health) {
  Diagnostic board = entry(DiagnosticLevel::Ok, "board", "");
  const auto warn = [&board](std::string_view reason) {
    board.level = DiagnosticLevel::Warn;
    board.message += (board.message.empty() ? "" : "; ") + std::string(reason);
  };
  constexpr unsigned kNow = (1U << kSincePowerOn) - 1;
  if (signals::is_valid(health.throttling) && (static_cast<unsigned>(health.throttling) & kNow)) {
    warn("too hot or short of power: the processors are held back");
  }
  if (health.clock_synchronised == 0) warn("the clock follows no time server");
  const bool unknown = std::ranges::none_of(
      kHealthFigures, [&](const auto& info) { return signals::is_valid(health.*info.member); });
  if (unknown) board = entry(DiagnosticLevel::Stale, "board", "not known yet");
  if (board.message.empty()) board.message = "no complaint";
  Values values(board);
  visit_values(values, health, kHealthFigures);
  return board;
}

Diagnostic diagnose_commands(const CommandCounts& counts) {
  Diagnostic commands = entry(DiagnosticLevel::Ok, "commands", "since start");
  Values values(commands);
  visit(values, counts);
  return commands;
}

/// The C API takes no const pointers, but a write changes nothing.
char* text(std::string& owner) { return owner.data(); }

}  // namespace

std::vector<Diagnostic> diagnose(const StatusReport& report, const CommandCounts& commands) {
  const Status& status = report.status;
  std::vector<Diagnostic> all{diagnose_system(report)};
  const auto add = [&](std::size_t count, auto diagnose_one) {
    for (std::size_t i = 0; i < count; ++i) all.push_back(diagnose_one(report, i));
  };
  add(status.camera_count, diagnose_camera);
  add(status.view_count, diagnose_view);
  add(status.region_count, diagnose_region);
  add(status.alarm_count, diagnose_alarm);
  all.push_back(diagnose_board(status.health));
  all.push_back(diagnose_commands(commands));
  return all;
}

const DiagnosticsMessage& DiagnosticsComposer::compose(std::vector<Diagnostic> diagnostics,
                                                       const TimeMessage& stamp) {
  diagnostics_ = std::move(diagnostics);
  values_.clear();
  for (Diagnostic& diagnostic : diagnostics_) {
    for (auto& [key, value] : diagnostic.values) values_.push_back({text(key), text(value)});
  }
  entries_.clear();
  auto* next = values_.data();
  for (Diagnostic& diagnostic : diagnostics_) {
    const auto count = static_cast<std::uint32_t>(diagnostic.values.size());
    entries_.push_back({static_cast<std::uint8_t>(diagnostic.level),
                        text(diagnostic.name),
                        text(diagnostic.message),
                        text(hardware_id_),
                        {count, count, next, false}});
    next += count;
  }
  const auto count = static_cast<std::uint32_t>(entries_.size());
  message_.header = {stamp, text(frame_id_)};
  message_.status = {count, count, entries_.data(), false};
  return message_;
}

}  // namespace orbwatch::app
