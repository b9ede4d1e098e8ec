#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/model/command.h"
#include "app/model/sink.h"
#include "app/ports/lines/line_settings.h"
#include "hal/camera.h"
#include "hal/lines/frame_trigger.h"
#include "hal/lines/line_thread.h"
#include "hal/lines/process_input.h"
#include "hal/lines/pulse_output.h"
#include "hal/lines/watchdog_output.h"

namespace orbwatch::app {

/// The configured lines at run time. As a sink it reports the pipeline's state on the lines
/// process_ok and alarm. Its thread runs from start to stop; edges before that are lost. Thread
/// rule: as Sink's; open and trigger before start.
class Lines : public Sink {
 public:
  /// Opens all lines. Errors name the line and the reason.
  static Result<std::unique_ptr<Lines>> open(const std::vector<LineSettings>& settings);
  ~Lines() override;

  /// Joins the camera's trigger line with its frames; null when the camera runs freely. Called for
  /// the cameras in the configuration's order. `source`: name of the trigger line, or
  /// kSoftwareSource. `camera` outlives the run.
  std::shared_ptr<hal::FrameTrigger> trigger(const hal::TriggerSettings& settings,
                                             const std::string& source, hal::Camera& camera);

  /// Whether the camera is triggered.
  bool triggers(std::size_t camera) const { return camera < triggers_.size() && triggers_[camera]; }

  /// An edge for every triggered camera. On any thread; does not wait.
  void trigger();

  /// One pulse on a trigger_out line, by its index among them. ArgumentOutOfRange: no such line;
  /// Busy: its last pulse is not over. On any thread; does not wait.
  CommandResult pulse(std::size_t output);

  /// In the configuration's order.
  const std::vector<std::shared_ptr<const hal::ProcessInput>>& process_inputs() const {
    return process_inputs_;
  }

  Result<> start() override { return thread_.start(); }
  void stop() override { thread_.stop(); }
  void accept(const ViewPtr&) override {}
  void accept(const Status& status) override;

 private:
  struct Input {
    std::string name;
    std::unique_ptr<hal::WatchedInput> line;
  };

  Lines() = default;
  Result<> open_inputs(const std::vector<LineSettings>& settings);
  Result<> open_output(const LineSettings& settings);
  void open_pulses(const LineSettings& settings, std::unique_ptr<hal::DigitalOutput> output);
  void open_watchdog(const LineSettings& settings, std::unique_ptr<hal::DigitalOutput> output);
  hal::LineBackEnd& back_end(LineKind kind);
  hal::WatchedInput& input(const std::string& name);

  std::unique_ptr<hal::LineBackEnd> gpio_;
  std::unique_ptr<hal::LineBackEnd> simulated_;
  std::vector<Input> inputs_;
  std::vector<std::shared_ptr<const hal::ProcessInput>> process_inputs_;
  std::vector<std::shared_ptr<hal::FrameTrigger>> triggers_;  ///< by camera; null: runs freely
  std::vector<std::unique_ptr<hal::PulseOutput>> pulses_;
  std::vector<hal::PulseOutput*> trigger_outputs_;  ///< of pulses_, in the configuration's order
  std::vector<std::unique_ptr<hal::WatchdogOutput>> process_ok_;
  std::vector<std::unique_ptr<hal::WatchdogOutput>> alarms_;
  hal::LineThread thread_;  ///< stops before the others' end
};

}  // namespace orbwatch::app
