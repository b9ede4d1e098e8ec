// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include "hal/lines/line.h"
#include "hal/lines/pulse_output.h"
#include "hal/lines/watchdog_output.h"
#include "proc/settings/settings.h"

namespace orbwatch::app {

enum class LineUse { TriggerIn, ProcessInput, TriggerOut, Strobe, ProcessOk, Alarm, Stop };

constexpr bool is_input(LineUse use) {
  return use == LineUse::TriggerIn || use == LineUse::ProcessInput || use == LineUse::Stop;
}
constexpr bool is_pulsed(LineUse use) {
  return use == LineUse::TriggerOut || use == LineUse::Strobe;
}
constexpr bool is_watchdog(LineUse use) {
  return use == LineUse::ProcessOk || use == LineUse::Alarm;
}

enum class LineKind { Gpio, Simulated };

/// The trigger_source of a camera that is triggered by commands only; no line may have this name.
inline constexpr const char* kSoftwareSource = "software";

/// A digital input or output and its use.
struct LineSettings {
  std::string name;
  LineUse use = LineUse::TriggerIn;
  LineKind back_end = LineKind::Gpio;
  hal::InputSettings wire;         ///< also used for outputs, except the debounce time
  std::string source;              ///< trigger_in line that starts pulses; empty: none
  double rate = 0;                 ///< pulses per second; 0: by source or command
  hal::PulseSettings pulse;        ///< its period is derived from the rate
  double toggle_rate = 0;          ///< toggles per second; 0: held
  hal::WatchdogSettings watchdog;  ///< its half-period is derived from the toggle rate
  hal::Clock::duration hold = std::chrono::seconds(2);  ///< time until an active stop line counts
  bool power_off = true;  ///< a stop by the line also powers the machine off
};

inline constexpr std::array kLineUses{Word{"trigger_in", LineUse::TriggerIn},
                                      Word{"process_input", LineUse::ProcessInput},
                                      Word{"trigger_out", LineUse::TriggerOut},
                                      Word{"strobe", LineUse::Strobe},
                                      Word{"process_ok", LineUse::ProcessOk},
                                      Word{"alarm", LineUse::Alarm},
                                      Word{"stop", LineUse::Stop}};
inline constexpr std::array kLineKinds{Word{"gpio", LineKind::Gpio},
                                       Word{"simulated", LineKind::Simulated}};
inline constexpr std::array kLineBiases{
    Word{"as_is", hal::LineBias::AsIs}, Word{"disabled", hal::LineBias::Disabled},
    Word{"pull_up", hal::LineBias::PullUp}, Word{"pull_down", hal::LineBias::PullDown}};

/// Keys of trigger_out and strobe.
template <class Visitor>
void visit_pulses(Visitor& v, LineSettings& line) {
  const bool pulsed = is_pulsed(line.use);
  const char* const pulses = "trigger_out and strobe";
  v.optional_if(
      pulsed, pulses, "source", line.source,
      "Name of a trigger_in line whose active edges start the pulse, for trigger_out and strobe");
  v.optional_if(
      line.use == LineUse::TriggerOut, "trigger_out", "rate", line.rate, Range::between(0, 1000),
      "Pulses per second, for trigger_out; 0: only source or the command pulse start one");
  v.optional_if(pulsed, pulses, "width_us", line.pulse.width, Microseconds{Range::between(10, 1e7)},
                "Length of the pulse, us, for trigger_out and strobe");
  v.optional_if(pulsed, pulses, "delay_us", line.pulse.delay, Microseconds{Range::between(0, 1e7)},
                "Delay from the edge to the pulse, us, for trigger_out and strobe");
  v.require(line.use != LineUse::Strobe || !line.source.empty(), "source", "a strobe needs source");
  v.require(line.source.empty() || line.rate <= 0, "rate", "must be 0 when source is set");
  v.require(line.rate * std::chrono::duration<double>(line.pulse.width).count() < 1, "width_us",
            "a pulse must be shorter than the period of the rate");
}

/// Keys of stop.
template <class Visitor>
void visit_stop(Visitor& v, LineSettings& line) {
  const bool is_stop = line.use == LineUse::Stop;
  v.optional_if(is_stop, "stop", "hold_ms", line.hold, Milliseconds{Range::between(10, 600000)},
                "Time for which the line must be active, for stop");
  v.optional_if(is_stop, "stop", "power_off", line.power_off,
                "The service also powers the machine off, for stop; else it stays stopped");
}

template <class Visitor>
void visit(Visitor& v, LineSettings& line) {
  hal::LineAddress& address = line.wire.address;
  v.required("name", line.name, "Name by which cameras and other lines refer to it");
  v.required(
      "use", line.use, kLineUses,
      "trigger_in: its edges trigger cameras and pulses; process_input: a state of the "
      "machine; trigger_out, strobe: pulses; process_ok: active while the pipeline works; "
      "alarm: active while there is no alarm and the appliance is neither degraded nor in "
      "fault. These two become inactive when the pipeline stops. stop: an input, for example "
      "of an uninterruptible supply, that ends orbwatchd in good order. It must have been "
      "inactive once since the start");
  v.optional("back_end", line.back_end, kLineKinds,
             "gpio: a line of the kernel; simulated: an input and an output with the same "
             "line_name are connected");
  v.optional("line_name", address.name, "Line name of the board, as gpioinfo shows it");
  v.optional("chip", address.chip,
             "Label of the line's chip, as gpiodetect shows it; instead of line_name");
  v.optional("offset", address.offset, Range::between(0, 65535), "Number of the line on that chip");
  v.optional("active_low", line.wire.active_low, "The line is active when the wire is low");
  v.optional("bias", line.wire.bias, kLineBiases,
             "Pull resistor of the chip, which holds the wire while nothing drives it");
  v.optional_if(is_input(line.use), "inputs", "debounce_us", line.wire.debounce,
                Microseconds{Range::between(0, 1e7)},
                "Shortest change that is detected, us; for inputs");
  visit_pulses(v, line);
  const char* const watchdogs = "process_ok and alarm";
  v.optional_if(is_watchdog(line.use), watchdogs, "timeout_ms", line.watchdog.timeout,
                Milliseconds{Range::between(200, 60000)},
                "Time without a pipeline status after which the line becomes inactive, for "
                "process_ok and alarm");
  v.optional_if(is_watchdog(line.use), watchdogs, "toggle_rate", line.toggle_rate,
                Range::between(0, 1000),
                "Toggle frequency in 1/s while active, for process_ok and alarm; 0: held");
  visit_stop(v, line);
  v.require(address.name.empty() != address.chip.empty(), "line_name",
            "set either line_name, or chip and offset");
}

}  // namespace orbwatch::app
