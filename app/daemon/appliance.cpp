// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/appliance.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "app/alignment/work_distance.h"
#include "app/daemon/site/assumptions.h"
#include "app/daemon/site/build.h"
#include "app/health/board_health.h"
#include "app/log.h"
#include "proc/remap/remap.h"

namespace orbwatch::app::daemon {
namespace {

/// Folder whose disk is monitored: that of the recorder, else of snapshots; empty: neither.
std::filesystem::path recording_folder(const files::Configuration& configuration) {
  const auto& recorder = std::get<RecorderSettings>(configuration.sinks);
  if (!recorder.folder.empty()) return recorder.folder;
  return std::get<SnapshotSettings>(configuration.sinks).folder;
}

/// Reads the board's health and whether commands are recorded.
std::function<Health()> health_of(const files::Configuration& configuration,
                                  std::shared_ptr<const CommandRecord> record) {
  HealthSources sources;
  if (const auto folder = recording_folder(configuration); !folder.empty()) sources.disk = folder;
  return [record = std::move(record), board = std::make_shared<BoardHealth>(sources)] {
    Health read = board->read();
    read.commands_recorded = record->is_kept() ? 1 : 0;
    return read;
  };
}

/// The part of a site that alignment and watch use.
AlignedSite aligned_site(const files::Resolved& site) {
  AlignedSite aligned{{}, site.rig, site.alignments, site.site.place};
  for (std::size_t i = 0; i < site.site.cameras.size(); ++i) {
    const files::CameraSettings& camera = site.site.cameras[i];
    aligned.cameras.push_back({camera.name, site.rig_cameras[i], camera.watch});
  }
  std::vector<optics::ViewSpec> measured;
  for (const pipeline::Recipe& recipe : site.recipes) {
    for (const auto& view : recipe.views) measured.push_back(view.spec());
  }
  aligned.work_distance = work_distance(site.rig, measured);
  return aligned;
}

/// The lines as configured; simulated ones are connected as the machine's settings say.
std::shared_ptr<Lines> open_lines(const files::Configuration& site) {
  const std::vector<LineSettings> settings{site.lines.begin(), site.lines.end()};
  return std::make_shared<Lines>(settings, [machine = site.simulation](const std::string& line) {
    return simulation::is_connected(machine, line);
  });
}

/// Time until `end`, rounded up to whole seconds and at least 1 s; 0: `end` is max.
std::uint32_t seconds_until(hal::TimePoint end, hal::TimePoint now) {
  if (end == hal::TimePoint::max()) return 0;
  const auto left = std::chrono::ceil<std::chrono::seconds>(end - now).count();
  return static_cast<std::uint32_t>(std::max<std::int64_t>(left, 1));
}

}  // namespace

Appliance::Appliance(const files::Resolved& site)
    : site_(site),
      aligned_(aligned_site(site)),
      accepted_(site),
      record_(std::make_shared<CommandRecord>(site.state_folder)),
      background_(std::make_shared<hal::SharedThreads>(
          hal::SharedThreads::kBackgroundName, hal::ThreadRole::Background,
          static_cast<std::size_t>(site.site.threads.background))),
      health_(health_of(site.site, record_), HealthSampler::kPeriod,
              hal::SharedThreads::alone("health")),
      machine_(site.site.machine),
      lines_(open_lines(site.site)) {}

Appliance::~Appliance() {
  if (pipeline_) {
    keep_measured_recipe();  // before anything that may hang
    pipeline_->stop();
  }
  if (controller_) controller_->stop();
  if (interfaces_) interfaces_->stop();
  if (alignment_) alignment_->stop();
  if (watch_) watch_->stop();
  lines_->stop();
}

Result<std::unique_ptr<Appliance>> Appliance::make(const files::Resolved& site, Restart restart,
                                                   AcceptanceCheck check_acceptance,
                                                   Program program) {
  if (auto checked = hal::check(site.site.threads); !checked) {
    return tl::unexpected(checked.error());
  }
  const hal::ThreadGrants grants = hal::schedule_threads(site.site.threads);
  for (const std::string& refusal : grants.refusals) log_line(LogLevel::Warning, refusal);
  std::unique_ptr<Appliance> made(new Appliance(site));
  auto simulated = simulation::Machine::make(site.site.simulation, hal::Clock::now());
  if (!simulated) return tl::unexpected(simulated.error());
  OpenedCameras opened = open_cameras(site, *simulated);
  const auto planned = SitePlan::make(site, opened.formats);
  if (!planned) return tl::unexpected(planned.error());
  auto plan = made->pipeline_plan(*planned, std::move(opened), std::move(*simulated));
  if (!plan) return tl::unexpected(plan.error());
  made->add_clients(*planned, restart, std::move(check_acceptance), std::move(program));
  made->add_pipeline(std::move(*plan), grants, std::move(restart));
  return made;
}

Result<pipeline::PipelinePlan> Appliance::pipeline_plan(
    const SitePlan& planned, OpenedCameras opened,
    std::shared_ptr<const simulation::Machine> simulated) {
  auto plan = build(site_, planned);
  if (!plan) return plan;
  add_cameras(*plan, std::move(opened), site_, *lines_);
  plan->background = background_;
  follow_machine(*plan, std::move(simulated));
  if (site_.site.machine.source == MachineSource::Recording) {
    auto recording = replayed_recording(site_);
    if (!recording) return tl::unexpected(recording.error());
    follow_recording(*plan, std::move(*recording));
  }
  return plan;
}

/// Watch, alignment and interfaces. Their commands arrive when the pipeline is there.
void Appliance::add_clients(const SitePlan& planned, const Restart& restart,
                            AcceptanceCheck check_acceptance, Program program) {
  // It must not delay the pictures that somebody waits for.
  watch_.emplace(aligned_, site_.state_folder, hal::SharedThreads::alone("watch"));
  alignment_.emplace(aligned_, *watch_, accepted_, restart.request, std::move(check_acceptance));
  assumptions_ = daemon::assumptions(site_, planned);
  const auto carry_out = [this](const Command& command) { return dispatch(command, *receivers_); };
  interfaces_.emplace(site_, planned, CommandPath{carry_out, record_}, machine_.path(), background_,
                      &*alignment_, std::move(program));
}

/// The pipeline, and the receivers of commands.
void Appliance::add_pipeline(pipeline::PipelinePlan plan, const hal::ThreadGrants& grants,
                             Restart restart) {
  plan.surroundings = [this, grants, trial_end = restart.trial_end](hal::TimePoint now) {
    return pipeline::Surroundings{health_.latest(now),    lines_->faults(),
                                  interfaces_->faults(),  grants.realtime,
                                  grants.memory_locked,   watched(),
                                  configuration_refused_, seconds_until(trial_end(), now)};
  };
  absent_ = plan.absent;
  for (const auto& camera : plan.cameras) cameras_.push_back(camera.get());
  pipeline_.emplace(std::move(plan));
  receivers_.emplace(Receivers{*pipeline_, *lines_, interfaces_->find<SnapshotSink>(),
                               interfaces_->find<RecorderSink>(), *watch_, *alignment_,
                               std::move(restart)});
}

void Appliance::follow_machine(pipeline::PipelinePlan& plan,
                               std::shared_ptr<const simulation::Machine> simulated) {
  const MachineSource source = site_.site.machine.source;
  if (source == MachineSource::None || source == MachineSource::Recording) return;
  plan.machine = [this](hal::TimePoint now, const hal::FrameSet* set) -> const MachineStatus& {
    return set ? machine_.follow(set->stamp, set->trigger) : machine_.keep(now);
  };
  if (source != MachineSource::Simulation) return;
  controller_.emplace(std::move(simulated), machine_.path().handler);
}

void Appliance::follow_recording(pipeline::PipelinePlan& plan, std::filesystem::path recording) {
  recorded_machine_ =
      std::make_unique<RecordedMachine>(std::move(recording), site_.site.machine.timeout);
  plan.machine = [this](hal::TimePoint now, const hal::FrameSet* set) -> const MachineStatus& {
    return set ? recorded_machine_->follow(*set) : recorded_machine_->keep(now);
  };
}

/// Selects recipe and state stopped as before a restart of this program, as if they were commanded
/// again.
void Appliance::restore() {
  const Selection selection = record_->selection();
  if (selection.stopped) {
    pipeline_->stop_measuring();
    log_line(LogLevel::Info, "measuring stays stopped, as before the restart");
  }
  if (selection.recipe == 0) return;
  const bool is_there = pipeline_->select_recipe(selection.recipe) == CommandResult::Done;
  const std::string recipe = "recipe " + std::to_string(selection.recipe);
  log_line(is_there ? LogLevel::Info : LogLevel::Warning,
           is_there ? recipe + " is selected, as before the restart"
                    : recipe +
                          ", selected before the restart, is not there any more; begins with "
                          "the first one");
}

/// Records the recipe that is measured in place of the selected one if a camera refused that, so
/// that a restart of this program changes no recipe. The command was answered before the refusal.
void Appliance::keep_measured_recipe() {
  const auto refusal = pipeline_->recipe_refusal();
  if (!refusal) return;
  record_->replace_recipe(static_cast<std::uint16_t>(refusal->wanted),
                          static_cast<std::uint16_t>(refusal->kept));
}

std::array<CameraWatchStatus, kMaxCameras> Appliance::watched() const {
  auto figures = watch_->figures();
  alignment_->report(figures);
  return figures;
}

Result<> Appliance::start(const std::vector<Sink*>& watchers) {
  const auto now = hal::Clock::now();
  restore();  // before a client can give a newer command, and before anything is measured
  attempts_.add(
      "lines", [this] { return lines_->start(); }, now);
  interfaces_->start(attempts_, now);
  if (recorded_machine_) {
    attempts_.add(
        "recorded machine", [this] { return recorded_machine_->load(); }, now);
  }
  health_.start();
  if (controller_) controller_->start();
  alignment_->start();
  if (auto started = start_pipeline(watchers); !started) return started;
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    if (!absent_[i]) continue;
    attempts_.add_camera(
        site_.site.cameras[i].name,
        [this, i] { return reconnect(site_, i, *cameras_[i], *pipeline_); }, now);
  }
  log_start();
  return {};
}

Result<> Appliance::start_pipeline(const std::vector<Sink*>& watchers) {
  std::vector<Sink*> sinks = interfaces_->sinks();
  sinks.insert(sinks.begin(), lines_.get());
  sinks.push_back(&*watch_);
  sinks.insert(sinks.end(), watchers.begin(), watchers.end());
  return pipeline_->start(sinks);
}

void Appliance::log_start() const {
  log_line(LogLevel::Info, "runs with " + std::to_string(site_.names.cameras.size()) +
                               " cameras, " + std::to_string(site_.names.views.size()) +
                               " views and " + std::to_string(site_.recipes.size()) +
                               " recipes, remap kernel " +
                               std::string(remap::default_kernel().name));
  for (const CalibrationEntry& entry : site_.alignments) {
    const std::string camera = camera_of(entry).camera;
    log_line(LogLevel::Info,
             "camera " + camera + ": alignment " + std::to_string(entry.number) + " of " +
                 entry.time + " counts, not the rig file's: " + entry.method,
             {.camera = camera});
  }
  log_line(LogLevel::Info, commanders_text(site_.site.sinks));
}

}  // namespace orbwatch::app::daemon
