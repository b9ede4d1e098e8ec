// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <string>
#include <utility>

#include "app/cli/backup/collect.h"
#include "tests/app/cli/archive/frames.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::cli::backup {

/// Bytes and mode of files, by their path relative to a folder.
using FileStates = std::map<std::string, std::pair<std::string, mode_t>>;

inline FileStates states_below(const std::filesystem::path& folder) {
  FileStates states;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_directory()) continue;
    std::ifstream in(entry.path(), std::ios::binary);
    struct stat about {};
    EXPECT_EQ(::stat(entry.path().c_str(), &about), 0);
    states[entry.path().lexically_relative(folder).string()] = {
        std::string(std::istreambuf_iterator<char>(in), {}), about.st_mode & 07777U};
  }
  return states;
}

inline void write_file(const std::filesystem::path& file, const std::string& bytes,
                       mode_t mode = 0640) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << bytes;
  EXPECT_EQ(::chmod(file.c_str(), mode), 0);
}

/// Reads a backup in memory.
inline Result<ReadBackup> parse_backup(const std::string& bytes) {
  FrameReader frames = frames_of(bytes);
  return read_backup(frames);
}

/// A device with folders for configuration and state.
struct Device {
  tests::TemporaryFolder folder;
  SitePlaces places{folder / "etc", folder / "lib"};

  Device() {
    std::filesystem::create_directories(places.configuration);
    std::filesystem::create_directories(places.state);
  }
  FileStates states() const { return states_below(folder.path()); }
  Site site() const {
    return {.file = places.configuration / "site.toml",
            .places = places,
            .recordings = {},
            .named = {}};
  }
};

/// A backup of the device, all files in one list.
inline Archive files_of(const Device& device) {
  auto backup = collect(device.site());
  EXPECT_TRUE(backup) << backup.error().message;
  Archive files = backup->files;
  files.insert(files.end(), backup->secrets.begin(), backup->secrets.end());
  return files;
}

/// Fills the configuration's folder with files of random names, bytes and modes.
inline void fill_randomly(const Device& device, std::mt19937& random) {
  const char* const folders[] = {"", "recipes/", "keys/old/", "B\xc3\xa4lle/"};
  const char* const endings[] = {".toml", ".yaml", ".pem", "", ".part2", ".xml"};
  const mode_t modes[] = {0600, 0640, 0644, 0664, 0755, 0400};
  write_file(device.places.configuration / "site.toml", "# " + std::to_string(random()));
  for (std::size_t n = random() % 12; n > 0; --n) {
    std::string bytes(random() % 5000, '\0');
    for (char& c : bytes) c = static_cast<char>(random());
    const std::string name = folders[random() % 4] + std::to_string(n) + endings[random() % 6];
    write_file(device.places.configuration / name, bytes, modes[random() % 6]);
  }
  for (const char* name : {"users.json", "calibration.toml", "certificate.pem", "drift-zero-a"}) {
    if (random() % 2 == 0) write_file(device.places.state / name, std::to_string(random()), 0600);
  }
}

}  // namespace orbwatch::app::cli::backup
