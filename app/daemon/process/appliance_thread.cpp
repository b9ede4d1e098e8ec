// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/process/appliance_thread.h"

#include <string>
#include <thread>
#include <utility>

#include "app/daemon/configuration/configuration_choice.h"
#include "app/daemon/configuration/installed_configuration.h"
#include "app/daemon/device/device_programs.h"
#include "app/daemon/device/image_update.h"
#include "app/daemon/device/pending_restore.h"
#include "app/daemon/process/run_records.h"
#include "app/daemon/site/interfaces.h"
#include "app/log.h"
#include "app/service/progress_notice.h"
#include "app/service/service_manager.h"
#include "app/state/state_folder.h"
#include "app/version.h"

namespace orbwatch::app::daemon {
namespace {

void notify_of(bool restarts) { restarts ? notify_restart() : notify_end(); }

/// Not open: this is no service, or the folder cannot be written.
Result<hal::FileDescriptor> reserve_service_folder() {
  const auto folder = service_folder();
  return folder ? reserve(*folder) : hal::FileDescriptor();
}

/// The notice is one of its watchers if someone reads it.
Result<> start_noticed(Appliance& appliance, ProgressNotice& notice) {
  if (!has_service_manager()) return appliance.start();
  return notice.start().and_then([&] { return appliance.start({&notice}); });
}

/// Free space that the recorder leaves on its disk, bytes.
std::uint64_t reserve_of(const files::Resolved& site) {
  const int reserve_mib = std::get<RecorderSettings>(site.site.sinks).reserve_mib;
  return static_cast<std::uint64_t>(reserve_mib) << 20;
}

/// Null: without a state folder of its own nothing can be made or restored.
std::shared_ptr<DeviceFiles> device_files(const std::filesystem::path& config,
                                          const files::Resolved& site, RestartWatch& restarts) {
  if (site.state_folder.empty()) return nullptr;
  return std::make_shared<DevicePrograms>(
      config, site.state_folder, [&restarts] { restarts.restart(); },
      backup_reserve(std::get<RecorderSettings>(site.site.sinks)));
}

/// Null: this computer does not run an image.
std::shared_ptr<DeviceUpdate> device_update(const files::Resolved& site,
                                            const std::function<void()>& restart_device) {
  const update::ImageFiles image;
  if (site.state_folder.empty() || !image.version()) return nullptr;
  return std::make_shared<ImageUpdate>(ImageUpdate::Settings{.image = image,
                                                             .folder = site.state_folder / "update",
                                                             .reserve = reserve_of(site),
                                                             .restart_device = restart_device});
}

}  // namespace

ApplianceThread::ApplianceThread(Context context) : context_(std::move(context)) {}

void ApplianceThread::start() {
  thread_.start("appliance", [this] {
    result_ = run();
    ended_.set();
    context_.on_end();
  });
}

Result<> ApplianceThread::run() {
  complete_restore(context_.file);
  const auto reserved = reserve_service_folder();
  if (!reserved) return tl::unexpected(reserved.error());
  const auto chosen = choose(context_.file);
  if (!chosen) return tl::unexpected(chosen.error());
  RestartWatch& restarts = context_.restarts;
  restarts.begin(*chosen);
  remove_leftovers(chosen->site);
  record_outputs(chosen->site);
  ProgressNotice notice(chosen->refusal, context_.is_supervised);  // outlives the run
  const auto files = std::make_shared<InstalledConfiguration>(context_.file, *chosen);
  auto appliance = Appliance::make(
      chosen->site,
      {[&restarts] { return restarts.check(); }, [&restarts] { restarts.restart(); },
       [&restarts] { return restarts.trial_end(); }},
      [&](const CalibrationEntry& entry) {
        return check_acceptance(context_.file, chosen->site, entry);
      },
      {files, context_.log, versions("orbwatchd"), commanders_text(chosen->site.site.sinks),
       device_files(context_.file, chosen->site, restarts),
       device_update(chosen->site, context_.restart_device)});
  if (!appliance) return tl::unexpected(appliance.error());
  if (!chosen->refusal.empty()) (*appliance)->report_refused_configuration();
  (*appliance)->on_stop_line(context_.on_stop_line);
  publish(appliance->get());
  if (auto started = start_noticed(**appliance, notice); !started) {
    publish(nullptr);
    return started;
  }
  for (const std::string& line : (*appliance)->assumptions()) log_line(LogLevel::Info, line);
  keep(*chosen);
  restarts.begin_run();
  if (chosen->trial) files->set_trial_end(restarts.trial_end());
  warn_of_refusal(*chosen);
  serve(**appliance);
  notify_of(restarts_);
  publish(nullptr);
  return {};
}

/// Takes up what is missing until the end is asked for.
void ApplianceThread::serve(Appliance& appliance) {
  Attempts& attempts = appliance.attempts();
  while (!is_ending_) {
    thread_.wait_until(attempts.due());
    if (!is_ending_) attempts.run(hal::Clock::now());
  }
}

/// Null: its end begins, in which its lines are still set inactive.
void ApplianceThread::publish(Appliance* appliance) {
  const std::lock_guard lock(mutex_);
  appliance_ = appliance;
  if (appliance != nullptr) lines_ = appliance->lines();
}

void ApplianceThread::report_refusal() {
  const std::lock_guard lock(mutex_);
  if (appliance_ != nullptr) appliance_->report_refused_configuration();
}

bool ApplianceThread::end(bool restarts, std::chrono::milliseconds patience) {
  restarts_ = restarts;
  is_ending_ = true;
  thread_.wake();
  return ended_.wait_for(patience);
}

bool ApplianceThread::abandon(bool restarts, std::chrono::milliseconds patience) {
  const auto done = std::make_shared<Completion>();
  std::weak_ptr<Lines> weak;
  {
    const std::lock_guard lock(mutex_);
    weak = lines_;
  }
  std::thread([done, weak, restarts] {
    if (const auto lines = weak.lock()) lines->make_safe();
    notify_of(restarts);
    done->set();
  }).detach();
  return done->wait_for(patience);
}

}  // namespace orbwatch::app::daemon
