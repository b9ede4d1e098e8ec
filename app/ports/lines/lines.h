// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "app/model/command/command.h"
#include "app/model/sink/sink.h"
#include "app/ports/lines/line_settings.h"
#include "hal/camera.h"
#include "hal/lines/frame_trigger.h"
#include "hal/lines/held_input.h"
#include "hal/lines/line_thread.h"
#include "hal/lines/process_input.h"
#include "hal/lines/pulse_output.h"
#include "hal/lines/simulated_lines.h"
#include "hal/lines/watchdog_output.h"

namespace orbwatch::app {

/// Stop that a line of use stop asks for. `line` is its name.
using OnStopLine = std::function<void(const std::string& line, bool power_off)>;

/// The configured lines at run time. As a sink it reports the pipeline's state on the lines
/// process_ok and alarm. Its threads run from start to stop; edges before that are lost. Thread
/// rule: as Sink; open and trigger before start; make_safe on any thread.
class Lines : public Sink {
 public:
  /// Opens all lines. A line that is missing, or fails later, has a fault and is opened again when
  /// it returns. `is_connected`: state of the simulated lines; null: all are connected.
  explicit Lines(const std::vector<LineSettings>& settings,
                 const hal::SimulatedLines::IsConnected& is_connected = nullptr);
  ~Lines() override;

  /// Bit n: line n of the configuration has a fault. On any thread.
  std::uint32_t faults() const { return faults_; }

  /// Assigns the camera's frames to edges of its trigger line; null: the camera runs freely. Called
  /// for the cameras in the configuration's order. `source`: name of the trigger line, or
  /// kSoftwareSource. `camera` outlives the run.
  std::shared_ptr<hal::FrameTrigger> trigger(const hal::TriggerSettings& settings,
                                             const std::string& source, hal::Camera& camera);

  /// Returns whether the camera is triggered.
  bool triggers(std::size_t camera) const { return camera < triggers_.size() && triggers_[camera]; }

  /// Triggers every triggered camera once, like an edge. On any thread; does not wait.
  void trigger();

  /// Emits one pulse on a trigger_out line, by its index among those. ArgumentOutOfRange: no such
  /// line; NotPossible: it has a fault, see faults(); Busy: its last pulse has not ended. On any
  /// thread; does not wait.
  CommandResult pulse(std::size_t output);

  /// Receiver of the requests of stop lines, called on the line thread; must not wait. Before
  /// start.
  void on_stop_line(OnStopLine receiver) { on_stop_line_ = std::move(receiver); }

  /// Process inputs in the configuration's order.
  const std::vector<std::shared_ptr<const hal::ProcessInput>>& process_inputs() const {
    return process_inputs_;
  }

  Result<> start() override;
  void stop() override;
  /// Stops, and sets every output inactive, for use while the owner is blocked by another part.
  /// Waits for devices.
  void make_safe();
  void accept(const ViewPtr&) override {}
  void accept(const Status& status) override;

 private:
  struct Input {
    std::string name;
    std::unique_ptr<hal::WatchedInput> line;
  };

  struct TriggerOutput {
    hal::PulseOutput* pulses;  ///< element of pulses_
    std::uint32_t fault = 0;   ///< its bit in faults_
  };

  void stop_threads();
  void open_input(std::size_t index, const LineSettings& settings);
  void add_stop(const LineSettings& settings, hal::WatchedInput& line);
  void open_output(std::size_t index, const LineSettings& settings);
  void add_pulses(std::size_t index, const LineSettings& settings,
                  std::unique_ptr<hal::DigitalOutput> output);
  void add_watchdog(const LineSettings& settings, std::unique_ptr<hal::DigitalOutput> output);
  hal::LineRetry::OnFault on_fault(std::size_t index, const std::string& name);
  hal::LineBackEnd& back_end(LineKind kind);
  hal::WatchedInput& input(const std::string& name);

  const std::unique_ptr<hal::LineBackEnd> gpio_;
  const std::unique_ptr<hal::LineBackEnd> simulated_;
  std::atomic<std::uint32_t> faults_{0};
  std::vector<Input> inputs_;
  std::vector<std::shared_ptr<const hal::ProcessInput>> process_inputs_;
  /// Triggers by camera; null: runs freely.
  std::vector<std::shared_ptr<hal::FrameTrigger>> triggers_;
  /// One thread for each software-triggered camera, which may be slow, so that lines never wait for
  /// it.
  std::vector<std::unique_ptr<hal::LineThread>> asking_;
  std::vector<std::unique_ptr<hal::PulseOutput>> pulses_;
  std::vector<TriggerOutput> trigger_outputs_;  ///< in the configuration's order
  std::vector<std::unique_ptr<hal::WatchdogOutput>> process_ok_;
  std::vector<std::unique_ptr<hal::WatchdogOutput>> alarms_;
  std::vector<hal::DigitalOutput*> outputs_;  ///< all outputs
  std::vector<std::unique_ptr<hal::HeldInput>> stops_;
  OnStopLine on_stop_line_ = [](const std::string&, bool) {};
  std::mutex running_;      ///< held while the threads start or stop
  hal::LineThread thread_;  ///< stops before the other members are destroyed
};

}  // namespace orbwatch::app
