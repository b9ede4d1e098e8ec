// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/status/diagnostics.h"

#include <array>
#include <cstdio>

#include "app/model/status/condition.h"
#include "app/model/status/readings.h"
#include "app/ports/dds/ros/ros_node.h"
#include "app/ports/dds/status/process_state.h"

namespace orbwatch::app::dds {
namespace {

using Values = std::vector<std::pair<std::string, std::string>>;

std::string value_text(const Reading& reading) {
  if (reading.text == "true") return "True";
  if (reading.text == "false") return "False";
  if (!reading.text.empty()) return std::string(reading.text);
  if (!signals::is_valid(reading.value)) return "not valid";
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.15g", reading.value);  // 15 digits keep counts exact
  return text.data();
}

template <class Part>
Values values_of(const Part& part, hal::TimePoint now) {
  Values values;
  for_each_reading(part, now, [&values](const Reading& reading) {
    if (std::is_same_v<Part, RegionStatus> && reading.name != "quality") return;
    std::string key(reading.name);
    if (!reading.unit.empty()) key += " (" + std::string(reading.unit) + ")";
    values.emplace_back(std::move(key), value_text(reading));
  });
  return values;
}

std::string line_name(std::string_view kind, std::string_view name) {
  std::string text = std::string(kNodeName) + ": " + std::string(kind);
  return name.empty() ? text : text + " " + std::string(name);
}

/// Counts of one line; counts of 0 are omitted.
class Counters {
 public:
  explicit Counters(Diagnostic& diagnostic) : diagnostic_(diagnostic) {}

  void normal(const std::string& name, std::uint64_t count) {
    if (count > 0) diagnostic_.values.emplace_back(name, std::to_string(count));
  }
  /// Adds a count that is a warning.
  void bad(const std::string& name, std::uint64_t count, std::string_view message) {
    normal(name, count);
    if (count == 0 || diagnostic_.level == DiagnosticLevel::Warn) return;
    diagnostic_.level = DiagnosticLevel::Warn;
    diagnostic_.message = message;
  }

 private:
  Diagnostic& diagnostic_;
};

}  // namespace

std::vector<Diagnostic> diagnose(const StatusReport& report, const DdsStatistics& network) {
  std::vector<Diagnostic> all;
  for_each_component(report, [&](const Component& component, const auto& part) {
    const Condition condition = condition_of(part);
    all.push_back({static_cast<DiagnosticLevel>(condition.severity),
                   line_name(component.kind, component.name), condition.text,
                   values_of(part, report.now)});
  });
  all.push_back({DiagnosticLevel::Ok, line_name(kCommandsKind, ""), "since start",
                 values_of(network.commands, report.now)});
  all.push_back(diagnose_network(network));
  return all;
}

Diagnostic diagnose_network(const DdsStatistics& network) {
  Diagnostic diagnostic{DiagnosticLevel::Ok, line_name("network", ""), "since start", {}};
  Counters counters(diagnostic);
  counters.normal("joins", network.joins);
  counters.normal("dropped_states", network.dropped_states);
  counters.bad("dropped_events", network.dropped_events, "events were lost");
  counters.bad("unknown_views", network.unknown_views, "views have no topic");
  counters.bad("mistyped", network.mistyped, "a foreign endpoint uses our topic with another type");
  counters.bad("malformed", network.malformed, "received samples are not valid CDR of their type");
  for (const TopicStatistics& topic : network.topics) {
    counters.normal(topic.topic + " written", topic.written);
    counters.normal(topic.topic + " unread", topic.unread);
    counters.normal(topic.topic + " replaced", topic.replaced);
    counters.normal(topic.topic + " limited", topic.limited);
    counters.bad(topic.topic + " blocked", topic.blocked, "a reader does not keep up");
    counters.bad(topic.topic + " failed", topic.failed, topic.last_error);
  }
  return diagnostic;
}

const DiagnosticsMessage& DiagnosticsComposer::compose(std::vector<Diagnostic> diagnostics,
                                                       const TimeMessage& stamp) {
  diagnostics_ = std::move(diagnostics);
  values_.clear();
  for (Diagnostic& diagnostic : diagnostics_) {
    for (auto& [key, value] : diagnostic.values) values_.push_back({key.data(), value.data()});
  }
  entries_.clear();
  auto* next = values_.data();
  for (Diagnostic& diagnostic : diagnostics_) {
    const auto count = static_cast<std::uint32_t>(diagnostic.values.size());
    entries_.push_back({static_cast<std::uint8_t>(diagnostic.level),
                        diagnostic.name.data(),
                        diagnostic.message.data(),
                        hardware_id_.data(),
                        {count, count, next, false}});
    next += count;
  }
  const auto count = static_cast<std::uint32_t>(entries_.size());
  message_.header = {stamp, frame_id_.data()};
  message_.status = {count, count, entries_.data(), false};
  return message_;
}

}  // namespace orbwatch::app::dds
