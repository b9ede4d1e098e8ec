#include "app/console/console_sink.h"

#include <algorithm>
#include <iomanip>
#include <ostream>
#include <sstream>
#include <utility>

namespace orbwatch::app {
namespace {

std::string number(double value, int digits) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << value;
  return text.str();
}

/// The main figures that have a value, in the list's order.
std::string region_text(const signals::Signals& signals) {
  std::string text;
  for (const auto& main : signals::kMainSignals) {
    const double value = signals.*main.value;
    if (!signals::is_valid(value)) continue;
    const auto& signal =
        *std::ranges::find(signals::kSignals, main.value, &signals::SignalInfo::member);
    text += (text.empty() ? "" : ", ") + std::string(signal.name) + " " + number(value, 1) + " " +
            std::string(signal.unit);
  }
  return text.empty() ? "no measurement" : text;
}

std::string process_text(const Status& status) {
  std::string text = "recipe " + std::to_string(status.recipe);
  for (std::size_t i = 0; i < status.region_count; ++i) {
    text += " | region " + std::to_string(i) + ": " + region_text(status.regions[i].signals);
  }
  return text;
}

std::string camera_text(const std::string& name, const CameraStatus& camera) {
  std::string text = name + " " + number(camera.frames_per_second, 1) + " fps, p50/p99 " +
                     number(camera.latency_p50_ms, 0) + "/" + number(camera.latency_p99_ms, 0) +
                     " ms, lost " + std::to_string(camera.lost) + ", dropped " +
                     std::to_string(camera.dropped);
  if (camera.fault != hal::Fault::None) text += ", " + std::string(operator_text(camera.fault));
  return text;
}

std::string view_text(const std::string& name, const ViewStatus& view) {
  return name + " " + number(view.frames_per_second, 1) + " fps, p50/p99 " +
         number(view.latency_p50_ms, 0) + "/" + number(view.latency_p99_ms, 0) + " ms, skipped " +
         std::to_string(view.skipped);
}

}  // namespace

ConsoleSink::ConsoleSink(ConsoleSettings settings, std::vector<std::string> cameras,
                         std::vector<std::string> views, std::ostream& out)
    : settings_(settings), cameras_(std::move(cameras)), views_(std::move(views)), out_(out) {}

ConsoleSink::~ConsoleSink() { stop(); }

Result<> ConsoleSink::start() {
  started_ = hal::Clock::now();
  thread_ = std::thread([this] { run(); });
  return {};
}

void ConsoleSink::accept(const Status& status) {
  const std::lock_guard lock(mutex_);
  status_ = status;
}

Status ConsoleSink::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

void ConsoleSink::run() {
  const auto period = std::chrono::duration_cast<hal::Clock::duration>(
      std::chrono::duration<double>(settings_.period));
  for (auto due = started_ + period;; due += period) {
    {
      std::unique_lock lock(mutex_);
      if (wake_.wait_until(lock, due, [this] { return stopping_; })) return;
    }
    const Status now = status();
    std::string line = number(std::chrono::duration<double>(due - started_).count(), 0) + " s " +
                       std::string(name_of(now.state));
    for (std::size_t i = 0; i < cameras_.size(); ++i) {
      line += " | " + camera_text(cameras_[i], now.cameras[i]);
    }
    for (std::size_t i = 0; i < views_.size(); ++i) {
      line += " | " + view_text(views_[i], now.views[i]);
    }
    if (cameras_.size() > 1) line += " | skew " + number(now.skew_ms, 1) + " ms";
    line += " | load " + number(100 * now.load, 0) + " %, overruns " + std::to_string(now.overruns);
    out_ << line << " | " << process_text(now) << std::endl;
  }
}

void ConsoleSink::stop() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  thread_.join();
  const Status last = status();
  out_ << "summary: " << last.frame_set << " frame sets, " << last.unmatched << " unmatched, "
       << last.overruns << " overruns\n";
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    const CameraStatus& camera = last.cameras[i];
    out_ << "  camera " << cameras_[i] << ": " << camera.frames << " frames, " << camera.lost
         << " lost, " << camera.dropped << " dropped, " << camera.unmatched << " unmatched, "
         << camera.triggers << " triggers, " << camera.missed << " missed\n";
  }
  for (std::size_t i = 0; i < views_.size(); ++i) {
    out_ << "  view " << views_[i] << ": " << last.views[i].published << " published, "
         << last.views[i].skipped << " skipped\n";
  }
  out_ << "  process: " << process_text(last) << std::endl;
}

}  // namespace orbwatch::app
