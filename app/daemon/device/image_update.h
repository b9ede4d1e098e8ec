// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>

#include "app/model/configuration/device_update.h"
#include "app/update/image_files.h"
#include "app/update/installer.h"
#include "hal/clock.h"
#include "hal/thread/thread.h"

namespace orbwatch::app::daemon {

/// DeviceUpdate by RAUC. The bundle is in a folder of its own, which is removed at the beginning
/// and the end, after an installation, and when an upload stops for kLongestPause.
class ImageUpdate final : public DeviceUpdate {
 public:
  struct Settings {
    update::ImageFiles image{};
    std::filesystem::path folder{};  ///< of the bundle; on the data partition
    std::uint64_t reserve = 0;       ///< free space that stays on its disk, bytes
    /// Restarts the computer; called on any thread.
    std::function<void()> restart_device{};
  };

  static constexpr std::chrono::minutes kLongestPause{10};

  explicit ImageUpdate(Settings settings);
  ~ImageUpdate() override;

  State state() const override;
  Result<std::uint64_t> upload(std::uint64_t offset, std::uint64_t whole,
                               std::string_view bytes) override;
  Result<> install() override;
  Result<> restart_device() override;
  void cancel() override;

 private:
  Result<> check_room(std::uint64_t offset, std::uint64_t whole, std::size_t bytes) const;
  Result<std::uint64_t> add(std::uint64_t offset, std::uint64_t whole, std::string_view bytes);
  void remove_folder();
  void run();
  void install_uploaded();
  Result<std::string> install_by_rauc();
  std::filesystem::path part() const { return settings_.folder / "update.raucb.part"; }
  std::filesystem::path bundle() const { return settings_.folder / "update.raucb"; }

  const Settings settings_;
  mutable std::mutex mutex_;  ///< of what follows; held while a part is written
  Work work_ = Work::None;
  int percent_ = 0;
  std::string step_, failure_;
  std::uint64_t whole_ = 0;  ///< size of the bundle that is uploaded
  bool is_complete_ = false;
  bool is_cancelled_ = false;
  hal::TimePoint abandoned_ = hal::TimePoint::max();  ///< when its upload counts as abandoned
  update::Installer* installer_ = nullptr;            ///< during a call of RAUC
  hal::Thread thread_;
};

}  // namespace orbwatch::app::daemon
