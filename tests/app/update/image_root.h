// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ctime>
#include <filesystem>
#include <fstream>
#include <string>

#include "app/update/image_files.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::update::tests {

/// Root folder with the files of an image, version 1.9 in slot a.
class ImageRoot {
 public:
  ImageRoot() {
    write("etc/os-release", "ID=debian\nIMAGE_ID=orbwatch\nIMAGE_VERSION=1.9\n");
    write("etc/rauc/keyring.pem", "certificate\n");
    write("run/orbwatch-image/slot", "a\n");
    restart("first");
  }

  void write(const std::string& name, const std::string& text) const {
    const auto file = folder_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }
  void remove(const std::string& name) const { std::filesystem::remove(folder_ / name); }
  /// Gives the computer's start another identity.
  void restart(const std::string& identity) const {
    write("proc/sys/kernel/random/boot_id", identity + "\n");
  }
  /// Trial that ends in ten minutes, or is kept after `kept_in` seconds; negative: does not work.
  void try_version(long kept_in) const {
    timespec now{};
    ::clock_gettime(CLOCK_BOOTTIME, &now);
    write("run/orbwatch-image/trial",
          std::to_string(now.tv_sec + 600) + "\n" +
              (kept_in < 0 ? "-" : std::to_string(now.tv_sec + kept_in)) + "\n");
  }

  const std::filesystem::path& path() const { return folder_.path(); }
  ImageFiles files() const { return ImageFiles(path()); }

 private:
  const orbwatch::tests::TemporaryFolder folder_;
};

}  // namespace orbwatch::app::update::tests
