// SPDX-License-Identifier: Apache-2.0
#include "hal/lines/gpio/gpio_lines.h"

#include <fcntl.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "hal/lines/find_line.h"
#include "hal/lines/gpio/gpiod_calls.h"

namespace orbwatch::hal {
namespace {

namespace fs = std::filesystem;

/// Sorted by number: /dev/gpiochip10 after /dev/gpiochip9.
std::vector<std::string> chip_paths() {
  std::vector<std::string> paths;
  std::error_code none;  // no /dev: no chips
  for (const auto& entry : fs::directory_iterator("/dev", none)) {
    if (entry.path().filename().string().starts_with("gpiochip") && !entry.is_symlink(none)) {
      paths.push_back(entry.path().string());
    }
  }
  std::ranges::sort(paths, {},
                    [](const std::string& path) { return std::pair(path.size(), path); });
  return paths;
}

/// Finds a line and opens it with `request`, which returns the line or the system's error.
template <class Line, class Request>
Result<std::unique_ptr<Line>> open_line(const std::vector<ChipInfo>& chips,
                                        const LineAddress& address, const Request& request) {
  const auto found = find_line(chips, address);
  if (!found) return tl::unexpected(found.error());
  auto line = request(found->chip->path, found->line->offset);
  if (!line) return fail(open_error(*found, address, line.error()));
  return std::move(*line);
}

}  // namespace

namespace gpiod_calls {

LineFaultReport line_fault(const std::string& text, int code) {
  const LineFault fault = code == ENODEV || code == ENXIO ? LineFault::Gone : LineFault::ReadError;
  return {fault, "line " + text + ": " + std::generic_category().message(code)};
}

bool never_wait(int descriptor) {
  const int flags = ::fcntl(descriptor, F_GETFL);
  return flags >= 0 && ::fcntl(descriptor, F_SETFL, flags | O_NONBLOCK) == 0;
}

}  // namespace gpiod_calls

std::vector<ChipInfo> GpioLines::chips() const {
  std::vector<ChipInfo> chips;
  for (const std::string& path : chip_paths()) {
    auto chip = gpiod_calls::read_chip(path);
    chips.push_back(chip ? std::move(*chip)
                         : ChipInfo{.path = path, .error = chip_error(path, chip.error())});
  }
  return chips;
}

Result<std::unique_ptr<DigitalInput>> GpioLines::open_input(const InputSettings& settings) {
  return open_line<DigitalInput>(chips(), settings.address,
                                 [&settings](const std::string& path, unsigned offset) {
                                   return gpiod_calls::request_input(path, offset, settings);
                                 });
}

Result<std::unique_ptr<DigitalOutput>> GpioLines::open_output(const OutputSettings& settings) {
  return open_line<DigitalOutput>(chips(), settings.address,
                                  [&settings](const std::string& path, unsigned offset) {
                                    return gpiod_calls::request_output(path, offset, settings);
                                  });
}

}  // namespace orbwatch::hal
