// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/device/device_programs.h"

#include <chrono>
#include <system_error>
#include <utility>

#include "app/service/child_program.h"
#include "hal/atomic_file.h"

namespace orbwatch::app::daemon {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSupport = "support.tar.zst";
constexpr const char* kBackup = "backup.tar.zst";
constexpr const char* kUpload = "upload.tar.zst";
constexpr const char* kFigures = "figures";
/// Time to copy kept events, on a slow card.
constexpr std::chrono::minutes kEventsTime{10};

}  // namespace

DevicePrograms::DevicePrograms(fs::path config, const fs::path& state,
                               std::function<void()> restart, std::uint64_t reserve)
    : config_(std::move(config)),
      folder_(state / "device-files"),
      restart_(std::move(restart)),
      upload_(folder_ / kUpload, reserve) {
  std::error_code none;  // a file that stays is replaced later
  fs::remove_all(folder_, none);
}

Result<std::string> DevicePrograms::run(CliCall call) const {
  call.cancelled = &cancelled_;
  return run_cli(config_, call);
}

Result<DeviceFiles::Made> DevicePrograms::make(const char* name, CliCall call) {
  const fs::path file = folder_ / name;
  if (auto made = make_owners_folder(folder_); !made) return tl::unexpected(made.error());
  call.arguments.insert(call.arguments.end(), {"-o", file.string()});
  return run(std::move(call)).map([&](std::string report) {
    const std::string path = file.string() + ": ";
    if (report.starts_with(path)) report.erase(0, path.size());
    return Made{file, std::move(report)};
  });
}

Result<DeviceFiles::Made> DevicePrograms::support(const Figures& figures, bool pictures) {
  const std::lock_guard lock(mutex_);
  const fs::path folder = folder_ / kFigures;
  std::error_code none;
  fs::remove_all(folder, none);
  if (auto made = make_owners_folder(folder_); !made) return tl::unexpected(made.error());
  if (auto made = make_owners_folder(folder); !made) return tl::unexpected(made.error());
  for (const auto& [name, text] : figures) {
    const auto written = hal::write_file(folder / name, text, hal::FileAccess::Owner);
    if (!written) return tl::unexpected(written.error());
  }
  CliCall call{.arguments = {"support", "--figures", folder.string()}};
  if (pictures) call.arguments.emplace_back("--pictures");
  auto made = make(kSupport, std::move(call));
  fs::remove_all(folder, none);
  return made;
}

Result<DeviceFiles::Made> DevicePrograms::backup(const std::optional<std::string>& passphrase,
                                                 bool events) {
  const std::lock_guard lock(mutex_);
  CliCall call{.arguments = {"backup"}};
  if (passphrase) {
    call.arguments.insert(call.arguments.end(), {"--passphrase-file", kChildSecret});
    call.secret = *passphrase + "\n";
  } else {
    call.arguments.emplace_back("--without-secrets");
  }
  if (events) call.arguments.emplace_back("--with-events");
  if (events) call.time = kEventsTime;
  return make(kBackup, std::move(call));
}

Result<std::uint64_t> DevicePrograms::upload(std::uint64_t offset, std::string_view bytes) {
  const std::lock_guard lock(mutex_);
  if (auto made = make_owners_folder(folder_); !made) return tl::unexpected(made.error());
  return upload_.add(offset, bytes);
}

/// `way` is the option by which the files are only compared, or replaced.
Result<std::string> DevicePrograms::restored(const Restore& restore, const char* way) {
  const fs::path& file = upload_.file();
  upload_.keep();
  std::error_code none;
  if (!fs::exists(file, none)) return fail("no backup was uploaded");
  CliCall call{.arguments = {"restore", file.string(), "--json", way}, .time = kEventsTime};
  for (const CameraAddress& camera : restore.cameras) {
    call.arguments.insert(call.arguments.end(), {"--camera", camera.camera + "=" + camera.address});
  }
  if (!restore.events) call.arguments.emplace_back("--without-events");
  if (restore.passphrase) {
    call.secret = *restore.passphrase + "\n";
    call.arguments.insert(call.arguments.end(), {"--passphrase-file", kChildSecret});
  } else {
    call.arguments.emplace_back("--without-secrets");
  }
  auto done = run(std::move(call));
  upload_.keep();
  if (!done) {
    // Its path on this computer means nothing to the client.
    std::string message = std::move(done.error().message);
    const std::string prefix = file.string() + ": ";
    if (message.starts_with(prefix)) message.replace(0, prefix.size(), "the uploaded file: ");
    return fail(message);
  }
  return done;
}

Result<std::string> DevicePrograms::check(const Restore& restore) {
  const std::lock_guard lock(mutex_);
  return restored(restore, "--check");
}

Result<std::string> DevicePrograms::restore(const Restore& restore) {
  const std::lock_guard lock(mutex_);
  return restored(restore, "--at-start");
}

Result<> DevicePrograms::reset() {
  const std::lock_guard lock(mutex_);
  return run({.arguments = {"reset", "--factory", "--at-start"}}).map([](const auto&) {});
}

}  // namespace orbwatch::app::daemon
