// SPDX-License-Identifier: Apache-2.0
#include "app/ports/lines/lines.h"

#include <algorithm>
#include <set>
#include <utility>

#include "app/log.h"
#include "app/model/status/condition.h"
#include "hal/lines/gpio/gpio_lines.h"
#include "hal/lines/watched_output.h"

namespace orbwatch::app {
namespace {

/// A simulated chip with each configured line name once.
std::unique_ptr<hal::LineBackEnd> make_simulated(
    const std::vector<LineSettings>& settings,
    const hal::SimulatedLines::IsConnected& is_connected) {
  std::set<std::string> names;
  for (const LineSettings& line : settings) {
    if (line.back_end == LineKind::Simulated && !line.wire.address.name.empty()) {
      names.insert(line.wire.address.name);
    }
  }
  return std::make_unique<hal::SimulatedLines>(std::vector<std::string>(names.begin(), names.end()),
                                               nullptr, is_connected);
}

/// Bit of a line in Lines::faults().
constexpr std::uint32_t fault_bit(std::size_t index) { return std::uint32_t{1} << index; }

/// Logs a change of a line's fault, on the line thread. `before`: the previous fault.
void log_fault(const std::string& name, hal::LineFault before, const hal::LineFaultReport& report) {
  const bool is_cleared = report.fault == hal::LineFault::None;
  const bool has_detail = !report.detail.empty();
  log_soon(is_cleared ? LogLevel::Info : LogLevel::Warning,
           {name, ": ", operator_text(report.fault), has_detail ? " (" : "", report.detail,
            has_detail ? ")" : ""},
           {.fault = word(is_cleared ? before : report.fault)});
}

}  // namespace

Lines::Lines(const std::vector<LineSettings>& settings,
             const hal::SimulatedLines::IsConnected& is_connected)
    : gpio_(std::make_unique<hal::GpioLines>()),
      simulated_(make_simulated(settings, is_connected)) {
  // Inputs are opened first, because outputs may refer to them as source.
  for (std::size_t i = 0; i < settings.size(); ++i) {
    if (is_input(settings[i].use)) open_input(i, settings[i]);
  }
  for (std::size_t i = 0; i < settings.size(); ++i) {
    if (!is_input(settings[i].use)) open_output(i, settings[i]);
  }
}

Lines::~Lines() { stop(); }

Result<> Lines::start() {
  const std::lock_guard lock(running_);
  for (const auto& asking : asking_) {
    if (auto started = asking->start("trigger"); !started) return started;
  }
  return thread_.has_work() ? thread_.start() : Result<>();
}

void Lines::stop() {
  const std::lock_guard lock(running_);
  stop_threads();
}

void Lines::make_safe() {
  const std::lock_guard lock(running_);
  stop_threads();
  // An output that refuses already has a fault.
  for (hal::DigitalOutput* const output : outputs_) static_cast<void>(output->set(false));
}

/// Stops the threads; the caller holds running_.
void Lines::stop_threads() {
  thread_.stop();
  for (const auto& asking : asking_) asking->stop();
}

hal::LineBackEnd& Lines::back_end(LineKind kind) {
  return kind == LineKind::Gpio ? *gpio_ : *simulated_;
}

/// `name` exists: the configuration was checked.
hal::WatchedInput& Lines::input(const std::string& name) {
  return *std::ranges::find(inputs_, name, &Input::name)->line;
}

/// Returns the fault handler of a line; called on the line thread once it runs.
hal::LineRetry::OnFault Lines::on_fault(std::size_t index, const std::string& name) {
  return [this, bit = fault_bit(index), name,
          before = hal::LineFault::None](const hal::LineFaultReport& report) mutable {
    if (report.fault == hal::LineFault::None) {
      faults_ &= ~bit;
    } else {
      faults_ |= bit;
    }
    log_fault(name, std::exchange(before, report.fault), report);
  };
}

void Lines::open_input(std::size_t index, const LineSettings& settings) {
  auto line =
      std::make_unique<hal::WatchedInput>(back_end(settings.back_end), settings.wire,
                                          on_fault(index, settings.name), hal::Clock::now());
  thread_.watch(*line);
  if (settings.use == LineUse::ProcessInput) process_inputs_.push_back(line->state());
  if (settings.use == LineUse::Stop) add_stop(settings, *line);
  inputs_.push_back({settings.name, std::move(line)});
}

void Lines::add_stop(const LineSettings& settings, hal::WatchedInput& line) {
  auto& held = stops_.emplace_back(std::make_unique<hal::HeldInput>(
      settings.hold, line.state(), [this, name = settings.name, power_off = settings.power_off] {
        on_stop_line_(name, power_off);
      }));
  line.subscribe([held = held.get()](const hal::EdgeEvent& edge) { held->on_edge(edge); });
  thread_.add(*held);
}

void Lines::open_output(std::size_t index, const LineSettings& settings) {
  const hal::InputSettings& wire = settings.wire;
  auto output = std::make_unique<hal::WatchedOutput>(
      back_end(settings.back_end), hal::OutputSettings{wire.address, wire.active_low, wire.bias},
      on_fault(index, settings.name), hal::Clock::now());
  thread_.add(*output);
  outputs_.push_back(output.get());
  if (is_pulsed(settings.use)) {
    add_pulses(index, settings, std::move(output));
  } else {
    add_watchdog(settings, std::move(output));
  }
}

void Lines::add_pulses(std::size_t index, const LineSettings& settings,
                       std::unique_ptr<hal::DigitalOutput> output) {
  hal::PulseOutput::Outputs outputs;
  outputs.push_back(std::move(output));
  hal::PulseSettings pulse = settings.pulse;
  pulse.period = hal::period_of(settings.rate);
  auto& pulses = pulses_.emplace_back(
      std::make_unique<hal::PulseOutput>(pulse, std::move(outputs), [this] { thread_.wake(); }));
  thread_.add(*pulses);
  if (settings.use == LineUse::TriggerOut) {
    trigger_outputs_.push_back({pulses.get(), fault_bit(index)});
  }
  if (settings.source.empty()) return;
  input(settings.source).subscribe([pulse = pulses.get()](const hal::EdgeEvent& edge) {
    if (edge.edge == hal::Edge::Rising) pulse->fire(edge.stamp);
  });
}

void Lines::add_watchdog(const LineSettings& settings, std::unique_ptr<hal::DigitalOutput> output) {
  hal::WatchdogSettings watchdog = settings.watchdog;
  watchdog.half_period = hal::period_of(2 * settings.toggle_rate);
  auto& outputs = settings.use == LineUse::Alarm ? alarms_ : process_ok_;
  outputs.push_back(std::make_unique<hal::WatchdogOutput>(watchdog, std::move(output),
                                                          [this] { thread_.wake(); }));
  thread_.add(*outputs.back());
}

std::shared_ptr<hal::FrameTrigger> Lines::trigger(const hal::TriggerSettings& settings,
                                                  const std::string& source, hal::Camera& camera) {
  if (settings.mode == hal::TriggerMode::Off) return triggers_.emplace_back();
  auto trigger =
      std::make_shared<hal::FrameTrigger>(settings, [&camera] { return camera.trigger(); });
  hal::LineThread* asking = nullptr;
  if (settings.mode == hal::TriggerMode::Software) {
    asking = asking_.emplace_back(std::make_unique<hal::LineThread>()).get();
    asking->add(*trigger);
  }
  if (source != kSoftwareSource) {
    input(source).subscribe([trigger, asking](const hal::EdgeEvent& edge) {
      trigger->on_edge(edge);
      if (asking) asking->wake();
    });
  }
  triggers_.push_back(trigger);
  return trigger;
}

void Lines::trigger() {
  // the same for all, because the frames may belong to one frame set
  const auto now = hal::Clock::now();
  for (const auto& trigger : triggers_) {
    if (trigger) trigger->fire(now);
  }
  for (const auto& asking : asking_) asking->wake();
}

CommandResult Lines::pulse(std::size_t output) {
  if (output >= trigger_outputs_.size()) return CommandResult::ArgumentOutOfRange;
  const auto& [pulses, fault] = trigger_outputs_[output];
  if ((faults_ & fault) != 0) return CommandResult::NotPossible;
  return pulses->fire(hal::Clock::now()) ? CommandResult::Done : CommandResult::Busy;
}

void Lines::accept(const Status& status) {
  const auto now = hal::Clock::now();
  const bool works = status.state != SystemState::Starting && status.state != SystemState::Fault;
  const bool sound =
      works && status.state != SystemState::Degraded && worst_severity(status) != Severity::Alarm;
  for (const auto& line : process_ok_) line->report(works, now);
  for (const auto& line : alarms_) line->report(sound, now);
}

}  // namespace orbwatch::app
