#include "app/daemon/lines.h"

#include <algorithm>
#include <set>

#include "app/log.h"
#include "hal/lines/gpio_lines.h"
#include "hal/lines/simulated_lines.h"

namespace orbwatch::app {
namespace {

hal::Clock::duration microseconds(double value) {
  return std::chrono::duration_cast<hal::Clock::duration>(
      std::chrono::duration<double, std::micro>(value));
}

hal::LineAddress address_of(const LineSettings& settings) {
  return {settings.line_name, settings.chip, static_cast<unsigned>(settings.offset)};
}

/// The simulated chip has the lines that are named, each once.
std::unique_ptr<hal::LineBackEnd> make_simulated(const std::vector<LineSettings>& settings) {
  std::set<std::string> names;
  for (const LineSettings& line : settings) {
    if (line.back_end == LineKind::Simulated && !line.line_name.empty()) {
      names.insert(line.line_name);
    }
  }
  return std::make_unique<hal::SimulatedLines>(
      std::vector<std::string>(names.begin(), names.end()));
}

/// Some limit of the alarms, not only one of the warnings, was passed.
bool has_alarm(const Status& status) {
  return std::any_of(status.alarms.begin(),
                     status.alarms.begin() + static_cast<std::ptrdiff_t>(status.alarm_count),
                     [](const AlarmStatus& alarm) {
                       return is_active(alarm.alarm.state) && severity(alarm.alarm.announced) == 2;
                     });
}

void log_fault(const std::string& name, const hal::LineFaultReport& report) {
  log_line(report.fault == hal::LineFault::None ? LogLevel::Info : LogLevel::Warning,
           name + ": " + std::string(operator_text(report.fault)) +
               (report.detail.empty() ? "" : " (" + report.detail + ")"));
}

}  // namespace

Result<std::unique_ptr<Lines>> Lines::open(const std::vector<LineSettings>& settings) {
  std::unique_ptr<Lines> lines(new Lines());
  lines->gpio_ = std::make_unique<hal::GpioLines>();
  lines->simulated_ = make_simulated(settings);
  // Inputs first: outputs may follow them.
  if (auto opened = lines->open_inputs(settings); !opened) return tl::unexpected(opened.error());
  for (const LineSettings& line : settings) {
    if (is_input(line.use)) continue;
    if (auto opened = lines->open_output(line); !opened) return tl::unexpected(opened.error());
  }
  return lines;
}

Lines::~Lines() { thread_.stop(); }

hal::LineBackEnd& Lines::back_end(LineKind kind) {
  return kind == LineKind::Gpio ? *gpio_ : *simulated_;
}

/// Of a name that is among them, as the configuration's checks saw to.
hal::WatchedInput& Lines::input(const std::string& name) {
  return *std::ranges::find(inputs_, name, &Input::name)->line;
}

Result<> Lines::open_inputs(const std::vector<LineSettings>& settings) {
  for (const LineSettings& line : settings) {
    if (!is_input(line.use)) continue;
    const hal::InputSettings wanted{address_of(line), line.active_low, line.bias,
                                    microseconds(line.debounce_us)};
    auto opened = hal::WatchedInput::open(
        back_end(line.back_end), wanted,
        [name = line.name](const hal::LineFaultReport& report) { log_fault(name, report); });
    if (!opened) return tl::unexpected(opened.error());
    thread_.watch(**opened);
    if (line.use == LineUse::ProcessInput) {
      const auto state =
          std::make_shared<hal::ProcessInput>((*opened)->initial_level(), hal::Clock::now());
      (*opened)->hear([state](const hal::EdgeEvent& edge) { state->take(edge); });
      process_inputs_.push_back(state);
    }
    inputs_.push_back({line.name, std::move(*opened)});
  }
  return {};
}

Result<> Lines::open_output(const LineSettings& settings) {
  auto output = back_end(settings.back_end)
                    .open_output({address_of(settings), settings.active_low, settings.bias});
  if (!output) return tl::unexpected(output.error());
  if (is_pulsed(settings.use)) {
    open_pulses(settings, std::move(*output));
  } else {
    open_watchdog(settings, std::move(*output));
  }
  return {};
}

void Lines::open_pulses(const LineSettings& settings, std::unique_ptr<hal::DigitalOutput> output) {
  hal::PulseOutput::Outputs outputs;
  outputs.push_back(std::move(output));
  const auto period =
      settings.rate > 0 ? microseconds(1e6 / settings.rate) : hal::Clock::duration(0);
  auto& pulses = pulses_.emplace_back(std::make_unique<hal::PulseOutput>(
      hal::PulseSettings{period, microseconds(settings.delay_us), microseconds(settings.width_us)},
      std::move(outputs), [this] { thread_.ring(); }));
  thread_.add(*pulses);
  if (settings.use == LineUse::TriggerOut) trigger_outputs_.push_back(pulses.get());
  if (settings.source.empty()) return;
  input(settings.source).hear([pulse = pulses.get()](const hal::EdgeEvent& edge) {
    if (edge.edge == hal::Edge::Rising) pulse->fire(edge.stamp);
  });
}

void Lines::open_watchdog(const LineSettings& settings,
                          std::unique_ptr<hal::DigitalOutput> output) {
  const auto half_period = settings.toggle_rate > 0 ? microseconds(0.5e6 / settings.toggle_rate)
                                                    : hal::Clock::duration(0);
  auto& outputs = settings.use == LineUse::Alarm ? alarms_ : process_ok_;
  outputs.push_back(std::make_unique<hal::WatchdogOutput>(
      hal::WatchdogSettings{microseconds(1e3 * settings.timeout_ms), half_period},
      std::move(output), [this] { thread_.ring(); }));
  thread_.add(*outputs.back());
}

std::shared_ptr<hal::FrameTrigger> Lines::trigger(const CameraSettings& settings,
                                                  hal::Camera& camera) {
  if (settings.trigger_mode == hal::TriggerMode::Off) return triggers_.emplace_back();
  hal::TriggerSettings wanted;
  wanted.mode = settings.trigger_mode;
  wanted.activation = settings.trigger_activation;
  wanted.delay = microseconds(settings.trigger_delay_us);
  auto trigger =
      std::make_shared<hal::FrameTrigger>(wanted, [&camera] { return camera.trigger(); });
  if (settings.trigger_source != kSoftwareSource) {
    input(settings.trigger_source).hear([trigger](const hal::EdgeEvent& edge) {
      trigger->take(edge);
    });
  }
  thread_.add(*trigger);
  triggers_.push_back(trigger);
  return trigger;
}

CommandResult Lines::command(const Command& command) {
  if (command.code == CommandCode::Trigger) {
    const auto now = hal::Clock::now();  // one for all: they may belong to one frame set
    for (const auto& trigger : triggers_) {
      if (trigger) trigger->fire(now);
    }
    thread_.ring();
    return CommandResult::Done;
  }
  if (command.code != CommandCode::Pulse) return CommandResult::UnknownCommand;
  if (whole(command, 0) >= trigger_outputs_.size()) return CommandResult::ArgumentOutOfRange;
  hal::PulseOutput& output = *trigger_outputs_[whole(command, 0)];
  return output.fire(hal::Clock::now()) ? CommandResult::Done : CommandResult::Busy;
}

void Lines::accept(const Status& status) {
  const auto now = hal::Clock::now();
  const bool works = status.state != SystemState::Starting && status.state != SystemState::Fault;
  const bool sound = works && status.state != SystemState::Degraded && !has_alarm(status);
  for (const auto& line : process_ok_) line->report(works, now);
  for (const auto& line : alarms_) line->report(sound, now);
}

}  // namespace orbwatch::app
