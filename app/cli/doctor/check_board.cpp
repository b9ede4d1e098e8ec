// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "app/cli/doctor/checks.h"

/// Checks of configuration, board, kernel and temperature.
namespace orbwatch::app::cli::doctor {
namespace {

constexpr double kNearlyHot = 10;  // K below the temperature at which the board slows down

/// The package is installed from its file: no repository has it.
constexpr const char* kReinstall = "sudo apt install --reinstall ./orbwatch_*.deb";

std::string whole(double value) { return std::to_string(std::lround(value)); }

/// Package to install for a driver that the kernel lacks.
std::string kernel_remedy(const BoardFacts& board) {
  const std::string package = board.known ? board.known->kernel_package : "";
  return "sudo apt install " +
         (package.empty() ? "linux-image-$(dpkg --print-architecture)" : package);
}

Diagnosis missing_driver(const Driver& driver, const Facts& facts) {
  const std::string kernel = "Linux " + facts.kernel.release;
  const std::string which = "driver " + driver.name + ", which " + driver.needs + " needs";
  if (facts.kernel.lists_drivers) {
    return fault(kernel + " has no " + which, kernel_remedy(facts.board));
  }
  return warning(
      kernel + ": its list of drivers cannot be read, and it has not loaded the " + which,
      "sudo modprobe " + driver.name);
}

bool has(double bits, Throttling cause, int shift) {
  return (static_cast<unsigned>(bits) >> shift & static_cast<unsigned>(cause)) != 0;
}

Diagnosis throttling(double bits, const std::string& supply) {
  const std::string better =
      "a supply and a cable for the board's current" + (supply.empty() ? "" : ": " + supply);
  if (has(bits, Throttling::UnderVoltage, 0))
    return fault("the supply's voltage is too low", better);
  if (bits >= 1 && (static_cast<unsigned>(bits) & 0xf) != 0) {
    return warning("the processor is slowed down now", "better cooling");
  }
  if (has(bits, Throttling::UnderVoltage, kSincePowerOn)) {
    return warning("the supply's voltage was too low since power-on", better);
  }
  if (bits > 0) return warning("the processor was slowed down since power-on", "better cooling");
  return ok("the processor was not slowed down since power-on");
}

}  // namespace

Diagnoses check_configuration(const Facts& facts) {
  const ConfigurationFacts& configuration = facts.configuration;
  const std::string file = configuration.file.string();
  if (!configuration.exists) {
    return {fault(file + ": there is none", "orbwatch setup -o machine --ball-diameter MM")};
  }
  if (!configuration.error.empty()) {
    return {fault(configuration.error, "orbwatchd --config " + file + " --check")};
  }
  return {ok(file)};
}

Diagnoses check_board(const Facts& facts) {
  const BoardFacts& board = facts.board;
  Diagnoses found;
  for (const std::string& problem : board.problems) {
    found.push_back(warning(problem, kReinstall));
  }
  const std::string model = board.model.empty() ? "a board without a name" : board.model;
  if (!board.has_folder) {
    return {warning(model + ": the files of boards are not installed in " + board.folder.string(),
                    kReinstall)};
  }
  if (!board.known) {
    found.push_back(warning(model + ": no file in " + board.folder.string() + " is for it",
                            "write one: platform/boards of the sources says how"));
    return found;
  }
  const Board& known = *board.known;
  found.push_back(ok(model + ", by the file of " + known.name +
                     (known.processor.empty() ? "" : ", " + known.processor) + "; " + known.tried));
  return found;
}

Diagnoses check_kernel(const Facts& facts) {
  const KernelFacts& kernel = facts.kernel;
  if (kernel.release.empty()) return {warning("its version cannot be read", "uname -r")};
  Diagnoses found;
  for (const Driver& driver : kernel.drivers) {
    if (!driver.is_there) found.push_back(missing_driver(driver, facts));
  }
  if (!found.empty()) return found;
  std::string drivers;
  for (const Driver& driver : kernel.drivers)
    drivers += (drivers.empty() ? "" : ", ") + driver.name;
  return {ok("Linux " + kernel.release + (drivers.empty() ? "" : ", with " + drivers))};
}

Diagnoses check_heat(const Facts& facts) {
  Diagnoses found;
  const double temperature = facts.health.board_temperature;
  const double limit = facts.board.known ? facts.board.known->slows_down_at : 0;
  if (signals::is_valid(temperature)) {
    const std::string text = whole(temperature) + " degC";
    const std::string bound =
        limit > 0 ? "; the board slows down at " + whole(limit) + " degC" : "";
    found.push_back(limit > 0 && temperature >= limit - kNearlyHot
                        ? warning(text + bound, "better cooling")
                        : ok(text + bound));
  }
  const std::string supply = facts.board.known ? facts.board.known->supply : "";
  if (signals::is_valid(facts.health.throttling)) {
    found.push_back(throttling(facts.health.throttling, supply));
  }
  if (found.empty()) found.push_back(ok("the board has no thermometer"));
  return found;
}

}  // namespace orbwatch::app::cli::doctor
