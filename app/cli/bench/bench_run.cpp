// SPDX-License-Identifier: Apache-2.0
#include "app/cli/bench/bench_run.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <system_error>
#include <thread>
#include <tuple>

#include "app/cli/bench/bench_sink.h"
#include "app/daemon/appliance.h"
#include "hal/thread/scheduling.h"

namespace orbwatch::app::cli {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kPoll{20};
constexpr milliseconds kWarmUp{1000};

/// Polls until `done`; false at `end`, or when cancelled.
bool wait_until(const std::function<bool()>& done, hal::TimePoint end,
                const std::atomic<bool>& cancelled) {
  while (!cancelled && hal::Clock::now() < end) {
    if (done()) return true;
    std::this_thread::sleep_for(kPoll);
  }
  return false;
}

std::size_t whole_seconds(hal::Clock::duration time) {
  return static_cast<std::size_t>(std::chrono::floor<std::chrono::seconds>(time).count());
}

std::string format_text(const hal::StreamFormat& format) {
  char rate[32];
  std::snprintf(rate, sizeof rate, "%.4g", format.frame_rate);
  return std::string(info(format.format).name) + " " + std::to_string(format.width) + "x" +
         std::to_string(format.height) + " at " + rate;
}

/// Texts such as "camera front: camera is not connected", for cameras with a fault.
std::string faults_of(const files::Resolved& site, const Status& status) {
  std::string text;
  for (std::size_t i = 0; i < site.site.cameras.size(); ++i) {
    if (status.cameras[i].fault == hal::Fault::None) continue;
    text += (text.empty() ? "camera " : ", camera ") + site.site.cameras[i].name + ": " +
            std::string(operator_text(status.cameras[i].fault));
  }
  return text;
}

/// Figures that are known before the run.
BenchFigures described(const files::Resolved& site, const std::vector<std::string>& notes,
                       const std::vector<hal::StreamFormat>& formats) {
  BenchFigures figures;
  figures.cores = hal::usable_cores().size();
  for (std::size_t i = 0; i < formats.size(); ++i) {
    std::string format = format_text(formats[i]);
    if (i < notes.size()) format += ", " + notes[i];
    figures.cameras.push_back({site.site.cameras[i].name, std::move(format), 0});
  }
  const auto add = [&figures](const pipeline::ViewSettings& view) {
    figures.views.resize(std::max(figures.views.size(), view.index + 1));
    auto& added = figures.views[view.index];
    added.name = view.name;
    added.width = view.width;
    added.height = view.height;
  };
  for (const pipeline::ViewSettings& view : site.site.views) add(view);
  for (const pipeline::Recipe& recipe : site.recipes) {
    for (const pipeline::ViewSettings& view : recipe.views) add(view);
  }
  return figures;
}

/// Frame sets per second that the cameras or the configuration request.
double wanted_rate(const files::Resolved& site, const hal::StreamFormat& pacing,
                   const CameraStatus& camera) {
  const double deadline = std::chrono::duration<double>(site.site.pipeline.deadline).count();
  if (deadline > 0) return 1 / deadline;
  return pacing.frame_rate > 0 ? pacing.frame_rate : camera.frames_per_second;
}

/// Folder beside that of the recordings, so that the run records on the same disk; the system's for
/// temporary files, perhaps in memory, if there is no recorder or that folder cannot be written.
std::filesystem::path place_of_run(const files::Resolved& site, std::error_code& error) {
  const auto& recordings = std::get<RecorderSettings>(site.site.sinks).folder;
  std::error_code unknown;
  std::filesystem::path folder = std::filesystem::weakly_canonical(recordings, unknown);
  if (!folder.has_filename()) folder = folder.parent_path();  // ends with a slash
  folder = folder.parent_path();
  const bool is_usable =
      !recordings.empty() && !unknown && ::access(folder.c_str(), W_OK | X_OK) == 0;
  return is_usable ? folder : std::filesystem::temp_directory_path(error);
}

/// Folder for what the run writes: the machine must not remember its results, and its recordings
/// must not be deleted for those of the run.
class TemporaryState {
 public:
  explicit TemporaryState(const files::Resolved& site) : site_(site) {
    std::string name = (place_of_run(site, error_) / "orbwatch-bench-XXXXXX").string();
    if (!error_ && ::mkdtemp(name.data()) == nullptr) error_.assign(errno, std::generic_category());
    if (!error_) move_to(name);
  }
  TemporaryState(const TemporaryState&) = delete;
  TemporaryState& operator=(const TemporaryState&) = delete;
  ~TemporaryState() {
    if (!error_) std::filesystem::remove_all(site_.state_folder, error_);
  }
  const std::error_code& error() const { return error_; }
  const files::Resolved& site() const { return site_; }

 private:
  void move_to(const std::filesystem::path& folder) {
    site_.state_folder = folder;
    auto& recordings = std::get<RecorderSettings>(site_.site.sinks).folder;
    if (!recordings.empty()) recordings = folder / "recordings";
    auto& snapshots = std::get<SnapshotSettings>(site_.site.sinks).folder;
    if (!snapshots.empty()) snapshots = folder / "snapshots";
  }

  std::error_code error_;
  files::Resolved site_;
};

}  // namespace

Result<BenchFigures> run_bench(const files::Resolved& site, const std::vector<std::string>& notes,
                               const BenchSettings& settings, const BenchWatch& watch) {
  const auto& cancelled = watch.cancelled;
  BenchSink sink(settings.seconds);
  const TemporaryState state(site);
  if (state.error()) return fail("no temporary folder: " + state.error().message());
  auto made = daemon::Appliance::make(state.site(), {[] { return Result<>(); }, [] {}},
                                      [](const CalibrationEntry&) { return Result<>(); });
  if (!made) return tl::unexpected(made.error());
  daemon::Appliance& appliance = **made;
  if (auto started = appliance.start({&sink}); !started) return tl::unexpected(started.error());

  const auto has_news = [&sink] {
    return sink.newest().frame_set > 0 || sink.newest().state == SystemState::Fault;
  };
  watch.progress.begin("waiting for the first frames");
  wait_until(has_news, hal::Clock::now() + settings.patience, cancelled);
  if (cancelled) return fail("cancelled before there were figures");
  if (sink.newest().frame_set == 0) {
    const std::string faults = faults_of(site, sink.newest());
    if (!faults.empty()) return fail("no frame: " + faults);
    return fail("no frame within " + std::to_string(settings.patience.count() / 1000) +
                " s, although no camera has a fault; does a trigger come?");
  }
  watch.progress.begin("warming up");
  wait_until([] { return false; }, hal::Clock::now() + kWarmUp, cancelled);
  const Status status = sink.newest();
  if (const auto faults = faults_of(site, status); !faults.empty()) {
    return fail(faults + "; the figures would be those of the others only");
  }

  BenchFigures figures = described(site, notes, appliance.formats());
  const auto before = thread_loads();
  const auto begin = hal::Clock::now();
  sink.record();
  const auto length = std::chrono::duration_cast<hal::Clock::duration>(
      std::chrono::duration<double>(settings.seconds));
  const auto show = [&] {
    watch.progress.count("measuring", whole_seconds(hal::Clock::now() - begin),
                         whole_seconds(length), "s");
    return false;
  };
  wait_until(show, begin + length, cancelled);
  watch.progress.erase();
  sink.report(figures);
  figures.seconds = std::chrono::duration<double>(hal::Clock::now() - begin).count();
  figures.threads = since(before, thread_loads());
  figures.memory = memory_figures();
  if (figures.frame_sets == 0) return fail("no frame set in the time of the measurement");
  const std::size_t pacing = appliance.pacing_camera();
  figures.wanted_rate =
      wanted_rate(site, appliance.formats()[pacing], sink.newest().cameras[pacing]);
  return figures;
}

}  // namespace orbwatch::app::cli
