// SPDX-License-Identifier: Apache-2.0
#include "app/ports/console/console_sink.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "app/model/status/readings.h"

namespace orbwatch::app {
namespace {

/// Text such as "frames_per_second 15.2 1/s", without the unit if the name ends with it.
std::string named_value(const Reading& reading) {
  char text[32];
  const bool whole = reading.value == std::floor(reading.value);
  std::snprintf(text, sizeof text, whole ? "%.0f" : "%.5g", reading.value);
  std::string value = std::string(reading.name) + " " + text;
  if (!reading.unit.empty() && !reading.name.ends_with("_" + std::string(reading.unit))) {
    value += " " + std::string(reading.unit);
  }
  return value;
}

/// Selects the main ones of a region's many signals.
bool is_shown(const Component& component, const Reading& reading) {
  if (!signals::is_valid(reading.value)) return false;
  if (component.kind != "region" || reading.name == "quality") return true;
  return std::ranges::any_of(signals::kMainSignals, [&](const auto& main) {
    return std::ranges::find(signals::kSignals, main.value, &signals::SignalInfo::member)->name ==
           reading.name;
  });
}

/// "camera front: camera delivers, frames_per_second 15.2 1/s, frames 300"; values of 0 are
/// omitted.
std::string line_of(const ComponentReadings& entry) {
  const auto& [component, readings] = entry;
  std::string values;
  for (const Reading& reading : readings) {
    if (!is_shown(component, reading)) continue;
    const bool is_state = values.empty() && !reading.text.empty();
    if (reading.value == 0 && !is_state) continue;
    values += values.empty() ? " " : ", ";
    if (is_state) {
      values += reading.text;
    } else if (reading.text.empty()) {
      values += named_value(reading);
    } else {
      values += reading.name;
      if (reading.text != "true") values += " " + std::string(reading.text);
    }
  }
  std::string line(component.kind);
  if (!component.name.empty()) line += " " + component.name;
  return line + ":" + values;
}

}  // namespace

ConsoleSink::ConsoleSink(ConsoleSettings settings, StatusNames names, int file)
    : settings_(settings), names_(std::move(names)), out_(file) {}

ConsoleSink::~ConsoleSink() { stop(); }

Result<> ConsoleSink::start() {
  const auto period = std::chrono::duration_cast<hal::Clock::duration>(
      std::chrono::duration<double>(settings_.period));
  started_ = hal::Clock::now();
  thread_.start("console", hal::ThreadRole::Background, [this, period] {
    for (auto due = started_ + period; thread_.wait_until(due); due += period) print("", due);
  });
  return {};
}

void ConsoleSink::accept(const Status& status) {
  const std::lock_guard lock(mutex_);
  status_ = status;
}

void ConsoleSink::print(std::string_view heading, hal::TimePoint now) {
  Status status;
  {
    const std::lock_guard lock(mutex_);
    status = status_;
  }
  std::string text =
      std::string(heading) + "after " +
      std::to_string(std::chrono::round<std::chrono::seconds>(now - started_).count()) + " s\n";
  for (const auto& entry : status_readings({status, names_, now, {}})) {
    text += "  " + line_of(entry) + "\n";
  }
  if (!out_.write(text)) ++dropped_;
}

std::vector<InterfaceMetric> ConsoleSink::metrics() const {
  std::vector<InterfaceMetric> all;
  add_metrics(all, {"console"}, ConsoleCounts{dropped_}, {});
  return all;
}

void ConsoleSink::stop() {
  if (!thread_.is_running()) return;
  thread_.stop();
  print("at the end, ", hal::Clock::now());
}

std::unique_ptr<Sink> make_sink(const ConsoleSettings& settings, const StatusNames& names) {
  if (!settings.enabled) return nullptr;
  return std::make_unique<ConsoleSink>(settings, names, STDOUT_FILENO);
}

}  // namespace orbwatch::app
