// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/temporary_folder.h"

namespace orbwatch::tests {

/// Folders and files like the kernel's, in a temporary folder.
class MadeUpTree {
 public:
  void write(const std::string& file, const std::string& text) {
    const std::filesystem::path path = folder_ / file;
    std::filesystem::create_directories(path.parent_path());
    std::filesystem::remove(path);
    std::ofstream out(path, std::ios::binary);
    out << text;
    if (!out.flush()) ADD_FAILURE() << "cannot write " << path;
  }
  void link(const std::string& name, const std::filesystem::path& target) {
    const std::filesystem::path path = folder_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::filesystem::remove(path);
    std::filesystem::create_symlink(target, path);
  }
  void make_folder(const std::string& name) { std::filesystem::create_directories(folder_ / name); }
  void remove(const std::string& name) { std::filesystem::remove_all(folder_ / name); }

  std::filesystem::path path() const { return folder_.path(); }
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }

 private:
  TemporaryFolder folder_;
};

}  // namespace orbwatch::tests
