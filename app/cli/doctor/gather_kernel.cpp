// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <sstream>

#include "app/cli/doctor/gather.h"
#include "app/health/system_file.h"

/// Facts about the board, and about the kernel with the drivers that the configuration needs.
namespace orbwatch::app::cli::doctor {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestList = std::size_t{8} << 20;  // bytes; Debian's list has 600 000

/// The first line of a file, without the terminator of device tree texts.
std::string line_of(const fs::path& file) {
  const std::string text = read_system_file(file).value_or("");
  return text.substr(0, text.find_first_of(std::string_view("\n\0", 2)));
}

/// Model by the device tree, or by the firmware of a PC.
std::string model_of(const Sources& sources) {
  const std::string model = line_of(sources.at("/proc/device-tree/model"));
  if (!model.empty()) return model;
  const fs::path dmi = sources.at("/sys/class/dmi/id");
  const std::string vendor = line_of(dmi / "sys_vendor"), product = line_of(dmi / "product_name");
  return vendor + (vendor.empty() || product.empty() ? "" : " ") + product;
}

/// Replaces hyphens, which the kernel treats like underscores.
std::string with_underscores(std::string name) {
  std::ranges::replace(name, '-', '_');
  return name;
}

/// Adds the modules of a list with a path at the beginning of each line, such as modules.dep and
/// modules.builtin: "kernel/drivers/media/usb/uvc/uvcvideo.ko.xz: ...".
void add_modules(const std::string& list, std::vector<std::string>& modules) {
  std::istringstream lines(list);
  for (std::string line; std::getline(lines, line);) {
    const std::string path = line.substr(0, line.find(':'));
    const std::size_t begin = path.rfind('/') + 1;  // 0 without a folder
    const std::size_t end = path.find(".ko", begin);
    if (end != std::string::npos) {
      modules.push_back(with_underscores(path.substr(begin, end - begin)));
    }
  }
}

/// Modules of the kernel; nullopt: its lists cannot be read.
std::optional<std::vector<std::string>> modules_of(const Sources& sources,
                                                   const std::string& release) {
  if (release.empty() || release.find('/') != std::string::npos) return std::nullopt;
  std::optional<std::vector<std::string>> modules;
  for (const char* list : {"modules.builtin", "modules.dep"}) {
    const auto text = read_system_file(sources.at("/lib/modules") / release / list, kLongestList);
    if (!text) continue;
    if (!modules) modules.emplace();
    add_modules(*text, *modules);
  }
  return modules;
}

/// Adds the drivers that a camera of the back-end requires.
void add_drivers(const files::CameraSettings& camera, const BoardFacts& board,
                 std::vector<Driver>& drivers) {
  const auto add = [&](const std::string& name) {
    if (std::ranges::find(drivers, name, &Driver::name) != drivers.end()) return;
    drivers.push_back({name, "camera " + camera.name});
  };
  const hal::BackEndFacts& facts = files::facts_of(camera.back_end);
  if (facts.origin == hal::CameraOrigin::Kernel) {
    add("videodev");
    if (files::address_of(camera.back_end).find("usb") != std::string::npos) add("uvcvideo");
  }
  if (facts.has_board_sensors && board.known) {
    for (const std::string& driver : board.known->camera_drivers) add(driver);
  }
}

}  // namespace

void gather_kernel(const Sources& sources, Facts& facts) {
  BoardFacts& board = facts.board;
  board.model = model_of(sources);
  board.folder = sources.boards;
  std::error_code unknown;
  board.has_folder = fs::is_directory(sources.boards, unknown);
  const std::vector<Board> boards = read_boards(sources.boards, board.problems);
  if (const Board* known = find_board(boards, board.model, sources.architecture)) {
    board.known = *known;
  }
  KernelFacts& kernel = facts.kernel;
  kernel.release = line_of(sources.at("/proc/sys/kernel/osrelease"));
  if (!facts.site) return;
  for (const files::CameraSettings& camera : facts.site->cameras) {
    add_drivers(camera, board, kernel.drivers);
  }
  const auto modules = modules_of(sources, kernel.release);
  kernel.lists_drivers = modules.has_value();
  for (Driver& driver : kernel.drivers) {
    const std::string name = with_underscores(driver.name);
    driver.is_there = sources.has(fs::path("/sys/module") / name) ||
                      (modules && std::ranges::find(*modules, name) != modules->end());
  }
}

}  // namespace orbwatch::app::cli::doctor
