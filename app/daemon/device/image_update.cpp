// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/device/image_update.h"

#include <system_error>
#include <utility>

#include "app/daemon/device/uploaded_file.h"
#include "app/log.h"
#include "app/update/install_update.h"

namespace orbwatch::app::daemon {
namespace {

namespace fs = std::filesystem;

constexpr const char* kUnderWay = "an update is being installed; repeat this afterwards";
constexpr int kAll = 100;

void add_trial(DeviceUpdate::State& state, const update::ImageFiles& image) {
  if (const auto trial = image.trial()) {
    state.trial = DeviceUpdate::Trial::OnTrial;
    state.returns_in = trial->returns_in.count();
    if (trial->kept_in) state.kept_in = trial->kept_in->count();
    return;
  }
  const auto tried = image.tried();
  if (!tried || tried->version == state.version) return;
  state.other = tried->version;
  if (tried->waits_for_start) {
    state.trial = DeviceUpdate::Trial::Installed;
    return;
  }
  state.trial = DeviceUpdate::Trial::Returned;
  state.reason = image.reason_of_return(tried->version);
  if (state.reason.empty()) {
    state.reason = "it crashed, lost its power or was restarted before it was kept";
  }
}

}  // namespace

ImageUpdate::ImageUpdate(Settings settings) : settings_(std::move(settings)) {
  remove_folder();
  thread_.start("update", [this] { run(); });
}

ImageUpdate::~ImageUpdate() {
  cancel();
  thread_.stop();
  remove_folder();
}

/// A file that stays is removed at the next start.
void ImageUpdate::remove_folder() {
  std::error_code none;
  fs::remove_all(settings_.folder, none);
}

DeviceUpdate::State ImageUpdate::state() const {
  State state;
  state.version = settings_.image.version().value_or("");
  state.slot = settings_.image.slot();
  add_trial(state, settings_.image);
  if (const auto may = update::check_device(settings_.image); !may) {
    state.refusal = may.error().message;
  }
  const std::lock_guard lock(mutex_);
  state.work = work_;
  state.percent = percent_;
  state.step = step_;
  state.failure = failure_;
  return state;
}

/// The whole bundle must fit at its beginning, and each part afterwards.
Result<> ImageUpdate::check_room(std::uint64_t offset, std::uint64_t whole,
                                 std::size_t bytes) const {
  if (whole == 0) return fail("the file is empty");
  if (offset != 0 && whole != whole_) {
    return fail("size must be " + std::to_string(whole_) + ", as at the beginning of the upload");
  }
  if (offset > whole || bytes > whole - offset) return fail("more bytes than the size of the file");
  std::error_code error;
  const std::uintmax_t free = fs::space(settings_.folder, error).available;
  if (error) return fail(settings_.folder.string() + ": " + error.message());
  const std::uint64_t needed = offset == 0 ? whole : bytes;
  if (free >= settings_.reserve && free - settings_.reserve >= needed) return {};
  return fail("no room: the update has " + mebibytes(whole) + ", the data partition has " +
              mebibytes(free) + " left, and " + mebibytes(settings_.reserve) +
              " of them stay free; delete recordings");
}

Result<std::uint64_t> ImageUpdate::add(std::uint64_t offset, std::uint64_t whole,
                                       std::string_view bytes) {
  if (auto made = make_owners_folder(settings_.folder); !made) return tl::unexpected(made.error());
  if (offset == 0) {
    std::error_code none;  // an old file that stays takes room only
    fs::remove(part(), none);
    fs::remove(bundle(), none);
    is_complete_ = false;
  }
  if (auto room = check_room(offset, whole, bytes.size()); !room) {
    return tl::unexpected(room.error());
  }
  const auto size = add_uploaded(part(), offset, bytes);
  if (!size || *size < whole) return size;
  std::error_code error;
  fs::rename(part(), bundle(), error);
  if (error) return fail(bundle().string() + ": " + error.message());
  is_complete_ = true;
  return size;
}

Result<std::uint64_t> ImageUpdate::upload(std::uint64_t offset, std::uint64_t whole,
                                          std::string_view bytes) {
  if (offset == 0) {
    if (auto may = update::check_device(settings_.image); !may) return tl::unexpected(may.error());
  }
  const std::lock_guard lock(mutex_);
  if (work_ == Work::Checking || work_ == Work::Installing) return fail(kUnderWay);
  auto size = add(offset, whole, bytes);
  if (!size) {
    failure_ = size.error().message;
    return size;
  }
  whole_ = whole;
  work_ = Work::Uploading;
  percent_ = static_cast<int>(kAll * *size / whole);
  step_.clear();
  failure_.clear();
  abandoned_ = hal::Clock::now() + kLongestPause;
  thread_.wake();
  return size;
}

Result<> ImageUpdate::install() {
  const std::lock_guard lock(mutex_);
  if (work_ == Work::Checking || work_ == Work::Installing) return fail(kUnderWay);
  if (!is_complete_) return fail("no update was uploaded completely");
  work_ = Work::Checking;
  percent_ = 0;
  failure_.clear();
  thread_.wake();
  return {};
}

Result<> ImageUpdate::restart_device() {
  if (state().trial != Trial::Installed) return fail("no update is installed that waits for it");
  settings_.restart_device();
  return {};
}

void ImageUpdate::cancel() {
  const std::lock_guard lock(mutex_);
  is_cancelled_ = true;
  if (installer_ != nullptr) installer_->cancel();
}

/// Body of the thread.
void ImageUpdate::run() {
  hal::TimePoint wakes = hal::TimePoint::max();
  while (thread_.wait_until(wakes)) {
    Work work = Work::None;
    {
      const std::lock_guard lock(mutex_);
      work = work_;
      if (work == Work::Uploading && hal::Clock::now() >= abandoned_) {
        work_ = Work::None;
        failure_ = "the upload has stopped, and what had arrived is deleted";
        is_complete_ = false;
        remove_folder();
      }
      wakes = work_ == Work::Uploading ? abandoned_ : hal::TimePoint::max();
    }
    if (work == Work::Checking) install_uploaded();
  }
}

Result<std::string> ImageUpdate::install_by_rauc() {
  auto installer = update::Installer::connect();
  if (!installer) return tl::unexpected(installer.error());
  {
    const std::lock_guard lock(mutex_);
    if (is_cancelled_) return fail("orbwatch ends");
    installer_ = &*installer;
  }
  auto version =
      update::install_update(settings_.image, *installer,
                             {.bundle = bundle(),
                              .name = "the update",
                              .on_progress = [this](int percent, const std::string& step) {
                                const std::lock_guard lock(mutex_);
                                work_ = Work::Installing;
                                percent_ = percent;
                                step_ = step;
                              }});
  const std::lock_guard lock(mutex_);
  installer_ = nullptr;
  return version;
}

void ImageUpdate::install_uploaded() {
  const auto version = install_by_rauc();
  if (version) {
    log_line(LogLevel::Info, "update: version " + *version + " is installed");
  } else {
    log_line(LogLevel::Warning, "update: " + version.error().message);
  }
  const std::lock_guard lock(mutex_);
  remove_folder();
  is_complete_ = false;
  work_ = Work::None;
  percent_ = 0;
  step_.clear();
  if (!version) failure_ = version.error().message;
}

}  // namespace orbwatch::app::daemon
