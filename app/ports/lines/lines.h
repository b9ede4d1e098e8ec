#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
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
#include "hal/lines/simulated_lines.h"
#include "hal/lines/watchdog_output.h"

namespace orbwatch::app {

/// The configured lines at run time. As a sink it reports the pipeline's state on the lines
/// process_ok and alarm. Its threads run from start to stop; edges before that are lost. Thread
/// rule: as Sink's; open and trigger before start; make_safe on any.
class Lines : public Sink {
 public:
  /// Opens all lines. One that is not there, or fails later, is a fault and taken up when it comes.
  /// `is_connected`: of the simulated lines; null: all.
  explicit Lines(const std::vector<LineSettings>& settings,
                 const hal::SimulatedLines::IsConnected& is_connected = nullptr);
  ~Lines() override;

  /// Bit n: line n of the configuration has a fault. On any thread.
  std::uint32_t faults() const { return faults_; }

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

  Result<> start() override;
  void stop() override;
  /// Stops, and sets every output inactive, while the owner waits for something else that hangs.
  /// Waits for devices.
  void make_safe();
  void accept(const ViewPtr&) override {}
  void accept(const Status& status) override;

 private:
  struct Input {
    std::string name;
    std::unique_ptr<hal::WatchedInput> line;
  };

  void stop_threads();
  void open_input(std::size_t index, const LineSettings& settings);
  void open_output(std::size_t index, const LineSettings& settings);
  void add_pulses(const LineSettings& settings, std::unique_ptr<hal::DigitalOutput> output);
  void add_watchdog(const LineSettings& settings, std::unique_ptr<hal::DigitalOutput> output);
  hal::LineRetry::OnFault on_fault(std::size_t index, const std::string& name);
  hal::LineBackEnd& back_end(LineKind kind);
  hal::WatchedInput& input(const std::string& name);

  const std::unique_ptr<hal::LineBackEnd> gpio_;
  const std::unique_ptr<hal::LineBackEnd> simulated_;
  std::atomic<std::uint32_t> faults_{0};
  std::vector<Input> inputs_;
  std::vector<std::shared_ptr<const hal::ProcessInput>> process_inputs_;
  std::vector<std::shared_ptr<hal::FrameTrigger>> triggers_;  ///< by camera; null: runs freely
  /// One for each camera that is asked for its frames: it may be slow, and lines wait for nobody.
  std::vector<std::unique_ptr<hal::LineThread>> asking_;
  std::vector<std::unique_ptr<hal::PulseOutput>> pulses_;
  std::vector<hal::PulseOutput*> trigger_outputs_;  ///< of pulses_, in the configuration's order
  std::vector<std::unique_ptr<hal::WatchdogOutput>> process_ok_;
  std::vector<std::unique_ptr<hal::WatchdogOutput>> alarms_;
  std::vector<hal::DigitalOutput*> outputs_;  ///< all
  std::mutex running_;                        ///< held while the threads start or stop
  hal::LineThread thread_;                    ///< stops before the others' end
};

}  // namespace orbwatch::app
