// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/alignment/alignment_desk.h"
#include "app/daemon/alignment_record.h"
#include "app/daemon/dispatch.h"
#include "app/daemon/process/attempts.h"
#include "app/daemon/recorded_machine.h"
#include "app/daemon/site/cameras.h"
#include "app/daemon/site/interfaces.h"
#include "app/daemon/site/site_plan.h"
#include "app/files/resolve.h"
#include "app/health/health_sampler.h"
#include "app/machine/machine_follower.h"
#include "app/model/command/restart.h"
#include "app/model/configuration/program.h"
#include "app/pipeline/pipeline.h"
#include "app/ports/lines/lines.h"
#include "app/simulation/simulated_controller.h"
#include "app/state/command_record.h"
#include "app/watch/camera_watch.h"
#include "hal/thread/scheduling.h"
#include "hal/thread/shared_threads.h"

namespace orbwatch::app::daemon {

/// All that runs for a site: lines, cameras and their pipeline, interfaces. What is not there is
/// among the attempts. Thread rule: one owner.
class Appliance {
 public:
  /// Opens the lines and cameras that are there. `site` outlives it and has a state folder.
  /// `program` is for the interfaces. Error: the files.
  static Result<std::unique_ptr<Appliance>> make(const files::Resolved& site, Restart restart,
                                                 AcceptanceCheck check_acceptance,
                                                 Program program = {});
  /// Stops what runs: first the pipeline, which calls the others.
  ~Appliance();
  Appliance(const Appliance&) = delete;
  Appliance& operator=(const Appliance&) = delete;

  /// `watchers` get what the sinks get; they are the caller's and outlive the run. Error: a camera
  /// that is there does not start.
  Result<> start(const std::vector<Sink*>& watchers = {});

  /// What the cameras deliver, or are expected to.
  const std::vector<hal::StreamFormat>& formats() const { return pipeline_->formats(); }
  /// See Pipeline::pacing_camera().
  std::size_t pacing_camera() const { return pipeline_->pacing_camera(); }

  /// Every interface says from now on that the files are wrong and the last good ones run. On any
  /// thread.
  void report_refused_configuration() { configuration_refused_ = true; }

  /// See Lines. Before start.
  void on_stop_line(OnStopLine receiver) { lines_->on_stop_line(std::move(receiver)); }

  /// See assumptions(), for what the cameras delivered at the start.
  const std::vector<std::string>& assumptions() const { return assumptions_; }

  /// What is missing, to be tried again by the owner when it is due.
  Attempts& attempts() { return attempts_; }

  /// Lines for make_safe() on another thread, also while this one's end hangs.
  std::weak_ptr<Lines> lines() const { return lines_; }

 private:
  explicit Appliance(const files::Resolved& site);
  Result<pipeline::PipelinePlan> pipeline_plan(
      const SitePlan& planned, OpenedCameras opened,
      std::shared_ptr<const simulation::Machine> simulated);
  void add_clients(const SitePlan& planned, const Restart& restart,
                   AcceptanceCheck check_acceptance, Program program);
  void add_pipeline(pipeline::PipelinePlan plan, const hal::ThreadGrants& grants, Restart restart);
  std::array<CameraWatchStatus, kMaxCameras> watched() const;
  void follow_machine(pipeline::PipelinePlan& plan,
                      std::shared_ptr<const simulation::Machine> simulated);
  void follow_recording(pipeline::PipelinePlan& plan, std::filesystem::path recording);
  Result<> start_pipeline(const std::vector<Sink*>& watchers);
  void restore();
  void keep_measured_recipe();
  void log_start() const;

  const files::Resolved& site_;
  const AlignedSite aligned_;
  AlignmentRecord accepted_;
  const std::shared_ptr<CommandRecord> record_;
  const std::shared_ptr<hal::SharedThreads> background_;
  HealthSampler health_;
  machine::MachineFollower machine_;
  std::unique_ptr<RecordedMachine> recorded_machine_;  ///< null: another source
  std::optional<pipeline::Pipeline> pipeline_;  ///< outlives the lines, which trigger its cameras
  const std::shared_ptr<Lines> lines_;
  std::vector<std::string> assumptions_;
  std::vector<hal::Camera*> cameras_;  ///< the pipeline's
  pipeline::CameraSet absent_;
  std::optional<CameraWatch> watch_;
  std::optional<AlignmentDesk> alignment_;
  std::optional<Receivers> receivers_;
  std::optional<Interfaces> interfaces_;
  std::optional<simulation::SimulatedController> controller_;  ///< where it is the source
  Attempts attempts_;
  std::atomic<bool> configuration_refused_{false};  ///< read by the pipeline
};

}  // namespace orbwatch::app::daemon
